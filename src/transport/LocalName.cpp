// SPDX-License-Identifier: Apache-2.0
#include "LocalName.h"

#include "realtime/SessionFolder.h"

#include <QtCore/QFile>
#include <QtCore/QRegularExpression>
#include <QtCore/QSaveFile>

#include <cerrno>

namespace qplc {

namespace {

QByteArray namesFolder()
{
    return SessionFolder::path("qtplc");
}

QString fileOf(const QString &name)
{
    return QFile::decodeName(namesFolder()) + QLatin1Char('/') + name;
}

QString publishError(const QString &name, const QString &reason)
{
    return QStringLiteral("cannot publish the name '%1' in %2: %3").arg(name, fileOf(name), reason);
}

bool isName(const QString &name, QString *error)
{
    static const QRegularExpression allowed(QStringLiteral("^[A-Za-z0-9_-][A-Za-z0-9._-]*$"));
    if (allowed.match(name).hasMatch())
        return true;
    *error
        = QStringLiteral("'%1' is not a valid name of a local master; use letters, digits, '.', '-' and '_'").arg(name);
    return false;
}

}  // namespace

bool LocalName::hold(const QString &name, quint16 port, QString *error)
{
    release();
    if (!isName(name, error))
        return false;
    if (!SessionFolder::make(namesFolder())) {
        *error = publishError(name, qt_error_string(errno));
        return false;
    }
    QSaveFile file(fileOf(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(QByteArray::number(port)) < 0 || !file.commit()) {
        *error = publishError(name, file.errorString());
        return false;
    }
    m_file = file.fileName();
    return true;
}

void LocalName::release()
{
    if (!m_file.isEmpty())
        QFile::remove(m_file);
    m_file.clear();
}

quint16 LocalName::portOf(const QString &name, QString *error)
{
    if (!isName(name, error))
        return 0;
    QFile file(fileOf(name));
    const bool isTrusted = SessionFolder::make(namesFolder());
    const quint16 port = isTrusted && file.open(QIODevice::ReadOnly) ? file.read(16).toUShort() : quint16(0);
    if (port == 0)
        *error = QStringLiteral("no master with the name '%1' runs on this machine for this user; start it with this "
                                "name, or give its port")
                     .arg(name);
    return port;
}

}  // namespace qplc
