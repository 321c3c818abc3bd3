// SPDX-License-Identifier: Apache-2.0
#include "SecretFile.h"

#include "transport/SocketAddress.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QSaveFile>

#include <cerrno>
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

/// \return false, with errno, if data may be lost; file systems that cannot sync are no error
bool sync(int descriptor)
{
    return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
}

/// So that the new name of a file survives a loss of power. A link stays: the name is new in the
/// folder of the file that it leads to.
bool syncFolderOf(const QString &fileName)
{
    const QByteArray folder = QFile::encodeName(QFileInfo(fileName).canonicalPath());
    const int descriptor = ::open(folder.constData(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    const bool isDone = sync(descriptor);
    const int error = errno;
    ::close(descriptor);
    errno = error;
    return isDone;
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

bool SecretFile::write(const QString &fileName, const QByteArray &content, QString *problem)
{
    QSaveFile file(fileName);
    file.setDirectWriteFallback(false);
    // commit() syncs, too, but replaces the old content even if that fails.
    if (!file.open(QIODevice::WriteOnly) || !file.setPermissions(QFileDevice::ReadOwner | QFileDevice::WriteOwner)
        || file.write(content) != content.size() || !file.flush() || !sync(file.handle()) || !file.commit()) {
        const QString reason = file.error() == QFileDevice::NoError ? systemErrorText() : file.errorString();
        *problem = QStringLiteral("cannot write %1: %2").arg(fileName, reason);
        return false;
    }
    if (!syncFolderOf(fileName))
        *problem
            = QStringLiteral("%1 is written, but may not survive a loss of power: %2").arg(fileName, systemErrorText());
    return true;
}

}  // namespace qplc
