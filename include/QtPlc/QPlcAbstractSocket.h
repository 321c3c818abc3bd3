// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcMessage.h"

#include <QtCore/QObject>
#include <QtNetwork/QHostAddress>

#include <memory>

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

namespace qplc {
class PacedReading;
}

/// A control connection: it sends and receives QPlcMessages over TCP, or over TLS if QPlcSecurity
/// asks for it. QPlcMasterSocket is the end of a node or tool, QPlcSlaveSocket that of a master.
///
/// \code
/// auto *socket = new QPlcMasterSocket(qApp);
/// QObject::connect(socket, &QPlcAbstractSocket::messageReceived, [](const QPlcMessage &message) {
///     qInfo("%s", qPrintable(message.kindName()));
/// });
/// socket->connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost));
/// \endcode
///
/// Memory is bounded: if the other end does not read, this end stops reading its messages at 1 MiB
/// of unsent data.
///
/// \threadsafe no: the object lives in the thread of its owner and needs its event loop
///
/// \ingroup network
class QTPLC_EXPORT QPlcAbstractSocket : public QObject
{
    Q_OBJECT
public:
    /// Kinds of errors.
    enum Error {
        NoError,                 ///< nothing has failed
        HostNotFoundError,       ///< the name of the host is unknown
        ConnectionRefusedError,  ///< no program listens at this address
        TimeoutError,            ///< no answer in time
        ConnectionLostError,     ///< the other end has closed the connection
        /// The received bytes are not a QtPLC message; the connection has been closed.
        ProtocolError,
        NetworkError,  ///< another error: see errorString()
        /// The ends do not accept each other, or a file of the security settings is wrong.
        SecurityError
    };
    Q_ENUM(Error)

    /// Closes the connection at once, without a signal.
    ~QPlcAbstractSocket() override;

    /// Returns true if messages can be sent: the connection and, with security, the TLS handshake
    /// are complete.
    bool isConnected() const;
    /// Returns true if the connection uses TLS and the other end has proven its identity.
    bool isSecured() const;
    /// Sends a message. A slow receiver does not block the call: see bytesToSend().
    /// \return false without a connection, and for a message that is longer than setSendLimit()
    ///     allows, or nested deeper than 16 levels
    bool sendMessage(const QPlcMessage &message);
    /// Returns the number of bytes that wait here because the other end is slow.
    qint64 bytesToSend() const;
    /// Sends what waits, then closes the connection. disconnected() follows.
    void close();
    /// Closes the connection at once; bytes that wait are lost.
    void abort();

    /// Returns the address of this end; null without a connection.
    QHostAddress localAddress() const;
    /// Returns the port of this end; 0 without a connection.
    quint16 localPort() const;
    /// Returns the address of the other end; null without a connection.
    QHostAddress peerAddress() const;
    /// Returns the port of the other end; 0 without a connection.
    quint16 peerPort() const;
    /// Returns address and port of the other end for people: "127.0.0.1:40312".
    QString peerName() const;
    /// Returns the kind of the last error.
    Error error() const;
    /// Returns the last error as a sentence; empty: there was none.
    QString errorString() const;

    /// Sets the longest message that is accepted from now on; a longer one is a ProtocolError.
    /// \param bytes  default 1 MiB
    void setMessageLimit(quint32 bytes);
    /// Sets the longest message that the other end accepts from now on.
    /// \param bytes  default 1 MiB
    void setSendLimit(quint32 bytes);

    /// Takes the connection out of this object, for a cyclic channel. The caller owns the
    /// descriptor and closes it. This object disconnects without emitting disconnected().
    /// \return -1 without a connection
    int takeDescriptor();

Q_SIGNALS:
    /// Emitted when the connection is complete, with security after the handshake.
    void connected();
    /// Emitted when the connection has ended, for any reason.
    void disconnected();
    /// Emitted for each message. A receiver may delete this object.
    void messageReceived(const QPlcMessage &message);
    /// Emitted for each error; errorString() has the reason.
    void errorOccurred(QPlcAbstractSocket::Error error);

protected:
    /// Makes a connection out of a socket.
    /// \param socket  becomes owned; it may be connected already
    /// \param parent  owns this object, if given
    QPlcAbstractSocket(QTcpSocket *socket, QObject *parent);
    /// Returns the socket; this object owns it.
    QTcpSocket *socket() const;
    /// Replaces the socket. The former one is deleted later, without a signal.
    /// \param socket  not connected yet; becomes owned
    void setSocket(QTcpSocket *socket);
    /// Returns a sentence about an error of TLS, which replaces the text of the socket; empty: the
    /// error has nothing to do with TLS. The default is empty.
    virtual QString securityErrorText() const { return {}; }
    /// Sets error() and errorString(), and emits errorOccurred(). A receiver may delete this
    /// object.
    void setError(Error error, const QString &text);

private:
    friend class qplc::PacedReading;
    Q_DECL_HIDDEN void readMessages();
    Q_DECL_HIDDEN bool readMessage();
    Q_DECL_HIDDEN bool sendFrame(const QByteArray &frame, QPlcMessage::Kind kind);
    Q_DECL_HIDDEN void readError();

    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
