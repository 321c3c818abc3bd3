// SPDX-License-Identifier: Apache-2.0
#include "LocalNotice.h"

#include "realtime/SessionFolder.h"

#include <QtCore/QDir>

#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

/// Empty: there is none that is of this user alone.
QByteArray noticeFolder()
{
    const QByteArray path = SessionFolder::path("qtplc-masters");
    return SessionFolder::make(path) ? path : QByteArray();
}

struct flock wholeFile()
{
    struct flock lock = {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

bool takeLock(int descriptor)
{
    struct flock lock = wholeFile();
    return ::fcntl(descriptor, F_OFD_SETLK, &lock) == 0;
}

bool isLocked(int descriptor)
{
    struct flock lock = wholeFile();
    return ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

int openNotice(const QByteArray &file)
{
    return ::open(file.constData(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
}

QVector<QByteArray> filesIn(const QByteArray &folder)
{
    QVector<QByteArray> files;
    const QStringList names = QDir(QFile::decodeName(folder)).entryList(QDir::Files, QDir::Time);
    for (const QString &name : names.mid(0, LocalNotice::MaximumCount))
        files.append(folder + '/' + QFile::encodeName(name));
    return files;
}

void removeDead(const QByteArray &folder)
{
    for (const QByteArray &file : filesIn(folder)) {
        const int descriptor = openNotice(file);
        if (descriptor < 0)
            continue;
        // Who puts a notice up at this moment sees that it is gone, and makes another one.
        if (takeLock(descriptor))
            ::unlink(file.constData());
        ::close(descriptor);
    }
}

}  // namespace

bool LocalNotice::post(const QByteArray &content)
{
    withdraw();
    const QByteArray home = noticeFolder();
    if (home.isEmpty() || content.size() > MaximumSize)
        return false;
    removeDead(home);
    for (int attempts = 4; attempts > 0; --attempts) {
        m_file = home + "/XXXXXX";
        m_descriptor = ::mkostemp(m_file.data(), O_CLOEXEC);
        struct stat status = {};
        const bool isUp = m_descriptor >= 0 && takeLock(m_descriptor) && ::fstat(m_descriptor, &status) == 0
            && status.st_nlink > 0;  // nobody has taken it for one of the dead
        if (isUp && ::write(m_descriptor, content.constData(), std::size_t(content.size())) == content.size())
            return true;
        withdraw();
    }
    return false;
}

void LocalNotice::withdraw()
{
    if (m_descriptor < 0)
        return;
    ::unlink(m_file.constData());
    ::close(m_descriptor);
    m_descriptor = -1;
}

QVector<QByteArray> LocalNotice::all()
{
    QVector<QByteArray> notices;
    const QByteArray home = noticeFolder();
    if (home.isEmpty())
        return notices;
    for (const QByteArray &file : filesIn(home)) {
        const int descriptor = openNotice(file);
        if (descriptor < 0)
            continue;
        QByteArray content(MaximumSize, '\0');
        const ssize_t size = isLocked(descriptor) ? ::read(descriptor, content.data(), std::size_t(content.size())) : 0;
        ::close(descriptor);
        if (size > 0)
            notices.append(content.left(int(size)));
    }
    return notices;
}

}  // namespace qplc
