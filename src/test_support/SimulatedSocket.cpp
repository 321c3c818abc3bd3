// SPDX-License-Identifier: Apache-2.0
#include "SimulatedSocket.h"

#include "SimulatedHost.h"

#include <QtCore/QPointer>

#include <algorithm>
#include <cstring>
#include <utility>

namespace qplc {

SimulatedSocket::SimulatedSocket(SimulatedHost &host, QObject *parent)
    : QTcpSocket(parent)
    , m_host(host)
{
}

SimulatedSocket::~SimulatedSocket()
{
    blockSignals(true);
    leave();
    setSocketState(UnconnectedState);  // else ~QAbstractSocket() ends what has ended
}

void SimulatedSocket::connectToHost(const QHostAddress &address, quint16 port, OpenMode)
{
    leave();
    m_rest.clear();
    m_end = std::make_shared<ControlEnd>(m_host);
    m_end->setSocket(this);
    setSocketState(ConnectingState);
    Q_EMIT stateChanged(ConnectingState);
    setPeerAddress(address);
    setPeerPort(port);
    m_end->connectTo(address, port);
}

bool SimulatedSocket::setSocketDescriptor(qintptr descriptor, SocketState, OpenMode)
{
    std::shared_ptr<ControlEnd> end = m_host.simulator().controlWire().takeAccepted(int(descriptor));
    if (!end)
        return false;
    attach(end);
    return true;
}

void SimulatedSocket::attach(const std::shared_ptr<ControlEnd> &end)
{
    m_end = end;
    setOpenMode(ReadWrite);
    setLocalAddress(end->localAddress());
    setLocalPort(end->localPort());
    setPeerAddress(end->peerAddress());
    setPeerPort(end->peerPort());
    setSocketState(ConnectedState);
    end->setSocket(this);
}

void SimulatedSocket::becomeConnected()
{
    attach(m_end);
    Q_EMIT stateChanged(ConnectedState);
    Q_EMIT connected();
}

void SimulatedSocket::beRefused()
{
    leave();
    fail(ConnectionRefusedError, QStringLiteral("Connection refused"));
}

void SimulatedSocket::beReadable()
{
    if (const std::function<void()> reader = m_reader)  // it may be replaced meanwhile
        reader();
    else
        Q_EMIT readyRead();
}

void SimulatedSocket::beDrained(qint64 bytes)
{
    Q_EMIT bytesWritten(bytes);
}

void SimulatedSocket::beClosed()
{
    const QPointer<SimulatedSocket> self(this);
    setSocketError(RemoteHostClosedError);
    setErrorString(QStringLiteral("The remote host closed the connection"));
    Q_EMIT errorOccurred(RemoteHostClosedError);
    if (self && state() == ConnectedState)
        disconnectFromHost();
}

/// The kernel has heard nothing of the other end for too long.
void SimulatedSocket::beGivenUp()
{
    const QPointer<SimulatedSocket> self(this);
    setSocketError(SocketTimeoutError);
    setErrorString(QStringLiteral("Connection timed out"));
    Q_EMIT errorOccurred(SocketTimeoutError);
    if (self)
        close();
}

void SimulatedSocket::fail(SocketError error, const QString &text)
{
    const QPointer<SimulatedSocket> self(this);
    setSocketError(error);
    setErrorString(text);
    setSocketState(UnconnectedState);
    Q_EMIT stateChanged(UnconnectedState);
    if (self)
        Q_EMIT errorOccurred(error);
}

void SimulatedSocket::disconnectFromHost()
{
    if (!m_end)
        return;
    m_end->close();
    endConnection();
}

/// By abort(), too.
void SimulatedSocket::close()
{
    if (!m_end)
        return;
    m_end->reset();
    endConnection();
}

void SimulatedSocket::endConnection()
{
    const bool wasConnected = state() == ConnectedState;
    m_rest = m_end->takeUnread();
    leave();
    if (m_rest.isEmpty())
        QIODevice::close();
    setSocketState(UnconnectedState);
    const QPointer<SimulatedSocket> self(this);
    Q_EMIT stateChanged(UnconnectedState);
    if (self && wasConnected)
        Q_EMIT disconnected();
}

void SimulatedSocket::leave()
{
    if (const std::shared_ptr<ControlEnd> end = std::exchange(m_end, nullptr)) {
        end->setSocket(nullptr);
        end->reset();  // nothing, if it has been closed
    }
}

qint64 SimulatedSocket::bytesAvailable() const
{
    return QIODevice::bytesAvailable() + (m_end ? m_end->readable() : m_rest.size());
}

qint64 SimulatedSocket::bytesToWrite() const
{
    return m_end ? m_end->unsent() : 0;
}

qint64 SimulatedSocket::readData(char *bytes, qint64 most)
{
    if (m_end)
        return m_end->read(bytes, most);
    const auto size = int(std::min<qint64>(most, m_rest.size()));
    if (size <= 0)
        return 0;
    std::memcpy(bytes, m_rest.constData(), std::size_t(size));
    m_rest.remove(0, size);
    return size;
}

qint64 SimulatedSocket::writeData(const char *bytes, qint64 size)
{
    if (!m_end)
        return -1;
    m_end->write(bytes, size);
    return size;
}

}  // namespace qplc
