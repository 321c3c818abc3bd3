// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Role.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QStringList>

namespace qplc {

/// Who may send a message of \a kind to a master. Nobody: a master sends it, or this version does
/// not know it.
///
/// What a message writes is checked signal by signal besides: see refusalOf().
constexpr Roles whoMaySend(QPlcMessage::Kind kind)
{
    const messages::Use use = messages::useOf(kind);
    if (use.kind == QPlcMessage::Invalid)
        return {};
    if (use.sender == messages::Sender::Operators)
        return Role::Operator | Roles(Role::Engineer);
    return Role::Observer | Roles(Role::Operator) | Role::Node | Role::Engineer;
}

/// Who is at the other end of a control connection, as far as it was proven.
struct Peer
{
    bool isSecured = false;  // the connection is TLS and the identity proven
    bool isCyclicOnly
        = false;         // a plain connection to a secured master: it may attach as a cyclic channel, and nothing else
    QString identity;    // empty: nobody asked
    QByteArray keyMark;  // tells its key from others, and not which one it is; empty: it has a certificate
    QStringList known;   // identities of the plant: nobody takes part under the name of another one
    Role role = Role::Engineer;  // without security everybody may do everything
    bool mayWriteAll = true;
    QStringList writes;  // otherwise: names and patterns (*, ?, [...]) of signals

    /// Empty: it has proven none.
    QString provenIdentity() const { return isSecured ? identity : QString(); }
    /// Whether the files of the master say the same of both.
    bool hasRightsOf(const Peer &other) const
    {
        return keyMark == other.keyMark && role == other.role && mayWriteAll == other.mayWriteAll
            && writes == other.writes;
    }
};

/// How somebody is shown to people: as what was proven, with what it calls itself behind it;
/// without security nothing else is known.
QString shownName(const Peer &peer, const QString &called);

/// Signals that \a message would write, as it names them; none of a message that cannot be read.
QStringList signalsWrittenBy(const QPlcMessage &message);
/// Why \a peer may not send messages of \a kind at all; empty: it may send some.
QString refusalOf(const Peer &peer, QPlcMessage::Kind kind);
/// Why \a peer may not send \a message: "Denied: role Observer may not send StartRealTime"; empty:
/// it may. Looks at the kind, and at the signals that the message writes. What only masters send,
/// and what cannot be read, is left to those who answer that it makes no sense; and so is what a
/// Register says, to the next function.
QString refusalOf(const Peer &peer, const QPlcMessage &message);
/// Why \a peer may not register so; empty: it may.
QString refusalOf(const Peer &peer, const messages::Register &registration);

}  // namespace qplc
