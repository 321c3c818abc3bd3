// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ControlWire.h"

#include <QtNetwork/QTcpSocket>

#include <functional>

namespace qplc {

/// A QTcpSocket whose bytes travel on the ControlWire. What needs a kernel (descriptors, options,
/// waits) it does not do.
class SimulatedSocket final : public QTcpSocket
{
public:
    SimulatedSocket(SimulatedHost &host, QObject *parent);
    ~SimulatedSocket() override;

    void connectToHost(const QHostAddress &address, quint16 port, OpenMode mode) override;
    void disconnectFromHost() override;
    bool setSocketDescriptor(qintptr descriptor, SocketState state, OpenMode mode) override;
    qintptr socketDescriptor() const override { return -1; }
    void setSocketOption(SocketOption, const QVariant &) override {}
    qint64 bytesAvailable() const override;
    qint64 bytesToWrite() const override;
    void close() override;

    // ---- from the ControlEnd ----

    void becomeConnected();
    void beRefused();
    void beReadable();
    void beDrained(qint64 bytes);
    void beClosed();
    void beGivenUp();

    // ---- from SimulatedTls ----

    /// Gets what arrives instead of the readers of the socket. Null: they get it.
    void setReader(const std::function<void()> &reader) { m_reader = reader; }
    void fail(SocketError error, const QString &text);

protected:
    qint64 readData(char *bytes, qint64 most) override;
    qint64 writeData(const char *bytes, qint64 size) override;

private:
    void attach(const std::shared_ptr<ControlEnd> &end);
    void leave();
    void endConnection();

    SimulatedHost &m_host;
    std::shared_ptr<ControlEnd> m_end;  // null: not connected
    std::function<void()> m_reader;
    QByteArray m_rest;  // that came before the end of the connection and has not been read
};

}  // namespace qplc
