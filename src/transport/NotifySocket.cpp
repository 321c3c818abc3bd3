// SPDX-License-Identifier: Apache-2.0
#include "NotifySocket.h"

#include "SocketAddress.h"

#include <algorithm>
#include <cstddef>
#include <sys/un.h>
#include <unistd.h>

namespace qplc {

namespace {

/// \return its size; 0: \a text is no such address
socklen_t toSocketAddress(const QByteArray &text, sockaddr_un *address)
{
    const bool isPath = text.startsWith('/');
    const bool isName = text.startsWith('@') && text.size() > 1;
    const auto size = std::size_t(text.size());
    if ((!isPath && !isName) || size >= sizeof address->sun_path)
        return 0;
    *address = {};
    address->sun_family = AF_UNIX;
    std::copy(text.begin(), text.end(), address->sun_path);
    if (isName)
        address->sun_path[0] = '\0';
    return socklen_t(offsetof(sockaddr_un, sun_path) + size + (isPath ? 1 : 0));
}

}  // namespace

NotifySocket::NotifySocket(const QByteArray &address)
    : m_address(address)
{
    if (isWanted())
        m_descriptor = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

NotifySocket::~NotifySocket()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

bool NotifySocket::send(const QByteArray &text)
{
    if (!isWanted())
        return true;
    sockaddr_un address;
    const socklen_t size = toSocketAddress(m_address, &address);
    if (size == 0)
        return fail(QStringLiteral("it is neither a path nor a name behind '@' of at most %1 bytes")
                        .arg(sizeof address.sun_path - 1));
    const auto *target = reinterpret_cast<const sockaddr *>(&address);
    if (m_descriptor < 0
        || ::sendto(m_descriptor, text.constData(), std::size_t(text.size()), MSG_NOSIGNAL, target, size) < 0)
        return fail(systemErrorText());
    return true;
}

bool NotifySocket::fail(const QString &reason)
{
    m_error = QStringLiteral("NOTIFY_SOCKET=%1: %2").arg(QString::fromLocal8Bit(m_address), reason);
    return false;
}

}  // namespace qplc
