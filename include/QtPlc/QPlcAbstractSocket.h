// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"

#include <QtCore/QObject>
#include <QtNetwork/QHostAddress>

#include <memory>

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

/// A control connection: sends and receives QPlcMessages over TCP.
///
/// \threadsafe no: lives in the thread of its owner and needs its event loop
class QTPLC_EXPORT QPlcAbstractSocket : public QObject
{
    Q_OBJECT
public:
    enum Error {
        NoError,
        HostNotFoundError,
        ConnectionRefusedError,  ///< nobody listens there
        TimeoutError,            ///< no answer in time
        ConnectionLostError,     ///< the other end is gone
        ProtocolError,           ///< what came is no QtPLC message; the connection has been closed
        NetworkError             ///< everything else: see errorString()
    };
    Q_ENUM(Error)

    ~QPlcAbstractSocket() override;

    bool isConnected() const;
    /// Sends \a message. \return false when there is no connection
    bool sendMessage(const QPlcMessage &message);
    /// Bytes that wait to be sent because the other end is slow.
    qint64 bytesToSend() const;
    /// Sends what is waiting, then closes the connection.
    void close();
    /// Closes the connection at once.
    void abort();

    QHostAddress peerAddress() const;
    quint16 peerPort() const;
    QString peerName() const;  ///< "127.0.0.1:40312"
    Error error() const;
    /// What went wrong, with whom; empty: nothing.
    QString errorString() const;

    /// Takes the connection out of this object, for a cyclic channel: the caller owns the descriptor, this object is disconnected without a
    /// sound. \return -1 when there is no connection
    int takeDescriptor();

Q_SIGNALS:
    void connected();
    void disconnected();
    void messageReceived(const QPlcMessage &message);
    void errorOccurred(QPlcAbstractSocket::Error error);

protected:
    QPlcAbstractSocket(QTcpSocket *socket, QObject *parent);
    QTcpSocket *socket() const;
    void setError(Error error, const QString &text);

private:
    void readMessages();
    void readError();

    struct Private;
    std::unique_ptr<Private> d;
};
