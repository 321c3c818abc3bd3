// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/NodeRegistry.h"
#include "node/cycle/RingReader.h"
#include "protocol/messages/Records.h"
#include "transport/TokenBucket.h"

#include <QtCore/QPointer>
#include <QtCore/QTimer>

#include <deque>
#include <functional>
#include <memory>
#include <optional>

namespace qplc {

/// Gives the bytes of rings to a recorder on another computer: to one at a time, and only so fast.
/// To the ring it is a recorder like others, which keeps its records until they are in a file.
///
/// Threads: that of the master. Nothing here is done by the cycle.
class RemoteRecorder
{
public:
    static constexpr std::int64_t Silence = 60'000'000'000;   // [ns] after which nobody records any more
    static constexpr std::int64_t Attention = 5'000'000'000;  // [ns] for which somebody waits for a phase
    static constexpr int BytesPerSecond = 2'000'000;          // on the long run
    static constexpr int BytesAtOnce = 1 << 20;               // after a pause
    static constexpr std::size_t MostRings = 4;               // of the newest phases

    /// Who asks.
    struct Asker
    {
        const QObject *connection = nullptr;
        QString key;   // the same over another connection of the same program; empty: it has none
        QString name;  // with its address, for people
    };

    /// \param ringUnderWay  file of the ring of the phase that is under way; empty: there is none
    explicit RemoteRecorder(std::function<QString()> ringUnderWay);

    /// A phase is about to begin whose ring is \a file. A recorder that waits for one gets all of
    /// it.
    void begin(const QString &file, std::int64_t now);
    /// \return nothing, with the reason in \a refusal
    std::optional<messages::Records> answer(const messages::GetRecords &question, const Asker &asker, std::int64_t now,
                                            Refusal *refusal);
    /// The recorder, for people, if it still has to put records of the newest ring to safety and
    /// was heard within Attention. Otherwise empty.
    QString behind(std::int64_t now) const;
    /// Done each second: a recorder that is silent for too long no longer counts.
    void look(std::int64_t now);

private:
    struct Ring
    {
        QByteArray file;
        std::unique_ptr<RingReader> reader;  // null: nobody records
    };

    bool isAnother(const Asker &asker, std::int64_t now) const;
    Ring *find(const QString &name);
    bool isUnderWay(const Ring &ring) const;
    bool attach(Ring *ring, Refusal *refusal);
    void leave(Ring *ring);
    void end(Ring *ring);
    bool read(const RingRegion &region, const messages::GetRecords &question, std::int64_t now,
              messages::Records *answer, Refusal *refusal);

    const std::function<QString()> m_ringUnderWay;
    std::deque<Ring> m_rings;  // the newest last
    QPointer<const QObject> m_connection;
    QString m_key;
    QString m_name;            // empty: nobody has asked
    std::int64_t m_heard = 0;  // [ns]
    TokenBucket m_bytes{BytesPerSecond, BytesAtOnce};
    QTimer m_timer;
};

}  // namespace qplc
