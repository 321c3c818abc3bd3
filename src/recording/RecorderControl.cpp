// SPDX-License-Identifier: Apache-2.0
#include "RecorderControl.h"

#include "transport/Descriptor.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr qint64 MostStatus = 64 * 1024;  // [byte]

QString markFile(const QString &folder)
{
    return QDir(folder).filePath(QStringLiteral(".qtplc-mark"));
}

QString stopFile(const QString &folder)
{
    return QDir(folder).filePath(QStringLiteral(".qtplc-stopped"));
}

bool makeEmpty(const QString &name, QString *error)
{
    const Descriptor file(::open(QFile::encodeName(name).constData(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
    if (!file.isOpen())
        *error = QStringLiteral("cannot write '%1': %2").arg(name, qt_error_string(errno));
    return file.isOpen();
}

}  // namespace

QString RecorderControl::lockFile(const QString &folder)
{
    return QDir(folder).filePath(QStringLiteral(".qtplc-recorder"));
}

bool RecorderControl::hasRecorder(const QString &folder)
{
    const Descriptor file(::open(QFile::encodeName(lockFile(folder)).constData(), O_RDONLY | O_CLOEXEC));
    return file.isOpen() && ::flock(file.number(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

RecorderControl::Status RecorderControl::status(const QString &folder)
{
    QFile file(lockFile(folder));
    if (!file.open(QIODevice::ReadOnly))
        return {};
    Status status;
    const QList<QByteArray> lines = file.read(MostStatus).split('\n');
    for (const QByteArray &line : lines) {
        const int colon = line.indexOf(": ");
        if (colon > 0)
            status.insert(line.left(colon), line.mid(colon + 2));
    }
    return status;
}

bool RecorderControl::askForMark(const QString &folder, QString *error)
{
    return makeEmpty(markFile(folder), error);
}

bool RecorderControl::isMarkTaken(const QString &folder)
{
    return !QFileInfo::exists(markFile(folder));
}

void RecorderControl::withdrawMark(const QString &folder)
{
    QFile::remove(markFile(folder));
}

bool RecorderControl::setStopped(const QString &folder, bool isStopped, QString *error)
{
    if (isStopped)
        return makeEmpty(stopFile(folder), error);
    if (!QFileInfo::exists(stopFile(folder)) || QFile::remove(stopFile(folder)))
        return true;
    *error = QStringLiteral("cannot remove '%1'; may you write into its folder?").arg(stopFile(folder));
    return false;
}

bool RecorderControl::isStopped(const QString &folder)
{
    return QFileInfo::exists(stopFile(folder));
}

bool RecorderControl::takeMark(const QString &folder)
{
    return ::unlink(QFile::encodeName(markFile(folder)).constData()) == 0;
}

/// In one write, so that a reader sees one whole status or the end of a former one behind it.
void RecorderControl::tell(int descriptor, const Status &status)
{
    QByteArray text;
    for (auto it = status.begin(); it != status.end(); ++it)
        text += it.key() + ": " + it.value().simplified() + '\n';
    // What cannot be written on a full disk stays as it was.
    if (::pwrite(descriptor, text.constData(), std::size_t(text.size()), 0) == text.size()) {
        [[maybe_unused]] const int cut = ::ftruncate(descriptor, text.size());
    }
}

}  // namespace qplc
