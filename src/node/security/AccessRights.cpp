// SPDX-License-Identifier: Apache-2.0
#include "AccessRights.h"

#include "node/Logging.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QRegularExpression>

#include <algorithm>

namespace qplc {

namespace {

/// Collects the names of the signals that a message writes.
struct WrittenSignals
{
    QStringList names;

    void operator()(const messages::Register &registration)
    {
        for (const messages::DeclaredSignal &output : registration.outputs)
            names << output.name;
    }
    void operator()(const messages::SetSignals &wish) { names = wish.values.keys(); }
    void operator()(const messages::TakeLease &wish) { names = wish.signals; }
    void operator()(const messages::ReleaseLease &wish) { names = wish.signals.value_or(QStringList()); }
};

bool matches(const QString &pattern, const QString &signal)
{
    return pattern == signal
        || QRegularExpression(QRegularExpression::wildcardToRegularExpression(pattern)).match(signal).hasMatch();
}

QString registrationRefusal(const Peer &peer, const messages::Register &registration)
{
    const QString &name = registration.name;
    if (peer.role == Role::Observer && !registration.listener)
        return QStringLiteral("Denied: role Observer may only listen: node '%1' is to be a listener without outputs, "
                              "or identity '%2' needs the role Node")
            .arg(printable(name), peer.identity);
    if (peer.role == Role::Node && name != peer.identity)
        return QStringLiteral("Denied: identity '%1' may not be node '%2'; a node with the role Node has the name of "
                              "its identity")
            .arg(peer.identity, printable(name));
    if (name != peer.identity && peer.known.contains(name))
        return QStringLiteral("Denied: identity '%1' may not be node '%2', which is another identity; choose another "
                              "name")
            .arg(peer.identity, name);
    return {};
}

}  // namespace

QString roleName(Role role)
{
    switch (role) {
    case Role::Observer:
        return QStringLiteral("Observer");
    case Role::Operator:
        return QStringLiteral("Operator");
    case Role::Node:
        return QStringLiteral("Node");
    case Role::Engineer:
        return QStringLiteral("Engineer");
    }
    return {};
}

std::optional<Role> roleOf(const QString &name)
{
    for (Role role : allRoles) {
        if (name == roleName(role))
            return role;
    }
    return std::nullopt;
}

QString shownName(const Peer &peer, const QString &called)
{
    if (!peer.isSecured)
        return called;
    return called.isEmpty() || called == peer.identity ? peer.identity
                                                       : QStringLiteral("%1 as \"%2\"").arg(peer.identity, called);
}

QStringList signalsWrittenBy(const QPlcMessage &message)
{
    WrittenSignals written;
    QString ignored;
    messages::dispatch(messages::WriteSignals(), message, written, &ignored);
    return written.names;
}

bool mayWrite(const Peer &peer, const QString &signal)
{
    if (peer.role == Role::Observer)
        return false;
    return peer.mayWriteAll || std::any_of(peer.writes.begin(), peer.writes.end(), [&](const QString &pattern) {
               return matches(pattern, signal);
           });
}

QString refusalOf(const Peer &peer, const QPlcMessage &message)
{
    if (peer.isCyclicOnly && message.kind() != QPlcMessage::AttachCyclicChannel)
        return QStringLiteral("Denied: %1 on a connection without TLS").arg(message.kindName());
    if (!peer.isSecured)
        return {};
    const Roles roles = whoMaySend(message.kind());
    if (!roles.isEmpty() && !roles.contains(peer.role))
        return QStringLiteral("Denied: role %1 may not send %2").arg(roleName(peer.role), message.kindName());
    if (const auto registration = messages::readAs<messages::Register>(message)) {
        const QString refusal = registrationRefusal(peer, *registration);
        if (!refusal.isEmpty())
            return refusal;
    }
    for (const QString &signal : signalsWrittenBy(message)) {
        if (!mayWrite(peer, signal))
            return QStringLiteral("Denied: identity '%1' with role %2 may not write signal '%3'")
                .arg(peer.identity, roleName(peer.role), printable(signal));
    }
    return {};
}

}  // namespace qplc
