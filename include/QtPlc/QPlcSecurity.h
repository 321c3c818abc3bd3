// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// How the two ends of a control connection authenticate each other: not at all, with a key that
/// both have, or with certificates.
///
/// \code
/// QPlcMasterNode master;
/// master.setSecurity(QPlcSecurity::preSharedKeys("keys.ini"));  // all identities, keys and roles
/// QPlcIOSlaveNode node("Winch");
/// node.setSecurity(QPlcSecurity::preSharedKeys("winch.ini", "Winch"));  // the key of the node
/// \endcode
///
/// The control connection then uses TLS: 1.2 with keys, 1.2 or 1.3 with certificates, with forward
/// secrecy (ECDHE) and authenticated encryption (AEAD) only. Cyclic frames on the network are
/// sealed with keys of that connection. Files are read for each connection: a key that was added,
/// replaced or revoked counts from the next connection on, without a restart. A file with keys is
/// refused if others than its owner can read it; any other file is refused if others can change it.
/// All files belong to the user of the program or to root. docs/howto/security.md shows it step by
/// step.
///
/// \threadsafe a value type: each thread may use its own copy. Call current() and setCurrent() in
///     the main thread
///
/// \ingroup network
class QTPLC_EXPORT QPlcSecurity
{
    Q_GADGET
public:
    /// Kinds of authentication.
    enum Mode : quint8 {
        None,           ///< everybody who reaches the port may read and command
        PreSharedKeys,  ///< a key for each identity, in a file at both ends
        Certificates    ///< a certificate for each identity, made by an authority of your own
    };
    Q_ENUM(Mode)
    /// The two ends of a connection.
    enum Side : quint8 {
        MasterSide,  ///< the end that listens
        NodeSide     ///< the end that connects: node or tool
    };

    /// Makes settings without security.
    QPlcSecurity() = default;
    /// Returns settings with keys.
    /// \param keysFile  written by `qtplc keys new`: of a master with all identities, of a node or
    ///     tool with one or more
    /// \param identity  of a node or tool; empty: the only one in the file. A master ignores it
    static QPlcSecurity preSharedKeys(const QString &keysFile, const QString &identity = QString());
    /// Returns settings with certificates. All files are PEM. The common name of a certificate is
    /// the identity; that of the master is masterIdentity().
    /// \param certificateFile  certificate of this program
    /// \param privateKeyFile  its private key
    /// \param authorityFile  certificate of the authority that has made all certificates
    static QPlcSecurity certificates(const QString &certificateFile, const QString &privateKeyFile,
                                     const QString &authorityFile);

    /// Returns the kind of authentication.
    Mode mode() const { return m_mode; }
    /// Returns true without security.
    bool isNone() const { return m_mode == None; }
    /// Returns "none", "psk" or "cert".
    QString modeName() const;
    /// Returns the file with keys; empty in other modes.
    QString keysFile() const { return m_keysFile; }
    /// Returns the identity with which a node or tool connects; empty: the only one in the file.
    QString identity() const { return m_identity; }
    /// Returns the file of the certificate; empty in other modes.
    QString certificateFile() const { return m_certificateFile; }
    /// Returns the file of the private key; empty in other modes.
    QString privateKeyFile() const { return m_privateKeyFile; }
    /// Returns the file of the certificate of the authority; empty in other modes.
    QString authorityFile() const { return m_authorityFile; }

    /// Returns the file with the roles of identities and the signals that they may write
    /// (access.ini).
    QString accessFile() const { return m_accessFile; }
    /// Sets the file with roles, for a master. A master with certificates needs it: an identity
    /// that is not in it has no role.
    void setAccessFile(const QString &fileName) { m_accessFile = fileName; }

    /// Returns the common name in the certificate of the master.
    QString masterIdentity() const { return m_masterIdentity; }
    /// Sets the common name in the certificate of the master; default "master". A node refuses a
    /// master with another name.
    void setMasterIdentity(const QString &name) { m_masterIdentity = name; }

    /// Reads all files and checks them for one end.
    /// \return what is wrong and what to do; empty: everything is in order
    QString errorString(Side side) const;

    /// Returns the settings of all nodes and sockets of this process that have none of their own;
    /// none by default. A master uses its own settings only.
    static QPlcSecurity current();
    /// Sets what current() returns. Takes effect at the next connection.
    static void setCurrent(const QPlcSecurity &security);

    /// Returns true if mode, files and identities are the same. The contents of files do not count.
    friend bool operator==(const QPlcSecurity &a, const QPlcSecurity &b)
    {
        return a.m_mode == b.m_mode && a.m_keysFile == b.m_keysFile && a.m_identity == b.m_identity
            && a.m_certificateFile == b.m_certificateFile && a.m_privateKeyFile == b.m_privateKeyFile
            && a.m_authorityFile == b.m_authorityFile && a.m_accessFile == b.m_accessFile
            && a.m_masterIdentity == b.m_masterIdentity;
    }
    /// Returns true if mode, a file name or an identity differs.
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
