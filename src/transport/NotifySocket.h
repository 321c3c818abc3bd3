// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArray>
#include <QtCore/QString>

namespace qplc {

/// Where a service manager hears how its service is: the datagram socket that systemd and others
/// name in $NOTIFY_SOCKET. A datagram is a text of lines like READY=1.
class NotifySocket
{
public:
    /// \param address a path, or a name without a file behind '@'; empty: nobody listens, and every
    ///         send() succeeds
    explicit NotifySocket(const QByteArray &address);
    ~NotifySocket();
    NotifySocket(const NotifySocket &) = delete;
    NotifySocket &operator=(const NotifySocket &) = delete;

    /// Whether there is somebody who wants to hear.
    bool isWanted() const { return !m_address.isEmpty(); }
    /// Sends a datagram. Never waits: a listener that does not read misses it.
    /// \return false when it could not be sent: errorString() tells why
    bool send(const QByteArray &text);
    QString errorString() const { return m_error; }

private:
    bool fail(const QString &reason);

    QByteArray m_address;
    int m_descriptor = -1;
    QString m_error;
};

}  // namespace qplc
