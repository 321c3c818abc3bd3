// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ScriptedNode.h"

#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

/// Files of keys, rights and certificates in a folder of their own.
class SecurityFiles
{
public:
    QString path(const QString &name) const { return m_folder.filePath(name); }
    QString write(const QString &name, const QByteArray &content,
                  QFileDevice::Permissions mode = QFileDevice::ReadOwner | QFileDevice::WriteOwner) const
    {
        QFile file(path(name));
        if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size() || !file.setPermissions(mode))
            qFatal("cannot write %s", qPrintable(path(name)));
        return path(name);
    }
    /// A key that is easy to tell from others.
    static QByteArray key(char digit) { return QByteArray(64, digit); }
    static QByteArray section(const QByteArray &identity, const QByteArray &key, const QByteArray &role)
    {
        return "[" + identity + "]\nkey = " + key + "\nrole = " + role + "\n";
    }
    /// Counter, Echo: nodes; anna: operator; bert: observer; carl: engineer; keys of a, b, c, d, e.
    QString masterKeys() const
    {
        return write("keys.ini",
                     section("Counter", key('a'), "Node") + section("Echo", key('b'), "Node")
                         + section("anna", key('c'), "Operator") + section("bert", key('d'), "Observer")
                         + section("carl", key('e'), "Engineer"));
    }
    /// As the file of one identity on its own machine.
    QPlcSecurity of(const QString &identity, char digit) const
    {
        return QPlcSecurity::preSharedKeys(write(identity + ".ini", section(identity.toUtf8(), key(digit), "Node")),
                                           identity);
    }
    QPlcSecurity counter() const { return of("Counter", 'a'); }
    QPlcSecurity echo() const { return of("Echo", 'b'); }
    QPlcSecurity anna() const { return of("anna", 'c'); }
    QPlcSecurity bert() const { return of("bert", 'd'); }
    QPlcSecurity carl() const { return of("carl", 'e'); }

    // ---- certificates ----
    /// Runs openssl in the folder. \return false when it has failed, or is not there
    bool openssl(const QStringList &arguments) const
    {
        QProcess process;
        process.setWorkingDirectory(m_folder.path());
        process.setProcessChannelMode(QProcess::MergedChannels);
        process.start("openssl", arguments);
        const bool isDone = process.waitForFinished(20000) && process.exitCode() == 0;
        if (!isDone)
            qDebug().noquote() << arguments.join(' ') << process.errorString() << process.readAll();
        return isDone;
    }
    /// Certificates have the mode that they need, whatever the umask is.
    bool protect(const QString &name) const
    {
        return QFile::setPermissions(path(name + ".pem"), QFileDevice::ReadOwner | QFileDevice::WriteOwner);
    }
    /// An authority: NAME.pem and NAME.key.
    bool makeAuthority(const QString &name) const
    {
        return openssl({"req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2",
                        "-subj", "/CN=" + name, "-keyout", name + ".key", "-out", name + ".pem"})
            && protect(name);
    }
    /// A certificate of \a authority: NAME.pem and NAME.key. \param days -1: it ended yesterday
    bool makeCertificate(const QString &name, const QString &authority, const QString &file = QString(),
                         int days = 2) const
    {
        const QString base = file.isEmpty() ? name : file;
        write(base + ".ext", "subjectAltName=DNS:" + name.toUtf8() + "\n");
        write(authority + ".srl", "01\n");
        write("index.txt", "");
        return openssl({"req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj", "/CN=" + name,
                        "-keyout", base + ".key", "-out", base + ".csr"})
            && openssl({"x509", "-req", "-in", base + ".csr", "-CA", authority + ".pem", "-CAkey", authority + ".key",
                        "-days", QString::number(days), "-extfile", base + ".ext", "-out", base + ".pem"})
            && protect(base);
    }
    QPlcSecurity certificate(const QString &name, const QString &authority = "authority") const
    {
        return QPlcSecurity::certificates(path(name + ".pem"), path(name + ".key"), path(authority + ".pem"));
    }

private:
    QTemporaryDir m_folder;
};

/// A tool that connects with security, and greets.
class SecuredTool : public ScriptedTool
{
    Q_OBJECT
public:
    explicit SecuredTool(const QPlcSecurity &security) { control.setSecurity(security); }
};
