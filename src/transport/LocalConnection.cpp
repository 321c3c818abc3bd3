// SPDX-License-Identifier: Apache-2.0
#include "LocalConnection.h"

#include "DescriptorMessage.h"
#include "LocalSocket.h"
#include "realtime/Host.h"

#include <cerrno>

namespace qplc {

bool LocalConnection::open(std::uint64_t session, QString *error)
{
    sockaddr_un address;
    const socklen_t length = LocalSocket::addressOf(session, &address);
    m_socket = LocalSocket::make();
    if (!m_socket.isOpen() || ::connect(m_socket.number(), reinterpret_cast<const sockaddr *>(&address), length) < 0) {
        *error = errno == EAGAIN
            ? QStringLiteral("too many programs connect to the master at a time; try again, or use udp")
            : QStringLiteral("the master takes no local nodes here: %1; use udp").arg(systemErrorText());
        return false;
    }
    const uid_t user = LocalSocket::userOfPeer(m_socket.number());
    if (user != ::geteuid()) {
        *error = QStringLiteral("the master runs as user %1, and this node as user %2, so they share no memory; run "
                                "both as the same user, or use udp")
                     .arg(user)
                     .arg(::geteuid());
        return false;
    }
    m_key = Host::current().random();
    if (sendDescriptors(m_socket.number(), m_key, {}))
        return true;
    *error = QStringLiteral("cannot send to the master: %1; use udp").arg(systemErrorText());
    return false;
}

std::vector<Descriptor> LocalConnection::take(std::size_t count, QString *error)
{
    const Descriptor socket = std::move(m_socket);
    std::optional<DescriptorMessage> message = receiveDescriptors(socket.number());
    if (!message)
        *error = errno == EAGAIN ? QStringLiteral("the master has registered this node and passed no memory to it")
                                 : QStringLiteral("the master has passed no memory: %1").arg(systemErrorText());
    else if (message->key != m_key)
        *error = QStringLiteral("what the master has passed is for another registration");
    else if (message->descriptors.size() != count)
        *error = QStringLiteral("the master has passed %1 descriptors instead of %2")
                     .arg(message->descriptors.size())
                     .arg(count);
    else
        return std::move(message->descriptors);
    return {};
}

}  // namespace qplc
