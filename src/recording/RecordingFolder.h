// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Disk.h"
#include "PlantRecorder.h"
#include "transport/Descriptor.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// The files of recordings in a folder: their names, which of them are finished, and which are
/// deleted.
///
/// A file is called `20261126T215512.123Z_PLANT_SESSION_phase1.mcap`: UTC when it was begun, plant,
/// session of the master, phase. While it is written, `.part` is behind that. One that stays for
/// ever has `_marked` before `.mcap`. No other files of the folder are touched.
class RecordingFolder
{
public:
    /// 0: no limit
    struct Limits
    {
        std::int64_t longestAge = 0;         // [ms]
        std::uint64_t largestTotal = 0;      // [byte]
        std::uint64_t leastFree = 1U << 30;  // [byte] of the file system
    };
    struct File
    {
        QString path;
        qint64 begin = 0;  // [ms since 1970]
        quint64 size = 0;  // [byte]
        bool isMarked = false;
        bool isUnfinished = false;
    };

    explicit RecordingFolder(Disk &disk);

    /// Makes the folder if it is not there, and becomes its only recorder. Finishes the files of a
    /// recorder that was killed.
    /// \return false when that is not possible, or another one records there
    bool open(const QString &path, QString *error);
    QString path() const { return m_path; }

    /// A name for the next file of a phase, which sorts behind those that are there.
    /// \param now [ms since 1970]
    QString nextFile(const RingDescription &phase, qint64 now) const;
    /// The cycles of \a phase that are in the files of this folder. Reads the newest of them.
    PlantRecorder::Position position(const RingDescription &phase) const;
    /// The file is whole: gives it its name. \return the path
    QString finished(const QString &path, bool isMarked) const;
    /// The file stays from now on. \return the path, which is another one then
    static QString mark(const QString &path);
    /// Deletes the oldest files, until the limits are kept or none is left to delete. Marked and
    /// unfinished ones stay.
    /// \return those that were deleted
    QStringList clean(const Limits &limits, qint64 now) const;
    /// Finishes the files of a recorder that was killed, where that is possible. \return how many
    int finishOthers(const QStringList &own, QString *error) const;

    /// The files of recordings in a folder, the oldest first.
    static QVector<File> files(const QString &folder);
    /// Of the file that RecorderControl::tell() writes.
    int lockDescriptor() const { return m_lock.number(); }
    std::uint64_t freeBytes() const { return m_disk.freeBytes(m_path); }

private:
    Disk &m_disk;
    QString m_path;
    Descriptor m_lock;
};

}  // namespace qplc
