// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>
#include <QtNetwork/QHostAddress>
#include <QtNetwork/QSslCipher>
#include <QtNetwork/QSslConfiguration>

#include <functional>

QT_BEGIN_NAMESPACE
class QTcpSocket;
QT_END_NAMESPACE

namespace qplc {

/// TLS on a control connection: that of OpenSSL, or that of a simulated network.
///
/// \code
/// Tls *tls = ControlNetwork::current().makeTls(nullptr);
/// connect(tls, &Tls::encrypted, ...);                                   // the handshake succeeded
/// connect(tls->socket(), &QAbstractSocket::errorOccurred, ...);         // or it failed
/// tls->connectTo(address, port, {configuration, identity, keyOf, {}});  // a node or a tool
/// \endcode
///
/// A socket has been made for it, and owns it. \threadsafe no
class Tls : public QObject
{
    Q_OBJECT
public:
    struct Terms
    {
        QSslConfiguration configuration;  ///< suites, certificates
        QString identity;                 ///< of a node or tool with pre-shared keys
        /// With pre-shared keys: the key of an identity; empty: there is none.
        std::function<QByteArray(const QString &identity)> keyOf;
        QString masterIdentity;  ///< name in the certificate of the master
    };

    /// The one of \a socket. Null: it has none.
    static Tls *of(const QTcpSocket *socket);

    virtual QTcpSocket *socket() const = 0;
    /// Connects, and begins the handshake of a client.
    virtual void connectTo(const QHostAddress &master, quint16 port, const Terms &terms) = 0;
    /// Begins the handshake of a server, on a socket that is connected.
    virtual void accept(const Terms &terms) = 0;
    /// Sends \a bytes beside the socket, which is closing.
    virtual void sendAlert(const QByteArray &bytes) = 0;

    virtual bool isHandshaking() const = 0;
    virtual bool isEncrypted() const = 0;
    virtual qint64 encryptedBytesToWrite() const = 0;
    virtual QSslCipher suite() const = 0;
    /// The name in the certificate of the other end. Empty: it has none.
    virtual QString certificateName() const = 0;
    /// Why that certificate is not believed. Empty: it is, or there is none. A server goes on
    /// nevertheless, to be able to tell.
    virtual QString certificateError() const = 0;

Q_SIGNALS:
    void encrypted();
    /// Of what encryptedBytesToWrite() counts, some is on its way.
    void encryptedBytesWritten();

protected:
    explicit Tls(QTcpSocket *socket);
};

}  // namespace qplc
