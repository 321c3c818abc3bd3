// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantRecorder.h"
#include "RecordingFolder.h"
#include "realtime/TimeSource.h"

#include <QtCore/QStringList>

#include <functional>
#include <memory>
#include <vector>

namespace qplc {

/// Records phases of plants into a file or a folder: what the thread of a recorder does.
///
/// It sleeps, waits and asks the time nowhere: the caller says what time it is, and gets told when
/// to call again. So a test needs no time.
///
/// For one thread.
class RecorderLoop
{
public:
    struct Settings
    {
        QString file;    // the second phase goes into FILE-2; empty: into the folder
        QString folder;  // where files are made as they are needed
        QString plant;   // of which plant; empty: of all
        bool looksForRings = false;
        std::int64_t segmentTime = 3600 * NanosecondsPerSecond;  // a file of the folder is not longer [ns]
        std::uint64_t segmentSize = 256U << 20;                  // [byte]
        std::int64_t keepBefore = 30 * NanosecondsPerSecond;     // what a mark keeps [ns]
        std::int64_t keepAfter = 10 * NanosecondsPerSecond;
        RecordingFolder::Limits limits;
    };
    /// A file was begun, or is finished.
    struct FileNews
    {
        QString file;
        QString plant;
        bool isFinished = false;
        quint64 cycles = 0;
        quint64 missing = 0;
        bool isAbandoned = false;  // the master has ended without the end of its phase
    };
    struct Status
    {
        int phases = 0;             // that are being recorded
        bool isStopped = false;     // somebody wants that nothing is recorded
        bool hasFailed = false;     // files cannot be written at the moment
        bool isFull = false;        // because the disk has no room
        QString error;              // the newest one
        QString file;               // the newest one
        quint64 cycles = 0;         // since the begin
        quint64 missing = 0;        // likewise
        quint64 bytes = 0;          // likewise
        double bytesPerSecond = 0;  // over the last seconds
        quint64 freeBytes = 0;
    };

    RecorderLoop(const Settings &settings, Disk &disk);
    ~RecorderLoop();

    /// \return false when nothing can be recorded there
    bool open(QString *error);
    void setCallback(std::function<void(const FileNews &)> tell) { m_tell = std::move(tell); }
    /// Records from a ring to which \a recorder is attached, until its phase ends.
    void add(std::unique_ptr<PlantRecorder> recorder);
    /// Does what there is to do. \param now [ns], \param wallClock [ms since 1970]
    /// \return [ns] until it is to be called again
    std::int64_t proceed(std::int64_t now, std::int64_t wallClock);
    /// Cycles around now stay. \return false: nothing is recorded
    bool mark(std::int64_t now);
    /// Records what is in the rings by now, and finishes the files. \return false when one of them
    /// cannot be finished: it has no summary then
    bool end(std::int64_t wallClock, QString *error);
    const Status &status() const { return m_status; }

private:
    struct Recording;

    void look();
    void control(std::int64_t now, std::int64_t wallClock);
    void setStopped(bool isStopped, std::int64_t wallClock);
    void tell(std::int64_t now);
    void report(Recording *recording, std::int64_t now);
    QString place() const;
    bool openFile(Recording *recording, std::int64_t now, std::int64_t wallClock);
    void step(Recording *recording, std::int64_t now, std::int64_t wallClock);
    bool save(Recording *recording, std::int64_t now);
    bool finishFile(Recording *recording, bool isAbandoned, std::int64_t wallClock);
    bool isLongEnough(const Recording &recording, std::int64_t now) const;
    void keep(Recording *recording, std::int64_t now);
    void fail(Recording *recording, const QString &error, std::int64_t now, std::int64_t wallClock);
    void clean(std::int64_t wallClock);
    void measure(std::int64_t now);
    QString nextFile();

    const Settings m_settings;
    Disk &m_disk;
    RecordingFolder m_folder;
    std::vector<std::unique_ptr<Recording>> m_recordings;
    std::function<void(const FileNews &)> m_tell;
    Status m_status;
    QString m_error;
    int m_files = 0;                // that --record FILE has made
    QVector<QByteArray> m_left;     // rings that are not recorded since the stop
    std::int64_t m_looked = 0;      // [ns]
    std::int64_t m_controlled = 0;  // [ns]
    std::int64_t m_told = 0;        // [ns]
    std::int64_t m_cleaned = 0;     // [ms]
    std::int64_t m_measured = 0;    // [ns]
    std::uint64_t m_finished = 0;   // [byte] of files that are finished
    std::uint64_t m_before = 0;     // [byte] at m_measured
};

}  // namespace qplc
