// SPDX-License-Identifier: Apache-2.0
#include "ControlNetwork.h"

#include "OpenSslTls.h"
#include "SocketAddress.h"
#include "realtime/Host.h"

#include <QtNetwork/QTcpServer>

#include <sys/socket.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int Queue = 512;  // of who has not been taken yet: all nodes of a plant may come back at once

/// QTcpServer itself would take every connection, and would spin when the process has no descriptor
/// left.
class KernelPort final : public ControlPort
{
public:
    bool listen(const QHostAddress &address, quint16 port)
    {
        if (!m_server.listen(address, port))
            return false;
        ::listen(descriptor(), Queue);  // Qt asks for 50
        m_server.pauseAccepting();      // its notifier is off: the caller has one of its own
        return true;
    }
    const QTcpServer &server() const { return m_server; }

    int descriptor() const override { return int(m_server.socketDescriptor()); }
    QHostAddress address() const override { return m_server.serverAddress(); }
    quint16 number() const override { return m_server.serverPort(); }
    int accept() override { return ::accept4(descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC); }

private:
    QTcpServer m_server;
};

class KernelNetwork final : public ControlNetwork
{
public:
    QTcpSocket *makeSocket(QObject *parent) override { return new QTcpSocket(parent); }
    Tls *makeTls(QObject *parent) override { return new OpenSslTls(parent); }
    std::unique_ptr<ControlPort> listen(const QHostAddress &address, quint16 number,
                                        QAbstractSocket::SocketError *error, QString *text) override
    {
        auto port = std::make_unique<KernelPort>();
        if (port->listen(address, number))
            return port;
        *error = port->server().serverError();
        *text = port->server().errorString();
        return nullptr;
    }
    QHostAddress peerOf(int descriptor) override
    {
        SocketAddress address;
        address.length = sizeof address.storage;
        if (::getpeername(descriptor, address.data(), &address.length) < 0)
            return {};
        return QHostAddress(address.data());
    }
    void close(int descriptor) override { ::close(descriptor); }
};

}  // namespace

ControlPort::~ControlPort() = default;
ControlNetwork::~ControlNetwork() = default;

ControlNetwork &ControlNetwork::current()
{
    static KernelNetwork kernel;
    ControlNetwork *simulated = Host::current().controlNetwork();
    return simulated ? *simulated : kernel;
}

}  // namespace qplc
