// SPDX-License-Identifier: Apache-2.0
#include "AccessRights.h"

#include "node/Logging.h"
#include "protocol/messages/MessageTable.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QSet>

#include <algorithm>
#include <vector>

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

bool writesAll(const Peer &peer)
{
    return peer.mayWriteAll && peer.role != Role::Observer;
}

/// The signals that somebody may write.
class Writable
{
public:
    explicit Writable(const Peer &peer)
        : m_areAll(writesAll(peer))
    {
        if (m_areAll || peer.role == Role::Observer)
            return;
        static const QRegularExpression signOfPattern(QStringLiteral("[*?[]"));
        for (const QString &text : peer.writes) {
            m_names.insert(text);
            if (text.contains(signOfPattern))
                m_patterns.emplace_back(QRegularExpression::wildcardToRegularExpression(text));
        }
    }

    bool contains(const QString &signal) const
    {
        return m_areAll || m_names.contains(signal)
            || std::any_of(m_patterns.begin(), m_patterns.end(),
                           [&](const QRegularExpression &pattern) { return pattern.match(signal).hasMatch(); });
    }

private:
    const bool m_areAll;
    QSet<QString> m_names;
    std::vector<QRegularExpression> m_patterns;
};

QString writingRefusal(const Peer &peer, const QStringList &names)
{
    const Writable writable(peer);
    for (const QString &signal : names) {
        if (!writable.contains(signal))
            return QStringLiteral("Denied: identity '%1' with role %2 may not write signal '%3'")
                .arg(peer.identity, roleName(peer.role), printable(signal));
    }
    return {};
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

QString refusalOf(const Peer &peer, QPlcMessage::Kind kind)
{
    if (peer.isCyclicOnly && kind != QPlcMessage::AttachCyclicChannel)
        return QStringLiteral("Denied: %1 on a connection without TLS").arg(QPlcMessage::kindName(kind));
    if (!peer.isSecured)
        return {};
    const Roles roles = whoMaySend(kind);
    if (!roles.isEmpty() && !roles.contains(peer.role))
        return QStringLiteral("Denied: role %1 may not send %2").arg(roleName(peer.role), QPlcMessage::kindName(kind));
    return {};
}

QString refusalOf(const Peer &peer, const QPlcMessage &message)
{
    const QString refusal = refusalOf(peer, message.kind());
    if (!refusal.isEmpty() || !peer.isSecured || message.kind() == QPlcMessage::Register || writesAll(peer))
        return refusal;
    return writingRefusal(peer, signalsWrittenBy(message));
}

QString refusalOf(const Peer &peer, const messages::Register &registration)
{
    if (!peer.isSecured)
        return {};
    WrittenSignals written;
    written(registration);
    const QString refusal = registrationRefusal(peer, registration);
    return refusal.isEmpty() ? writingRefusal(peer, written.names) : refusal;
}

}  // namespace qplc
