// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <vector>

namespace qplc {

/// Which connections of a master may send a long message now, one that takes much memory while it
/// arrives. A few at a time, one of each origin, and each for as long as its length needs: others
/// wait, and whoever does not end his message has to go.
///
/// Looks at no clock: times are ns on any steady clock.
class LongMessages
{
public:
    using Client = void *;
    static constexpr int MostAtOnce = 4;
    static constexpr qint64 Patience = 10'000'000'000;  // [ns] with any of them
    static constexpr qint64 NanosecondsPerByte = 1000;  // more: 1 MB in a second

    /// \param origin  who sends it, as far as it is known: an identity or an address
    /// \param length  of the message [byte]
    /// \return whether \a client may go on with its message. If not, leave() of another one names
    /// it
    bool admit(Client client, const QString &origin, quint32 length, qint64 now);
    /// The message has arrived, or \a client is gone. \return who has waited for that, in the order
    /// of their arrival: they ask again
    std::vector<Client> leave(Client client);
    /// Who has taken too long.
    std::vector<Client> overdue(qint64 now) const;
    bool isEmpty() const { return m_arriving.empty(); }

private:
    struct Arriving
    {
        Client client = nullptr;
        QString origin;
        qint64 deadline = 0;
    };
    std::vector<Arriving> m_arriving;
    std::vector<Client> m_waiting;
};

}  // namespace qplc
