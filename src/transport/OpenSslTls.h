// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Tls.h"

#include <QtNetwork/QSslSocket>

namespace qplc {

/// TLS as a QSslSocket speaks it.
class OpenSslTls final : public Tls
{
public:
    /// \param parent  of the socket
    explicit OpenSslTls(QObject *parent);

    QTcpSocket *socket() const override { return m_socket; }
    void connectTo(const QHostAddress &master, quint16 port, const Terms &terms) override;
    void accept(const Terms &terms) override;
    void sendAlert(const QByteArray &bytes) override;
    bool isHandshaking() const override;
    bool isEncrypted() const override { return m_socket->isEncrypted(); }
    qint64 encryptedBytesToWrite() const override { return m_socket->encryptedBytesToWrite(); }
    QSslCipher suite() const override { return m_socket->sessionCipher(); }
    QString certificateName() const override;
    QString certificateError() const override { return m_certificateError; }

private:
    explicit OpenSslTls(QSslSocket *socket);
    void giveKey(QSslPreSharedKeyAuthenticator *authenticator);
    void refuseCertificate(const QList<QSslError> &errors);

    QSslSocket *m_socket;
    Terms m_terms;
    QString m_certificateError;
};

}  // namespace qplc
