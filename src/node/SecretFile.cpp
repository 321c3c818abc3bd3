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

constexpr mode_t othersBits = S_IRWXG | S_IRWXO;

/// Why a file with these attributes keeps no secret; empty: it does.
QString weakness(const QString &fileName, const struct stat &status)
{
    if (!S_ISREG(status.st_mode))
        return QStringLiteral("%1 is no file").arg(fileName);
    if ((status.st_mode & othersBits) != 0)
        return QStringLiteral("%1 has the mode %2, others than its owner can get at the keys in it; use chmod 600 %1")
            .arg(fileName)
            .arg(uint(status.st_mode & 07777U), 4, 8, QLatin1Char('0'));
    if (status.st_uid != ::geteuid() && status.st_uid != 0)
        return QStringLiteral("%1 belongs to another user, who can change the keys in it; use chown").arg(fileName);
    if (status.st_size > SecretFile::MaximumSize)
        return QStringLiteral("%1 has %2 bytes; at most %3 are read")
            .arg(fileName)
            .arg(qint64(status.st_size))
            .arg(SecretFile::MaximumSize);
    return {};
}

}  // namespace

bool SecretFile::read(const QString &fileName, QByteArray *content, QString *error)
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
                                              : weakness(fileName, status);
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
