// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtNetwork/QHostAddress>
#include <QtNetwork/QTcpSocket>

#include <algorithm>
#include <cstring>

namespace fuzz {

/// A connection without a network: what is to be received is given by the test, and what is sent is
/// forgotten.
class MemorySocket : public QTcpSocket
{
public:
    MemorySocket()
    {
        setPeerAddress(QHostAddress::LocalHost);
        setPeerPort(40000);
        setSocketState(ConnectedState);
        setOpenMode(ReadWrite | Unbuffered);
    }

    void arrive(const QByteArray &bytes)
    {
        m_bytes += bytes;
        Q_EMIT readyRead();
    }
    void disconnectFromHost() override { end(); }
    qint64 bytesAvailable() const override { return m_bytes.size(); }

protected:
    qint64 readData(char *data, qint64 maximum) override
    {
        const auto size = std::min<qint64>(maximum, m_bytes.size());
        std::memcpy(data, m_bytes.constData(), std::size_t(size));
        m_bytes.remove(0, int(size));
        return size;
    }
    qint64 writeData(const char *, qint64 size) override { return size; }

private:
    void end()
    {
        if (state() == UnconnectedState)
            return;
        setSocketState(UnconnectedState);
        setOpenMode(NotOpen);
        Q_EMIT disconnected();
    }

    QByteArray m_bytes;
};

}  // namespace fuzz
