// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// How the two ends of a control connection know each other: not at all, by a key that both have, or by certificates.
///
/// ```cpp
/// master.setSecurity(QPlcSecurity::preSharedKeys("keys.ini"));              // all identities, their keys and roles
/// node.setSecurity(QPlcSecurity::preSharedKeys("winch.ini", "Winch"));      // the key of the node alone
/// ```
/// The control connection is TLS then: 1.2 with a key, 1.2 or 1.3 with certificates, with forward secrecy (ECDHE) and authenticated encryption (AEAD) only.
/// Files are read when a connection is made, so that a key that was added, replaced or revoked counts from the next connection on, without a restart.
/// A file with keys that others than its owner may read is refused, and so is each other one that they may change. All files belong to the user of the program, or to root.
///
/// A value type.
class QTPLC_EXPORT QPlcSecurity
{
    Q_GADGET
public:
    enum Mode : quint8 {
        None,           ///< anybody who reaches the port may read and command
        PreSharedKeys,  ///< one key for each identity, in a file of both ends
        Certificates    ///< a certificate for each identity, by an authority of one's own
    };
    Q_ENUM(Mode)
    enum Side : quint8 { MasterSide, NodeSide };

    /// No security.
    QPlcSecurity() = default;
    /// \param keysFile  written by `qtplc keys new`: of all identities for a master, of one or more for a node or tool
    /// \param identity  as which a node or tool connects; empty: the only one in the file
    static QPlcSecurity preSharedKeys(const QString &keysFile, const QString &identity = QString());
    /// All files are PEM. The common name of a certificate is the identity; a master has the identity masterIdentity().
    static QPlcSecurity certificates(const QString &certificateFile, const QString &privateKeyFile,
                                     const QString &authorityFile);

    Mode mode() const { return m_mode; }
    bool isNone() const { return m_mode == None; }
    /// "none", "psk", "cert"
    QString modeName() const;
    QString keysFile() const { return m_keysFile; }
    QString identity() const { return m_identity; }
    QString certificateFile() const { return m_certificateFile; }
    QString privateKeyFile() const { return m_privateKeyFile; }
    QString authorityFile() const { return m_authorityFile; }

    /// Roles of identities, and the signals that they may write (access.ini); for a master. With certificates it is needed: who is not in it has no role.
    QString accessFile() const { return m_accessFile; }
    void setAccessFile(const QString &fileName) { m_accessFile = fileName; }

    /// The common name that the certificate of the master has; "master" unless set.
    QString masterIdentity() const { return m_masterIdentity; }
    void setMasterIdentity(const QString &name) { m_masterIdentity = name; }

    /// Reads all files. \return what is wrong with them for this side, with the remedy; empty: nothing
    QString errorString(Side side) const;

    /// What all sockets and nodes of this process use that were told nothing else; none unless set. A master is told by its own setSecurity() only.
    static QPlcSecurity current();
    static void setCurrent(const QPlcSecurity &security);

    friend bool operator==(const QPlcSecurity &a, const QPlcSecurity &b)
    {
        return a.m_mode == b.m_mode && a.m_keysFile == b.m_keysFile && a.m_identity == b.m_identity
            && a.m_certificateFile == b.m_certificateFile && a.m_privateKeyFile == b.m_privateKeyFile
            && a.m_authorityFile == b.m_authorityFile && a.m_accessFile == b.m_accessFile
            && a.m_masterIdentity == b.m_masterIdentity;
    }
    friend bool operator!=(const QPlcSecurity &a, const QPlcSecurity &b) { return !(a == b); }

private:
    Mode m_mode = None;
    QString m_keysFile;
    QString m_identity;
    QString m_certificateFile;
    QString m_privateKeyFile;
    QString m_authorityFile;
    QString m_accessFile;
    QString m_masterIdentity = QStringLiteral("master");
};

Q_DECLARE_METATYPE(QPlcSecurity)
