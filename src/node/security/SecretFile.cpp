// SPDX-License-Identifier: Apache-2.0
#include "SecretFile.h"

#include "transport/SocketAddress.h"

#include <QtCore/QFile>
#include <QtCore/QSaveFile>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

/// Why a file with these attributes is not as it needs to be; empty: it is.
QString weakness(const QString &fileName, SecretFile::Need need, const struct stat &status)
{
    const QString mode = QStringLiteral("%1").arg(uint(status.st_mode & 07777U), 4, 8, QLatin1Char('0'));
    if (!S_ISREG(status.st_mode))
        return QStringLiteral("%1 is not a file").arg(fileName);
    if (need == SecretFile::Secret && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
        return QStringLiteral("%1 has the mode %2, others than its owner can get at the keys in it; use chmod 600 %1")
            .arg(fileName, mode);
    if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
        return QStringLiteral("%1 has the mode %2, others than its owner can change it; use chmod go-w %1")
            .arg(fileName, mode);
    if (status.st_uid != ::geteuid() && status.st_uid != 0)
        return QStringLiteral("%1 belongs to another user, who can change it; use chown").arg(fileName);
    if (status.st_size > SecretFile::MaximumSize)
        return QStringLiteral("%1 has %2 bytes; at most %3 are read")
            .arg(fileName)
            .arg(qint64(status.st_size))
            .arg(SecretFile::MaximumSize);
    return {};
}

}  // namespace

bool SecretFile::read(const QString &fileName, Need need, QByteArray *content, QString *error)
{
    const int descriptor = ::open(QFile::encodeName(fileName).constData(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        *error = QStringLiteral("cannot open %1: %2").arg(fileName, systemErrorText());
        return false;
    }
    struct stat status = {};
    QFile file;
    file.open(descriptor, QIODevice::ReadOnly, QFileDevice::AutoCloseHandle);
    *error = ::fstat(descriptor, &status) < 0 ? QStringLiteral("%1: %2").arg(fileName, systemErrorText())
                                              : weakness(fileName, need, status);
    if (!error->isEmpty())
        return false;
    *content = file.read(MaximumSize);
    return true;
}

bool SecretFile::write(const QString &fileName, const QByteArray &content, QString *error)
{
    QSaveFile file(fileName);
    file.setDirectWriteFallback(false);
    if (file.open(QIODevice::WriteOnly) && file.setPermissions(QFileDevice::ReadOwner | QFileDevice::WriteOwner)
        && file.write(content) == content.size() && file.commit())
        return true;
    *error = QStringLiteral("cannot write %1: %2").arg(fileName, file.errorString());
    return false;
}

}  // namespace qplc
