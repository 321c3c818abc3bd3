// SPDX-License-Identifier: Apache-2.0
#include "TlsSettings.h"

#include "SecretFile.h"
#include "transport/Tls.h"

#include <QtCore/QCryptographicHash>
#include <QtCore/QRegularExpression>
#include <QtNetwork/QSslCertificate>
#include <QtNetwork/QSslCipher>
#include <QtNetwork/QSslKey>
#include <QtNetwork/QTcpSocket>

#include <algorithm>

namespace qplc {

namespace {

/// The only suite of OpenSSL 3 with a pre-shared key, ECDHE and AEAD.
const QLatin1String pskSuite("ECDHE-PSK-CHACHA20-POLY1305");

QList<QSslCipher> acceptableCiphers(QPlcSecurity::Mode mode)
{
    QList<QSslCipher> ciphers = QSslConfiguration::supportedCiphers();
    ciphers.erase(std::remove_if(ciphers.begin(), ciphers.end(),
                                 [mode](const QSslCipher &cipher) { return !TlsSettings::isAcceptable(cipher, mode); }),
                  ciphers.end());
    return ciphers;
}

bool readPrivateKey(const QString &fileName, QSslKey *key, QString *error)
{
    QByteArray pem;
    if (!SecretFile::read(fileName, SecretFile::Secret, &pem, error))
        return false;
    for (QSsl::KeyAlgorithm algorithm : {QSsl::Ec, QSsl::Rsa}) {
        *key = QSslKey(pem, algorithm);
        if (!key->isNull())
            return true;
    }
    *error = QStringLiteral("%1 has no private key that can be read; use PEM, EC or RSA, without a password")
                 .arg(fileName);
    return false;
}

/// Who could change the file of an authority could add one of his own.
bool readCertificates(const QString &fileName, QList<QSslCertificate> *certificates, QString *error)
{
    QByteArray pem;
    if (!SecretFile::read(fileName, SecretFile::Trusted, &pem, error))
        return false;
    *certificates = QSslCertificate::fromData(pem, QSsl::Pem);
    if (certificates->isEmpty())
        *error = QStringLiteral("%1 has no certificate; use PEM").arg(fileName);
    return !certificates->isEmpty();
}

bool readCertificateFiles(const QPlcSecurity &security, TlsSettings *settings, QString *error)
{
    QList<QSslCertificate> own;
    QList<QSslCertificate> authorities;
    QSslKey key;
    if (!readCertificates(security.certificateFile(), &own, error)
        || !readCertificates(security.authorityFile(), &authorities, error)
        || !readPrivateKey(security.privateKeyFile(), &key, error))
        return false;
    settings->configuration.setLocalCertificateChain(own);
    settings->configuration.setPrivateKey(key);
    settings->configuration.setCaCertificates(authorities);
    return true;
}

bool chooseIdentity(const QPlcSecurity &security, TlsSettings *settings, QString *error)
{
    const QStringList known = settings->keys.entries().keys();
    settings->identity = security.identity().isEmpty() && known.size() == 1 ? known.constFirst() : security.identity();
    if (settings->keys.find(settings->identity))
        return true;
    *error = settings->identity.isEmpty()
        ? QStringLiteral("%1 has the keys of %2 identities; say which one to be, by --identity")
              .arg(security.keysFile())
              .arg(known.size())
        : QStringLiteral("%1 has no key of '%2'; copy it from the keys of the master")
              .arg(security.keysFile(), settings->identity);
    return false;
}

}  // namespace

bool TlsSettings::isAcceptable(const QSslCipher &cipher, QPlcSecurity::Mode mode)
{
    const QString name = cipher.name();
    if (mode == QPlcSecurity::PreSharedKeys)
        return name == pskSuite;
    const bool isAead = name.contains(QLatin1String("GCM")) || name.contains(QLatin1String("CHACHA20"));
    const bool isTls13 = name.startsWith(QLatin1String("TLS_"));
    return isAead
        && (isTls13 || name.startsWith(QLatin1String("ECDHE-ECDSA-")) || name.startsWith(QLatin1String("ECDHE-RSA-")));
}

bool TlsSettings::read(const QPlcSecurity &security, QPlcSecurity::Side side, TlsSettings *settings, QString *error)
{
    *settings = TlsSettings();
    if (security.isNone())
        return true;
    if (!QSslSocket::supportsSsl()) {
        *error = QStringLiteral("this system has no TLS; install libssl %1")
                     .arg(QSslSocket::sslLibraryBuildVersionString());
        return false;
    }
    const bool isPsk = security.mode() == QPlcSecurity::PreSharedKeys;
    QSslConfiguration &configuration = settings->configuration;
    configuration.setProtocol(isPsk ? QSsl::TlsV1_2 : QSsl::TlsV1_2OrLater);
    configuration.setCiphers(acceptableCiphers(security.mode()));
    configuration.setPeerVerifyMode(isPsk ? QSslSocket::VerifyNone : QSslSocket::VerifyPeer);
    configuration.setSslOption(QSsl::SslOptionDisableSessionTickets, true);  // who is revoked does not resume
    configuration.setSslOption(QSsl::SslOptionDisableSessionSharing, true);
    if (isPsk
        && (!settings->keys.read(security.keysFile(), error)
            || (side == QPlcSecurity::NodeSide && !chooseIdentity(security, settings, error))))
        return false;
    if (!isPsk && !readCertificateFiles(security, settings, error))
        return false;
    if (side == QPlcSecurity::MasterSide && !security.accessFile().isEmpty())
        return settings->access.read(security.accessFile(), error);
    if (side == QPlcSecurity::NodeSide || isPsk)
        return true;
    *error = QStringLiteral(
        "a master with certificates needs a file with the roles of all identities; give it one by --access");
    return false;
}

/// \pre there is such an identity
Peer TlsSettings::peerOf(const QString &name, const QStringList &known) const
{
    Peer peer;
    peer.isSecured = true;
    peer.identity = name;
    peer.role = Role::Observer;
    if (const Keyring::Entry *entry = keys.find(name)) {
        peer.role = entry->role;
        peer.keyMark = QCryptographicHash::hash(entry->key, QCryptographicHash::Sha256);
    }
    access.apply(&peer);
    if (peer.role != Role::Node)  // who has its own name anyway
        peer.known = known;
    return peer;
}

QMap<QString, Peer> TlsSettings::peers() const
{
    const QStringList known = this->known();
    const QStringList identities = keys.entries().isEmpty() ? access.identities() : keys.entries().keys();
    QMap<QString, Peer> peers;
    for (const QString &name : identities)
        peers.insert(name, peerOf(name, known));
    return peers;
}

std::optional<Peer> TlsSettings::peer(const QString &name) const
{
    const bool isThere = keys.entries().isEmpty() ? access.contains(name) : keys.find(name) != nullptr;
    return isThere ? std::optional<Peer>(peerOf(name, known())) : std::nullopt;
}

/// The alert of TLS by which the other end has refused; 0: none.
int receivedAlert(const QString &errorString)
{
    constexpr int firstAlert = 1000;  // reasons of OpenSSL from here on are alerts of the other end
    static const QRegularExpression code(QStringLiteral("error:([0-9A-Fa-f]{8}):"));
    const int reason = code.match(errorString).captured(1).right(3).toInt(nullptr, 16);
    return reason >= firstAlert && reason < firstAlert + 256 ? reason - firstAlert : 0;
}

QString nodeHandshakeError(const Tls &tls, const QPlcSecurity &security, const QString &identity)
{
    if (!tls.certificateError().isEmpty())
        return QStringLiteral("the certificate of the master is refused: %1").arg(tls.certificateError());
    switch (receivedAlert(tls.socket()->errorString())) {
    case TlsAlert::UnknownPskIdentity:
        return QStringLiteral("the master does not know identity '%1'; add it there by qtplc keys new").arg(identity);
    case TlsAlert::BadRecordMac:
    case TlsAlert::DecryptError:
        return QStringLiteral("the key of identity '%1' is not the one that the master has; copy it from there again")
            .arg(identity);
    case TlsAlert::ProtocolVersion:
        return QStringLiteral("the master is not secured; start it with --security %1, or connect without")
            .arg(security.modeName());
    case TlsAlert::HandshakeFailure:
    case TlsAlert::InsufficientSecurity:
        return QStringLiteral(
                   "the master does not offer security of the kind '%1'; use the kind that it was started with")
            .arg(security.modeName());
    case TlsAlert::InternalError:
        return QStringLiteral("the master cannot read its keys; its log says why");
    default:
        return tls.socket()->errorString();
    }
}

}  // namespace qplc
