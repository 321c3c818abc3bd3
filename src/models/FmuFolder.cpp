// SPDX-License-Identifier: Apache-2.0
#include "FmuFolder.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

const QString prefix = QStringLiteral("qtplc-fmu-");
const QString lockName = QStringLiteral("/.lock");

QByteArray encoded(const QString &path)
{
    return QFile::encodeName(path);
}

/// \return the descriptor of a file that this process has locked; -1: there is none. Under its own
///     name it exists with its lock only.
int makeLock(const QString &folder)
{
    const QByteArray name = encoded(folder + lockName);
    const QByteArray newName = name + ".new";
    const int lock = ::open(newName.constData(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (lock < 0)
        return -1;
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0 && ::rename(newName.constData(), name.constData()) == 0)
        return lock;
    ::close(lock);
    return -1;
}

}  // namespace

std::unique_ptr<FmuFolder> FmuFolder::make(QString *error)
{
    removeLeftovers();
    QByteArray path = encoded(QDir::tempPath() + QLatin1Char('/') + prefix + QStringLiteral("XXXXXX"));
    if (!::mkdtemp(path.data())) {
        *error = QStringLiteral("cannot make a folder in %1 for the files of the FMU: %2; set TMPDIR to another folder")
                     .arg(QDir::tempPath(), QString::fromLocal8Bit(std::strerror(errno)));
        return nullptr;
    }
    const QString folder = QFile::decodeName(path);
    const int lock = makeLock(folder);
    if (lock < 0) {
        *error = QStringLiteral("cannot make a file in %1: %2; set TMPDIR to another folder")
                     .arg(folder, QString::fromLocal8Bit(std::strerror(errno)));
        QDir(folder).removeRecursively();
        return nullptr;
    }
    return std::unique_ptr<FmuFolder>(new FmuFolder(folder, lock));
}

FmuFolder::~FmuFolder()
{
    QDir(m_path).removeRecursively();
    ::close(m_lock);
}

/// Folders of this user whose process is gone.
void FmuFolder::removeLeftovers()
{
    QDir all(QDir::tempPath());
    const QStringList names = all.entryList({prefix + QLatin1Char('*')}, QDir::Dirs | QDir::NoSymLinks);
    for (const QString &name : names) {
        const QString folder = all.filePath(name);
        struct stat status
        {
        };
        if (::lstat(encoded(folder).constData(), &status) != 0 || status.st_uid != ::geteuid())
            continue;
        const int lock = ::open(encoded(folder + lockName).constData(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (lock < 0)
            continue;  // it is being made, or is not ours
        if (::flock(lock, LOCK_EX | LOCK_NB) == 0)
            QDir(folder).removeRecursively();
        ::close(lock);
    }
}

}  // namespace qplc
