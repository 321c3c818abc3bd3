// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TokenBucket.h"

#include <QtCore/QHash>
#include <QtCore/QVector>
#include <QtNetwork/QHostAddress>

#include <optional>

namespace qplc {

/// How many may come in to a server, how fast, and how long they may take to say who they are. A
/// stranger is somebody who has not; memory for him is bounded by this class alone.
///
/// Looks at no clock: times are ns on any steady clock. Who comes from a loopback address is a user
/// of this machine: no limit of its own for the address, no rate.
class ConnectionGate
{
public:
    struct Limits
    {
        int connections = 320;            // at a time: 254 nodes, strangers, and as many tools
        int connectionsOfIdentity = 32;   // of them, at a time, of one that was proven
        int strangers = 32;               // of them, at a time; more wait in the queue of the system
        int strangersOfAddress = 8;       // of them, from one address, or one IPv6 network of 64 bits
        int acceptsPerSecond = 50;        // on the long run
        int acceptsAtOnce = 64;           // after a pause
        qint64 patience = 2'000'000'000;  // with a stranger [ns]
    };
    enum Refusal : quint8 { Admitted, TooManyConnections, TooManyOfAddress, TooManyOfIdentity, TooFast };
    using Ticket = quint64;  // of a connection; never 0

    void setLimits(const Limits &limits)
    {
        m_limits = limits;
        m_accepts = TokenBucket(limits.acceptsPerSecond, limits.acceptsAtOnce);
    }
    const Limits &limits() const { return m_limits; }

    /// Whether the next connection may be taken out of the queue of the system.
    bool hasRoom() const { return strangers() < m_limits.strangers; }
    /// Takes somebody in as a stranger. \return nothing, with the reason in \a refusal, when there
    /// is no place: he is to be closed at once
    std::optional<Ticket> admit(const QHostAddress &address, qint64 now, Refusal *refusal);
    /// The stranger has done a step and gets time for the next one.
    void renew(Ticket ticket, qint64 now);
    /// The stranger has proven to be \a identity. \return false when there are too many of it: he
    /// is to be closed
    bool prove(Ticket ticket, const QString &identity);
    /// The stranger has said who he is.
    void know(Ticket ticket);
    /// Nobody of this ticket is here any more.
    void leave(Ticket ticket);
    /// Strangers who have taken too long.
    QVector<Ticket> overdue(qint64 now) const;

    int connections() const { return int(m_guests.size()); }
    int strangers() const;
    static const char *textOf(Refusal refusal);

private:
    struct Guest
    {
        QHostAddress origin;
        QString identity;  // as far as it was proven
        bool isStranger = true;
        qint64 deadline = 0;
    };
    int strangersOf(const QHostAddress &origin) const;

    Limits m_limits;
    QHash<Ticket, Guest> m_guests;
    Ticket m_last = 0;
    TokenBucket m_accepts{Limits().acceptsPerSecond, Limits().acceptsAtOnce};
};

}  // namespace qplc
