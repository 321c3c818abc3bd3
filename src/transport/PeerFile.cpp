// SPDX-License-Identifier: Apache-2.0
#include "PeerFile.h"

#include "SocketAddress.h"

#include <QtCore/QRegularExpression>

#include <fcntl.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr int NeededSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
constexpr int LongestPath = 64;

QString kindOf(const struct stat &status)
{
    switch (status.st_mode & S_IFMT) {
    case S_IFREG:
        return QStringLiteral("a file");
    case S_IFIFO:
        return QStringLiteral("a pipe");
    case S_IFDIR:
        return QStringLiteral("a directory");
    case S_IFLNK:
        return QStringLiteral("a symbolic link");
    case S_IFCHR:
    case S_IFBLK:
        return QStringLiteral("a device");
    case S_IFSOCK:
        return QStringLiteral("a socket");
    default:
        return QStringLiteral("an object of the kernel");
    }
}

}  // namespace

PeerFile::~PeerFile()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

QString PeerFile::refusal(const QString &reason) const
{
    return QStringLiteral("the %1 that the master names, '%2', is not opened: %3").arg(m_what, m_path, reason);
}

bool PeerFile::find(const QString &path, const QString &what, uid_t owner, QString *error)
{
    static const QRegularExpression form(QStringLiteral("\\A/proc/[1-9][0-9]*/fd/(?:0|[1-9][0-9]*)\\z"));
    m_path = path.left(LongestPath);
    m_what = what;
    if (path.size() > LongestPath || !form.match(path).hasMatch()) {
        *error = refusal(QStringLiteral("it has to be a descriptor of the master, like /proc/4711/fd/9"));
        return false;
    }
    m_descriptor = ::open(path.toLatin1().constData(), O_PATH | O_CLOEXEC);
    if (m_descriptor < 0 || ::fstat(m_descriptor, &m_status) < 0) {
        *error = refusal(
            QStringLiteral("%1; run both as the same user on the same machine, or use udp").arg(systemErrorText()));
        return false;
    }
    if (m_status.st_uid != owner) {
        *error = refusal(
            QStringLiteral("it belongs to user %1, and the master runs as user %2").arg(m_status.st_uid).arg(owner));
        return false;
    }
    return true;
}

int PeerFile::reopen(int flags, QString *error) const
{
    const QByteArray self = "/proc/self/fd/" + QByteArray::number(m_descriptor);
    const int descriptor = ::open(self.constData(), flags | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        *error = refusal(systemErrorText());
    return descriptor;
}

int PeerFile::openMemory(std::size_t size, QString *error) const
{
    if (!S_ISREG(m_status.st_mode)) {
        *error = refusal(QStringLiteral("it is %1 and not memory").arg(kindOf(m_status)));
        return -1;
    }
    const int readable = reopen(O_RDONLY, error);
    if (readable < 0)
        return -1;
    const int seals = ::fcntl(readable, F_GET_SEALS);
    struct stat status = {};  // what is sealed now keeps its size
    const bool isKnown = ::fstat(readable, &status) == 0;
    ::close(readable);
    if (seals < 0 || (seals & NeededSeals) != NeededSeals) {
        *error = refusal(QStringLiteral("it is a file and not sealed memory"));
        return -1;
    }
    if (!isKnown || status.st_size != off_t(size)) {
        *error = refusal(QStringLiteral("it has %1 bytes instead of %2; update the older of the two programs")
                             .arg(status.st_size)
                             .arg(size));
        return -1;
    }
    return reopen(O_RDWR, error);
}

int PeerFile::openPipe(QString *error) const
{
    if (!S_ISFIFO(m_status.st_mode)) {
        *error = refusal(QStringLiteral("it is %1 and not a pipe").arg(kindOf(m_status)));
        return -1;
    }
    return reopen(O_WRONLY, error);
}

}  // namespace qplc
