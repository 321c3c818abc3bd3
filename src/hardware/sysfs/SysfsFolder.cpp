// SPDX-License-Identifier: Apache-2.0
#include "SysfsFolder.h"

#include "SysfsText.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

/// \return a descriptor; -1, with errno
int openRegularFile(int folder, const QByteArray &file, int flags)
{
    // O_NONBLOCK: a pipe must not block here.
    const int descriptor = ::openat(folder, file.constData(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    struct stat status = {};
    if (descriptor < 0 || (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)))
        return descriptor;
    ::close(descriptor);
    errno = ENOTSUP;
    return -1;
}

}  // namespace

SysfsFolder::~SysfsFolder()
{
    close();
}

bool SysfsFolder::open(const QString &path)
{
    close();
    m_path = path;
    m_descriptor = ::open(QFile::encodeName(path).constData(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    return m_descriptor >= 0;
}

void SysfsFolder::close()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
    m_descriptor = -1;
}

bool SysfsFolder::read(const QByteArray &file, QByteArray *text) const
{
    const int descriptor = openRegularFile(m_descriptor, file, O_RDONLY);
    if (descriptor < 0)
        return false;
    char bytes[MostBytes + 1];
    ssize_t taken = 0;
    ssize_t count = 0;
    do {
        count = ::pread(descriptor, bytes + taken, sizeof bytes - std::size_t(taken), taken);
        taken += count > 0 ? count : 0;
    } while ((count > 0 && taken <= MostBytes) || (count < 0 && errno == EINTR));
    const int errorNumber = count < 0 ? errno : taken > MostBytes ? EFBIG : 0;
    ::close(descriptor);
    *text = QByteArray(bytes, int(taken));
    errno = errorNumber;
    return errorNumber == 0;
}

bool SysfsFolder::write(const QByteArray &file, const QByteArray &text) const
{
    const int descriptor = openRegularFile(m_descriptor, file, O_WRONLY | O_TRUNC);
    if (descriptor < 0)
        return false;
    const bool isWritten = ::write(descriptor, text.constData(), std::size_t(text.size())) == text.size();
    const int errorNumber = isWritten ? 0 : errno;
    ::close(descriptor);
    errno = errorNumber;
    return isWritten;
}

bool SysfsFolder::has(const QByteArray &file) const
{
    return ::faccessat(m_descriptor, file.constData(), F_OK, 0) == 0;
}

double SysfsFolder::firstNumber(const QByteArrayList &files, double fallback) const
{
    for (const QByteArray &file : files) {
        QByteArray text;
        const std::optional<double> number = read(file, &text) ? SysfsText::number(text) : std::nullopt;
        if (number)
            return *number;
    }
    return fallback;
}

bool SysfsFolder::isWritable(const QByteArray &file) const
{
    return ::faccessat(m_descriptor, file.constData(), W_OK, 0) == 0;
}

QByteArrayList SysfsFolder::files(const QString &pattern) const
{
    QByteArrayList names;
    for (const QString &name : QDir(m_path).entryList({pattern}, QDir::AllEntries | QDir::NoDotAndDotDot, QDir::Name))
        names << QFile::encodeName(name);
    return names;
}

}  // namespace qplc
