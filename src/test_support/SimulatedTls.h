// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "transport/Tls.h"

namespace qplc {

class SimulatedHost;
class SimulatedSocket;

/// TLS of a simulated network. Encrypts nothing, since nobody listens there, and proves identities:
/// a client tells who it is and shows a digest of its key, and the server looks into its keys.
/// Certificates are not simulated.
///
/// It begins and is refused like TLS: a record of a ClientHello, and alerts.
class SimulatedTls final : public Tls
{
public:
    SimulatedTls(SimulatedHost &host, QObject *parent);

    QTcpSocket *socket() const override;
    void connectTo(const QHostAddress &master, quint16 port, const Terms &terms) override;
    void accept(const Terms &terms) override;
    void sendAlert(const QByteArray &bytes) override;
    bool isHandshaking() const override { return m_stage == Stage::Handshaking; }
    bool isEncrypted() const override { return m_stage == Stage::Encrypted; }
    qint64 encryptedBytesToWrite() const override { return 0; }
    QSslCipher suite() const override { return m_suite; }
    QString certificateName() const override { return {}; }
    QString certificateError() const override { return {}; }

private:
    enum class Stage : quint8 { Plain, Handshaking, Encrypted };

    explicit SimulatedTls(SimulatedSocket *socket);
    void begin(const Terms &terms);
    void greet();
    void readGreeting();
    void readAnswer();
    void end();

    SimulatedSocket *m_socket;
    Terms m_terms;
    QSslCipher m_suite;
    Stage m_stage = Stage::Plain;
};

}  // namespace qplc
