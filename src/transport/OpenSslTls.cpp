// SPDX-License-Identifier: Apache-2.0
#include "OpenSslTls.h"

#include <QtNetwork/QSslCertificate>
#include <QtNetwork/QSslPreSharedKeyAuthenticator>

#include <sys/socket.h>

namespace qplc {

OpenSslTls::OpenSslTls(QObject *parent)
    : OpenSslTls(new QSslSocket(parent))
{
}

OpenSslTls::OpenSslTls(QSslSocket *socket)
    : Tls(socket)
    , m_socket(socket)
{
    connect(socket, &QSslSocket::encrypted, this, [this] {
        m_terms = Terms();  // keys stay no longer than they are needed
        Q_EMIT encrypted();
    });
    connect(socket, &QSslSocket::encryptedBytesWritten, this, &Tls::encryptedBytesWritten);
    connect(socket, &QSslSocket::preSharedKeyAuthenticationRequired, this, &OpenSslTls::giveKey);
    connect(socket, QOverload<const QList<QSslError> &>::of(&QSslSocket::sslErrors), this,
            &OpenSslTls::refuseCertificate);
}

void OpenSslTls::connectTo(const QHostAddress &master, quint16 port, const Terms &terms)
{
    m_terms = terms;
    m_socket->setSslConfiguration(terms.configuration);
    m_socket->connectToHostEncrypted(master.toString(), port, terms.masterIdentity);
}

void OpenSslTls::accept(const Terms &terms)
{
    m_terms = terms;
    m_socket->setSslConfiguration(terms.configuration);
    m_socket->startServerEncryption();
}

/// QSslSocket closes the connection without the alert that OpenSSL has prepared.
void OpenSslTls::sendAlert(const QByteArray &bytes)
{
    ::send(int(m_socket->socketDescriptor()), bytes.constData(), std::size_t(bytes.size()),
           MSG_NOSIGNAL | MSG_DONTWAIT);
}

bool OpenSslTls::isHandshaking() const
{
    return m_socket->mode() != QSslSocket::UnencryptedMode && !m_socket->isEncrypted();
}

QString OpenSslTls::certificateName() const
{
    return m_socket->peerCertificate().subjectInfo(QSslCertificate::CommonName).value(0);
}

/// Without a key the handshake fails.
void OpenSslTls::giveKey(QSslPreSharedKeyAuthenticator *authenticator)
{
    const bool isServer = m_socket->mode() == QSslSocket::SslServerMode;
    const QString identity = isServer ? QString::fromUtf8(authenticator->identity()) : m_terms.identity;
    const QByteArray key = m_terms.keyOf ? m_terms.keyOf(identity) : QByteArray();
    if (key.isEmpty())
        return;
    authenticator->setIdentity(identity.toUtf8());
    authenticator->setPreSharedKey(key);
}

/// A server goes on until the other end can be told.
void OpenSslTls::refuseCertificate(const QList<QSslError> &errors)
{
    m_certificateError = errors.constFirst().errorString();
    if (m_socket->mode() == QSslSocket::SslServerMode)
        m_socket->ignoreSslErrors();
}

}  // namespace qplc
