// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"

#include <QtCore/QObject>
#include <QtNetwork/QHostAddress>

#include <memory>

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

/// A control connection: sends and receives QPlcMessages over TCP, or over TLS when there is a QPlcSecurity.
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
        NetworkError,            ///< everything else: see errorString()
        SecurityError  ///< the two ends do not accept each other, or a file of the QPlcSecurity cannot be used
    };
    Q_ENUM(Error)

    ~QPlcAbstractSocket() override;

    bool isConnected() const;
    /// Whether the connection is TLS, and the other end was found to be who it says.
    bool isSecured() const;
    /// Sends \a message. \return false when there is no connection
    bool sendMessage(const QPlcMessage &message);
    /// Bytes that wait to be sent because the other end is slow.
    qint64 bytesToSend() const;
    /// Sends what is waiting, then closes the connection.
    void close();
    /// Closes the connection at once.
    void abort();

    QHostAddress localAddress() const;
    quint16 localPort() const;
    QHostAddress peerAddress() const;
    quint16 peerPort() const;
    QString peerName() const;  ///< "127.0.0.1:40312"
    Error error() const;
    /// What went wrong, with whom; empty: nothing.
    QString errorString() const;

    /// Longest message that is taken from here on [byte]; 1 MiB unless set. A longer one is a ProtocolError.
    void setMessageLimit(quint32 bytes);

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
    /// Uses another socket, which is not connected yet and becomes owned.
    void setSocket(QTcpSocket *socket);
    /// What is said of an error of the socket, in place of its own words. \return empty: those
    virtual QString securityErrorText() const { return {}; }
    void setError(Error error, const QString &text);

private:
    void readMessages();
    void readError();

    struct Private;
    std::unique_ptr<Private> d;
};
