// SPDX-License-Identifier: Apache-2.0
#include "Handshake.h"

#include "node/Logging.h"
#include "protocol/ControlFrame.h"
#include "protocol/messages/MessageTable.h"
#include "transport/ControlNetwork.h"
#include "transport/Tls.h"

#include <QtNetwork/QHostAddress>
#include <QtNetwork/QTcpSocket>

namespace qplc {

namespace {

constexpr int enoughToTell = 6;  // bytes of a ClientHello up to the first that no control message has there
constexpr int kindOffset = 4;    // of a control frame

QByteArray rejection(const QString &error, const QString &text)
{
    return encodeControlFrame(messages::toMessage(messages::Rejected{error, text}));
}

enum class Language : quint8 { NotYetKnown, Tls, Plain };

/// A ClientHello begins with 16 03, has the length in bytes 3 and 4, and then 01, where the body of
/// a control message begins with '{'.
Language languageOf(const QByteArray &begin)
{
    const QByteArray tls = QByteArrayLiteral("\x16\x03");
    if (!begin.startsWith(tls.left(begin.size())))
        return Language::Plain;
    if (begin.size() < enoughToTell)
        return Language::NotYetKnown;
    return begin.at(enoughToTell - 1) == 0x01 ? Language::Tls : Language::Plain;
}

/// A fatal alert, as TLS sends it before anything is encrypted.
QByteArray alert(TlsAlert::Description description)
{
    return QByteArrayLiteral("\x15\x03\x03\x00\x02\x02") + char(description);
}

}  // namespace

Handshake::Handshake(int descriptor, const QPlcSecurity &security, QObject *parent)
    : QObject(parent)
    , m_security(security)
{
    if (!security.isNone())
        m_tls = ControlNetwork::current().makeTls(this);
    m_socket = m_tls ? m_tls->socket() : ControlNetwork::current().makeSocket(this);
    m_socket->setReadBufferSize(64 * 1024);
    m_socket->setSocketDescriptor(descriptor);
    m_address = QStringLiteral("%1:%2").arg(m_socket->peerAddress().toString()).arg(m_socket->peerPort());
    connect(m_socket, &QTcpSocket::readyRead, this, &Handshake::look);
    connect(m_socket, &QTcpSocket::disconnected, this, [this] { tlsFailed(); });
}

Handshake::~Handshake() = default;

QTcpSocket *Handshake::takeSocket()
{
    m_socket->disconnect(this);
    m_socket->setReadBufferSize(0);
    m_socket->setParent(nullptr);
    return m_socket;
}

QString Handshake::claimedIdentity() const
{
    return printable(m_peer.identity.isEmpty() ? m_unknownIdentity : m_peer.identity);
}

QString Handshake::stage() const
{
    return m_isTls ? QStringLiteral("it has not ended its TLS handshake in time")
                   : QStringLiteral("it has not greeted in time");
}

void Handshake::look()
{
    if (m_isTls || m_isOver)
        return;
    const QByteArray begin = m_socket->peek(enoughToTell);
    const Language language = languageOf(begin);
    if (language == Language::NotYetKnown)
        return;
    if (language == Language::Tls) {
        m_isTls = m_tls != nullptr;
        if (m_isTls)
            Q_EMIT tlsWanted();
        else
            refuseTls();
        return;
    }
    if (m_tls && begin.size() <= kindOffset)
        return;
    // The cyclic connection of a node carries no TLS: its token came over the control connection,
    // and its frames are sealed.
    m_peer.isCyclicOnly = m_tls && quint8(begin.at(kindOffset)) == QPlcMessage::AttachCyclicChannel;
    if (m_tls && !m_peer.isCyclicOnly)
        refusePlain();
    else
        Q_EMIT succeeded();
}

void Handshake::refuseTls()
{
    m_socket->readAll();  // what is left unread would make a reset out of the end of the connection
    m_socket->write(alert(TlsAlert::ProtocolVersion));  // as no handshake of QtPLC would end
    fail(QStringLiteral("it speaks TLS, but this master is not secured"));
}

void Handshake::refusePlain()
{
    m_socket->readAll();
    const QString text
        = QStringLiteral("this master is secured; connect with --security %1").arg(m_security.modeName());
    m_socket->write(rejection(messages::errorWord::securityNeeded, text));
    fail(QStringLiteral("it does not speak TLS, but this master is secured"));
}

void Handshake::fail(const QString &reason)
{
    if (m_isOver)
        return;
    m_isOver = true;
    m_socket->disconnect(this);
    m_socket->flush();
    m_socket->disconnectFromHost();
    Q_EMIT failed(printable(reason));
}

// ---- TLS ----

void Handshake::beginTls()
{
    QString error;
    if (!TlsSettings::read(m_security, QPlcSecurity::MasterSide, &m_settings, &error)) {
        m_socket->readAll();
        m_socket->write(alert(TlsAlert::InternalError));
        fail(error);
        return;
    }
    connect(m_tls, &Tls::encrypted, this, &Handshake::encrypted);
    connect(m_socket, &QTcpSocket::errorOccurred, this, &Handshake::tlsFailed);
    m_tls->accept({m_settings.configuration, {}, [this](const QString &identity) { return keyOf(identity); }, {}});
}

QByteArray Handshake::keyOf(const QString &identity)
{
    const Keyring::Entry *entry = m_settings.keys.find(identity);
    if (!entry) {
        m_unknownIdentity = identity;
        return {};
    }
    m_peer.identity = identity;
    return entry->key;
}

bool Handshake::identify(QString *reason)
{
    if (!TlsSettings::isAcceptable(m_tls->suite(), m_security.mode())) {
        *reason = QStringLiteral("the suite %1 is not used here").arg(m_tls->suite().name());
        return false;
    }
    if (m_security.mode() == QPlcSecurity::Certificates) {
        m_peer.identity = m_tls->certificateName();
        if (!m_tls->certificateError().isEmpty()) {
            *reason = QStringLiteral("its certificate is refused: %1").arg(m_tls->certificateError());
            return false;
        }
    }
    if (m_peer.identity.isEmpty()) {
        *reason = QStringLiteral("it has no identity");
        return false;
    }
    const std::optional<Peer> peer = m_settings.peer(m_peer.identity);
    if (!peer) {
        *reason = QStringLiteral("identity '%1' has no role in the access file of the master")
                      .arg(printable(m_peer.identity));
        return false;
    }
    m_peer = *peer;
    return true;
}

void Handshake::encrypted()
{
    QString reason;
    if (identify(&reason)) {
        Q_EMIT succeeded();
        return;
    }
    m_socket->write(rejection(messages::errorWord::denied, reason));
    fail(reason);
}

void Handshake::turnAway(const QString &reason)
{
    m_socket->disconnect(this);
    m_socket->write(rejection(messages::errorWord::tooMuch, reason));
    m_socket->flush();
    m_socket->disconnectFromHost();
}

/// Tells the other end why, which TLS itself does not.
void Handshake::tlsFailed()
{
    TlsAlert::Description description = TlsAlert::HandshakeFailure;
    QString reason = QStringLiteral("TLS handshake failed: %1").arg(m_socket->errorString());
    if (!m_isTls) {
        fail(QString());  // it came and went without a word, as whoever looks at ports
        return;
    }
    if (!m_unknownIdentity.isNull()) {
        description = TlsAlert::UnknownPskIdentity;
        reason = QStringLiteral("unknown identity '%1'").arg(m_unknownIdentity.left(Keyring::LongestIdentity));
    } else if (!m_peer.identity.isEmpty() && m_security.mode() == QPlcSecurity::PreSharedKeys) {
        description = TlsAlert::BadRecordMac;
        reason = QStringLiteral("wrong key of identity '%1' (%2)").arg(m_peer.identity, m_socket->errorString());
    }
    m_tls->sendAlert(alert(description));
    fail(reason);
}

}  // namespace qplc
