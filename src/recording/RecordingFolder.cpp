// SPDX-License-Identifier: Apache-2.0
#include "RecordingFolder.h"

#include "McapFormat.h"
#include "RecorderControl.h"
#include "RecordingName.h"
#include "Recovery.h"
#include "Verification.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>

namespace qplc {

namespace {

/// Gives a file of a recorder another name. \return its new path; \a path if it keeps its name
template<typename Change>
QString renamed(const QString &path, Change change)
{
    const QFileInfo file(path);
    std::optional<RecordingName> name = RecordingName::parse(file.fileName());
    if (!name)
        return path;
    change(&*name);
    const QString result = file.dir().filePath(name->toString());
    return QFile::rename(path, result) ? result : path;
}

}  // namespace

RecordingFolder::RecordingFolder(Disk &disk)
    : m_disk(disk)
{
}

bool RecordingFolder::open(const QString &path, QString *error)
{
    m_path = QDir(path).absolutePath();
    if (!QDir().mkpath(m_path)) {
        *error = QStringLiteral("cannot make the folder '%1'").arg(m_path);
        return false;
    }
    const QString lock = RecorderControl::lockFile(m_path);
    m_lock = Descriptor(::open(QFile::encodeName(lock).constData(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (!m_lock.isOpen()) {
        *error = QStringLiteral("cannot write into the folder '%1': %2").arg(m_path, qt_error_string(errno));
        return false;
    }
    if (::flock(m_lock.number(), LOCK_EX | LOCK_NB) != 0) {
        *error = QStringLiteral("another recorder records into '%1'; stop it first, or use another folder").arg(m_path);
        return false;
    }
    QString why;
    finishOthers({}, &why);  // what cannot be finished now stays as it is
    return true;
}

QVector<RecordingFolder::File> RecordingFolder::files(const QString &folder)
{
    const QDir dir(folder);
    QVector<File> result;
    const QFileInfoList all = dir.entryInfoList(QDir::Files, QDir::Name);
    for (const QFileInfo &info : all) {
        if (const auto name = RecordingName::parse(info.fileName()))
            result.append({info.filePath(), name->begin, quint64(info.size()), name->isMarked, name->isUnfinished});
    }
    return result;
}

QString RecordingFolder::nextFile(const RingDescription &phase, qint64 now) const
{
    const QVector<File> known = files(m_path);
    for (const File &file : known)
        now = std::max(now, file.begin + 1);  // also where the clock was set back
    return QDir(m_path).filePath(RecordingName::of(phase, now).toString());
}

PlantRecorder::Position RecordingFolder::position(const RingDescription &phase) const
{
    const RecordingName wanted = RecordingName::of(phase, 0);
    const QVector<File> known = files(m_path);
    for (int i = known.size() - 1; i >= 0; --i) {
        const auto name = RecordingName::parse(QFileInfo(known[i].path).fileName());
        if (!name || !name->isOfSamePhase(wanted))
            continue;
        VerifiedFile found;
        QString error;
        if (!verifyRecording(known[i].path, &found, &error))
            return {};
        return {found.next, found.digest};
    }
    return {};
}

QString RecordingFolder::finished(const QString &path, bool isMarked) const
{
    return renamed(path, [isMarked](RecordingName *name) {
        name->isUnfinished = false;
        name->isMarked = name->isMarked || isMarked;
    });
}

QString RecordingFolder::mark(const QString &path)
{
    return renamed(path, [](RecordingName *name) { name->isMarked = true; });
}

QStringList RecordingFolder::clean(const Limits &limits, qint64 now) const
{
    const QVector<File> known = files(m_path);
    quint64 total = 0;
    for (const File &file : known)
        total += file.size;
    QStringList deleted;
    for (const File &file : known) {
        const bool isTooOld = limits.longestAge > 0 && now - file.begin > limits.longestAge;
        const bool isTooMuch = limits.largestTotal > 0 && total > limits.largestTotal;
        const bool isTooFull = limits.leastFree > 0 && freeBytes() < limits.leastFree;
        if (!isTooOld && !isTooMuch && !isTooFull)
            break;
        if (file.isMarked || file.isUnfinished || !QFile::remove(file.path))
            continue;
        total -= file.size;
        deleted << file.path;
    }
    return deleted;
}

int RecordingFolder::finishOthers(const QStringList &own, QString *error) const
{
    int count = 0;
    const QVector<File> known = files(m_path);
    for (const File &file : known) {
        if (!file.isUnfinished || own.contains(file.path))
            continue;
        RecoveredFile result;
        const bool isBegun = file.size >= quint64(mcap::MagicSize);
        if (isBegun && !recoverRecording(file.path, &result, error) && !result.hasNothing)
            continue;
        ++count;
        // Its recorder was killed before it wrote anything: the ring still has it.
        if (!isBegun || (result.chunks == 0 && result.damages == 0 && !result.wasFinished))
            QFile::remove(file.path);
        else if (!result.hasNothing)
            finished(file.path, false);
    }
    return count;
}

}  // namespace qplc
