// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtNetwork/QHostAddress>
#include <QtNetwork/QTcpSocket>

#include <memory>

namespace qplc {

class Tls;

/// A port that listens for control connections.
class ControlPort
{
public:
    ControlPort() = default;
    virtual ~ControlPort();
    ControlPort(const ControlPort &) = delete;
    ControlPort &operator=(const ControlPort &) = delete;

    /// Readable while a connection waits; for QSocketNotifier.
    virtual int descriptor() const = 0;
    virtual QHostAddress address() const = 0;
    virtual quint16 number() const = 0;
    /// The next connection, non-blocking; the caller owns it. \return -1, with errno set, when
    /// there is none
    virtual int accept() = 0;
};

/// The network on which control connections are made: that of the kernel, or a simulated one.
class ControlNetwork
{
public:
    virtual ~ControlNetwork();

    /// That of Host::current().
    static ControlNetwork &current();

    /// A socket that is not connected; it belongs to \a parent.
    virtual QTcpSocket *makeSocket(QObject *parent) = 0;
    /// As makeSocket(), for a connection with TLS; the socket owns the result.
    virtual Tls *makeTls(QObject *parent) = 0;
    /// Null, with the reason in \a error and \a text, when \a address cannot be listened at. \param
    /// port 0: any
    virtual std::unique_ptr<ControlPort> listen(const QHostAddress &address, quint16 port,
                                                QAbstractSocket::SocketError *error, QString *text)
        = 0;
    /// The other end of the connection \a descriptor. Null: it has none any more.
    virtual QHostAddress peerOf(int descriptor) = 0;
    virtual void close(int descriptor) = 0;
};

}  // namespace qplc
