// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TokenBucket.h"

#include <QtCore/QByteArray>
#include <QtCore/QHash>
#include <QtCore/QVector>
#include <QtNetwork/QHostAddress>

#include <functional>

namespace qplc {

/// How many connections a server takes in, how fast, and how long they may take to say who they
/// are. A connection that has not is a stranger; this class alone bounds the memory for strangers.
///
/// Each address has a budget of its own. A newcomer for whom there is no place takes that of the
/// stranger who has said least, so silent connections keep nobody out. Addresses that have proven
/// themselves have places in reserve.
///
/// Looks at no clock: times are ns on any steady clock. The users of this machine share its
/// loopback addresses: these have no limit of their own, and no rate.
class ConnectionGate
{
public:
    struct Limits
    {
        int connections = 320;           // at a time, without strangers: 254 nodes and tools
        int connectionsOfIdentity = 32;  // of them, at a time, of one that was proven
        int strangers = 256;             // at a time
        int reserve = 128;               // more, for addresses that have proven themselves
        int strangersOfAddress = 64;
        int acceptsPerSecond = 5000;      // of an address, on the long run
        int acceptsAtOnce = 1000;         // of an address, after a pause
        int handshakesPerSecond = 100;    // of an address, on the long run; each takes about 1 ms
        int handshakesAtOnce = 320;       // of an address, after a pause: a whole plant behind a router
        qint64 patience = 2'000'000'000;  // with a stranger [ns]

        /// Of the connections, those that only nodes and operators get.
        int reserved() const { return connections / 8; }
    };
    enum Refusal : quint8 { Admitted, TooManyConnections, TooManyOfIdentity, TooFast, TooManyHandshakes };
    enum Guest : quint8 { Observer, NodeOrOperator };
    using Ticket = quint64;  // of a connection; never 0

    struct Admission
    {
        Ticket ticket = 0;           // 0: is to be closed at once
        Refusal refusal = Admitted;  // the reason
        Ticket crowdedOut = 0;       // who has to make room, and is to be closed; 0: nobody
    };

    void setLimits(const Limits &limits) { m_limits = limits; }
    const Limits &limits() const { return m_limits; }

    /// Takes somebody in as a stranger if there is a place.
    Admission admit(const QHostAddress &address, qint64 now);
    /// The stranger wants to begin a handshake, which costs much more than to take it in. \return
    /// false when its address has begun too many: he is to be closed
    bool hear(Ticket ticket, qint64 now);
    /// The stranger has ended a step and gets time for the next one.
    void renew(Ticket ticket, qint64 now);
    /// The stranger has proven to be \a identity. \return false when there are too many of it: he
    /// is to be closed
    bool prove(Ticket ticket, const QString &identity);
    /// From now on the address of \a ticket has places in reserve.
    void trust(Ticket ticket);
    /// The stranger has said who he is. \return false when there is no place for \a guest: he is to
    /// be closed
    bool know(Ticket ticket, Guest guest);
    /// Nobody of this ticket is here any more.
    void leave(Ticket ticket);
    /// Strangers who have taken too long.
    QVector<Ticket> overdue(qint64 now) const;

    int connections() const { return int(m_visits.size()); }
    int strangers() const { return m_strangers; }
    /// Addresses that are kept in memory.
    int origins() const { return int(m_origins.size()); }
    static const char *textOf(Refusal refusal);

private:
    struct Visit
    {
        QByteArray origin;
        QString identity;  // as far as it was proven
        bool isStranger = true;
        int steps = 0;  // that it has done as a stranger
        qint64 deadline = 0;
    };
    /// What is known of an address.
    struct Origin
    {
        TokenBucket accepts;
        TokenBucket handshakes;
        bool isLocal = false;
        int strangers = 0;
        bool isTrusted = false;
        qint64 seen = 0;
    };
    static constexpr int MostOrigins = 1024;

    Origin &originOf(const QHostAddress &address, const QByteArray &key, qint64 now);
    bool isProtected(const QByteArray &origin) const;
    void forgetOrigins(qint64 before);
    void endStranger(Visit *visit);
    int known() const { return connections() - strangers(); }
    Ticket leastOf(const std::function<bool(const Visit &)> &isMeant) const;

    Limits m_limits;
    QHash<Ticket, Visit> m_visits;
    QHash<QByteArray, Origin> m_origins;  // by all bits of the address and its scope
    int m_strangers = 0;
    Ticket m_last = 0;
};

}  // namespace qplc
