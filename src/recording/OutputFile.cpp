// SPDX-License-Identifier: Apache-2.0
#include "OutputFile.h"

#include <QtCore/QFileInfo>
#include <QtCore/QTemporaryFile>

#include <cerrno>
#include <cstdio>

#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

QString existsText(const QString &name)
{
    return QStringLiteral("'%1' is there already; choose another name, or give --force to replace it").arg(name);
}

/// What a file gets that a program makes in the usual way.
mode_t usualMode()
{
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return mode_t(0666) & ~mask;
}

/// Why \a file did not take all bytes. Qt knows it only where the kernel took none; another byte
/// tells it where it took some, as a disk does that becomes full.
QString writeError(const QFile &file)
{
    const char byte = 0;
    return ::write(file.handle(), &byte, 1) < 0 ? qt_error_string(errno) : file.errorString();
}

}  // namespace

OutputFile::OutputFile(const QString &name, Existing existing)
    : m_name(name)
    , m_existing(existing)
{
    if (isStandardOutput())
        m_file = std::make_unique<QFile>();
    else
        m_file = std::make_unique<QTemporaryFile>(QFileInfo(name).absolutePath() + QStringLiteral("/.qtplc-XXXXXX"));
}

bool OutputFile::fail(const QString &reason, QString *error) const
{
    const QString name = isStandardOutput() ? QStringLiteral("to the standard output")
                                            : QLatin1Char('\'') + m_name + QLatin1Char('\'');
    *error = QStringLiteral("cannot write %1: %2").arg(name, reason);
    return false;
}

bool OutputFile::open(QString *error)
{
    if (isStandardOutput())
        return m_file->open(STDOUT_FILENO, QIODevice::WriteOnly | QIODevice::Unbuffered)
            || fail(m_file->errorString(), error);
    if (m_existing == Refuse && QFileInfo::exists(m_name)) {
        *error = existsText(m_name);
        return false;
    }
    struct stat known = {};
    const bool isThere = ::lstat(QFile::encodeName(m_name).constData(), &known) == 0;
    if (isThere && S_ISDIR(known.st_mode))
        return fail(QStringLiteral("it is a folder"), error);
    if (isThere && S_ISLNK(known.st_mode))
        return fail(QStringLiteral("it is a link; name the file that it leads to"), error);
    if (isThere && !S_ISREG(known.st_mode))
        return fail(QStringLiteral("it is not a file; choose another name"), error);
    return m_file->open(QIODevice::ReadWrite) || fail(m_file->errorString(), error);
}

bool OutputFile::write(const QByteArray &bytes, QString *error)
{
    m_size += bytes.size();
    return m_file->write(bytes) == bytes.size() || fail(writeError(*m_file), error);
}

bool OutputFile::commit(QString *error)
{
    if (!m_file->flush())
        return fail(writeError(*m_file), error);
    if (isStandardOutput())
        return true;
    if (::fdatasync(m_file->handle()) != 0 || ::fchmod(m_file->handle(), usualMode()) != 0)
        return fail(qt_error_string(errno), error);
    const QByteArray from = QFile::encodeName(m_file->fileName());
    const QByteArray to = QFile::encodeName(m_name);
    if (m_existing == Replace)
        return ::rename(from.constData(), to.constData()) == 0 || fail(qt_error_string(errno), error);
    if (::link(from.constData(), to.constData()) == 0)
        return true;
    if (errno != EEXIST)
        return fail(qt_error_string(errno), error);
    *error = existsText(m_name);
    return false;
}

}  // namespace qplc
