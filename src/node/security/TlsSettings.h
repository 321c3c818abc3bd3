// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Keyring.h"
#include "QPlcSecurity.h"
#include "RightsFile.h"

#include <QtNetwork/QSslConfiguration>
#include <QtNetwork/QSslSocket>

namespace qplc {

class Tls;

/// What TLS needs of a QPlcSecurity, as its files say it now: docs/design/security.md has the
/// reasons for each choice.
struct TlsSettings
{
    QSslConfiguration configuration;
    Keyring keys;       // with pre-shared keys
    QString identity;   // with which a node connects; with pre-shared keys only
    AccessList access;  // of a master

    /// \return false, with the remedy in \a error, when a file is missing, wrong, or open to others
    static bool read(const QPlcSecurity &security, QPlcSecurity::Side side, TlsSettings *settings, QString *error);

    /// All that may come to a master, by its files.
    QMap<QString, Peer> peers() const;
    /// That of one identity; nothing if \a name has no role.
    std::optional<Peer> peer(const QString &name) const;

    /// Whether a suite has forward secrecy and authenticated encryption. \param mode that of the
    /// security
    static bool isAcceptable(const QSslCipher &cipher, QPlcSecurity::Mode mode);

private:
    QStringList known() const { return keys.entries().keys() + access.identities(); }
    Peer peerOf(const QString &name, const QStringList &known) const;
};

/// Alerts of TLS (RFC 5246, RFC 4279) that tell more than that a handshake failed.
struct TlsAlert
{
    enum Description {
        BadRecordMac = 20,
        HandshakeFailure = 40,
        DecryptError = 51,
        ProtocolVersion = 70,
        InsufficientSecurity = 71,
        InternalError = 80,
        UnknownPskIdentity = 115
    };
};

/// Why a handshake of a node or tool with its master failed, with the remedy.
QString nodeHandshakeError(const Tls &tls, const QPlcSecurity &security, const QString &identity);

}  // namespace qplc
