// SPDX-License-Identifier: Apache-2.0
#include "RecorderLoop.h"

#include "RecorderControl.h"
#include "RingFiles.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <algorithm>
#include <limits>
#include <utility>

namespace qplc {

namespace {

constexpr std::int64_t Millisecond = 1'000'000;                  // [ns]
constexpr std::int64_t LookForRecords = 50 * Millisecond;        // between two looks
constexpr std::int64_t LookForRings = 200 * Millisecond;         //
constexpr std::int64_t SaveAfter = NanosecondsPerSecond;         // a loss of power costs no more
constexpr std::int64_t TryAgainAfter = NanosecondsPerSecond;     // when the file could not be written
constexpr std::int64_t TellAfter = NanosecondsPerSecond;         // other programs, what goes on
constexpr std::int64_t MeasureAfter = 2 * NanosecondsPerSecond;  //
constexpr std::int64_t CleanAfter = 60'000;                      // [ms]
constexpr std::uint64_t FullBelow = 1U << 20;                    // [byte] free: a chunk may have no room
constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::min() / 2;
constexpr int MostAtEnd = 1000;  // chunks

}  // namespace

struct RecorderLoop::Recording
{
    std::unique_ptr<PlantRecorder> recorder;
    QString file;                    // empty: there is none
    QString former;                  // of the same phase, before this one
    std::int64_t begun = Never;      // the file [ns]
    std::int64_t saved = Never;      // [ns]
    std::int64_t retry = Never;      // not before [ns]
    std::int64_t keepUntil = Never;  // [ns]
    std::int64_t next = 0;           // when it is to be called again [ns]
    std::uint64_t toldCycles = 0;    // of this file, in the status
    std::uint64_t toldMissing = 0;
    std::int64_t reported = Never;    // to the master [ns]
    std::int64_t rateSince = Never;   // [ns]
    std::uint64_t finishedBytes = 0;  // of files before this one
    std::uint64_t bytesBefore = 0;    // at rateSince
    std::uint64_t bytesPerSecond = 0;
    bool isMarked = false;
    bool isOver = false;
};

RecorderLoop::RecorderLoop(const Settings &settings, Disk &disk)
    : m_settings(settings)
    , m_disk(disk)
    , m_folder(disk)
    , m_looked(Never)
    , m_controlled(Never)
    , m_told(Never)
    , m_measured(Never)
{
}

RecorderLoop::~RecorderLoop() = default;

bool RecorderLoop::open(QString *error)
{
    if (m_settings.file.isEmpty())
        return m_folder.open(m_settings.folder, error);
    const QFileInfo file(m_settings.file);
    if (file.exists())
        *error = QStringLiteral("'%1' is there already; delete it, or choose another name").arg(m_settings.file);
    else if (!QFileInfo(file.path()).isDir() || !QFileInfo(file.path()).isWritable())
        *error = QStringLiteral("cannot make the file '%1': its folder is not there, or you may not write into it")
                     .arg(m_settings.file);
    else
        return true;
    return false;
}

void RecorderLoop::add(std::unique_ptr<PlantRecorder> recorder)
{
    if (m_status.isStopped) {
        m_left.append(recorder->ringFile());
        recorder->detach();
        return;
    }
    auto recording = std::make_unique<Recording>();
    if (m_settings.file.isEmpty() && !recorder->isCut())
        recorder->goOnFrom(m_folder.position(recorder->description()));
    recording->recorder = std::move(recorder);
    m_recordings.push_back(std::move(recording));
    m_status.phases = int(m_recordings.size());
}

/// Rings of masters that have ended, too: what is in them is in no file yet.
void RecorderLoop::look()
{
    const QStringList rings = m_settings.file.isEmpty() ? ringsToRecord() : ringsOfMasters();
    for (const QString &ring : rings) {
        if (RingMemory::isRecorded(QFile::encodeName(ring)))  // by this recorder, or by another one
            continue;
        auto recorder = std::make_unique<PlantRecorder>();
        QString error;  // another recorder may have been faster
        if (!recorder->attach(QFile::encodeName(ring), &error))
            continue;
        if (m_settings.plant.isEmpty() || recorder->description().plant == m_settings.plant)
            add(std::move(recorder));
        else
            recorder->detach();
    }
}

/// What people want of the recorder of a folder.
void RecorderLoop::control(std::int64_t now, std::int64_t wallClock)
{
    const bool isStopped = RecorderControl::isStopped(m_folder.path());
    if (isStopped != m_status.isStopped)
        setStopped(isStopped, wallClock);
    if (RecorderControl::takeMark(m_folder.path()))
        mark(now);
    if (now - m_told >= TellAfter) {
        m_told = now;
        tell(now);
    }
}

/// Rings that are left show the last seconds, and are recorded from there on after a start.
void RecorderLoop::setStopped(bool isStopped, std::int64_t wallClock)
{
    m_status.isStopped = isStopped;
    if (isStopped) {
        RecorderReport stopped;
        stopped.state = RecorderReport::Stopped;
        for (const std::unique_ptr<Recording> &recording : m_recordings) {
            m_left.append(recording->recorder->ringFile());
            recording->recorder->report(stopped);
        }
        if (!end(wallClock, &m_error))
            m_status.error = m_error;
        m_status.hasFailed = false;
        return;
    }
    const QVector<QByteArray> left = std::exchange(m_left, {});
    for (const QByteArray &ring : left) {
        auto recorder = std::make_unique<PlantRecorder>();
        QString error;  // the phase may be over, and the ring deleted
        if (recorder->attach(ring, &error))
            add(std::move(recorder));
    }
}

void RecorderLoop::tell(std::int64_t now)
{
    measure(now);
    const char *state = m_status.isStopped ? "stopped"
        : m_status.hasFailed               ? "retrying"
        : m_status.phases > 0              ? "recording"
                                           : "waiting";
    RecorderControl::tell(m_folder.lockDescriptor(),
                          {{"state", state},
                           {"phases", QByteArray::number(m_status.phases)},
                           {"file", m_status.file.toUtf8()},
                           {"cycles", QByteArray::number(m_status.cycles)},
                           {"missing", QByteArray::number(m_status.missing)},
                           {"bytes", QByteArray::number(m_status.bytes)},
                           {"bytes_per_second", QByteArray::number(m_status.bytesPerSecond, 'f', 0)},
                           {"free_bytes", QByteArray::number(m_status.freeBytes)},
                           {"error", m_status.error.toUtf8()}});
}

QString RecorderLoop::place() const
{
    return m_settings.file.isEmpty() ? m_folder.path() : QFileInfo(m_settings.file).absolutePath();
}

/// To the master of a phase.
void RecorderLoop::report(Recording *recording, std::int64_t now)
{
    recording->reported = now;
    const std::uint64_t bytes = recording->finishedBytes + recording->recorder->bytes();
    if (now - recording->rateSince >= MeasureAfter) {
        if (recording->rateSince != Never)
            recording->bytesPerSecond
                = std::uint64_t(double(bytes - recording->bytesBefore) * 1e9 / double(now - recording->rateSince));
        recording->rateSince = now;
        recording->bytesBefore = bytes;
    }
    const RecorderReport::State state = !m_status.hasFailed ? RecorderReport::Recording
        : m_status.isFull                                   ? RecorderReport::DiskFull
                                                            : RecorderReport::Failing;
    const QString &newest = recording->file.isEmpty() ? recording->former : recording->file;
    recording->recorder->report({state, recording->bytesPerSecond, m_disk.freeBytes(place()),
                                 QFileInfo(newest).absoluteFilePath(), m_status.error});
}

QString RecorderLoop::nextFile()
{
    ++m_files;
    if (m_files == 1)
        return m_settings.file;
    const QFileInfo info(m_settings.file);
    const QString suffix = info.suffix().isEmpty() ? QString() : QLatin1Char('.') + info.suffix();
    return m_settings.file.left(m_settings.file.size() - suffix.size()) + QStringLiteral("-%1").arg(m_files) + suffix;
}

bool RecorderLoop::openFile(Recording *recording, std::int64_t now, std::int64_t wallClock)
{
    PlantRecorder &recorder = *recording->recorder;
    const bool isOneFile = !m_settings.file.isEmpty();
    const QString file = isOneFile ? nextFile() : m_folder.nextFile(recorder.description(), wallClock);
    QString error;
    std::unique_ptr<mcap::FileSink> sink = m_disk.create(file, &error);
    const bool isThere = sink != nullptr;
    if (!sink || !recorder.begin(std::move(sink), &error)) {
        if (isThere)
            QFile::remove(file);
        if (isOneFile)
            --m_files;
        fail(recording, error, now, wallClock);
        return false;
    }
    recording->file = m_status.file = file;
    recording->begun = now;
    recording->saved = Never;  // the first records are in safety at once
    recording->toldCycles = recording->toldMissing = 0;
    recording->isMarked = false;
    if (m_tell)
        m_tell({file, recorder.description().plant});
    if (now < recording->keepUntil)
        keep(recording, now);
    return true;
}

/// What cannot be written stays in the ring.
void RecorderLoop::fail(Recording *recording, const QString &error, std::int64_t now, std::int64_t wallClock)
{
    m_status.error = error;
    m_status.hasFailed = true;
    m_status.isFull = m_disk.freeBytes(place()) < FullBelow;
    report(recording, now);
    recording->retry = recording->next = now + TryAgainAfter;
    clean(wallClock);
}

void RecorderLoop::clean(std::int64_t wallClock)
{
    if (m_settings.file.isEmpty())
        m_folder.clean(m_settings.limits, wallClock);
    m_cleaned = wallClock;
}

bool RecorderLoop::isLongEnough(const Recording &recording, std::int64_t now) const
{
    return m_settings.file.isEmpty()
        && (now - recording.begun >= m_settings.segmentTime || recording.recorder->bytes() >= m_settings.segmentSize);
}

bool RecorderLoop::save(Recording *recording, std::int64_t now)
{
    recording->saved = now;
    return recording->recorder->save(true, &m_error);
}

void RecorderLoop::step(Recording *recording, std::int64_t now, std::int64_t wallClock)
{
    PlantRecorder &recorder = *recording->recorder;
    if (now < recording->retry)
        return;
    if (!recorder.hasFile() && !openFile(recording, now, wallClock))
        return;
    const PlantRecorder::Progress progress = recorder.proceed(&m_error);
    // A master that has ended in its phase was killed, or has crashed.
    const bool isLeft = progress == PlantRecorder::Abandoned || progress == PlantRecorder::CutEnded;
    if (recorder.takeTriggers() != 0 || isLeft)
        keep(recording, now);
    const bool isOver = progress == PlantRecorder::Ended || isLeft;
    bool isWritten = progress != PlantRecorder::Failed;
    if (isWritten && !isOver && now - recording->saved >= SaveAfter)
        isWritten = save(recording, now);
    if (isWritten && (isOver || isLongEnough(*recording, now)))
        isWritten = finishFile(recording, progress == PlantRecorder::Abandoned, wallClock);
    if (!isWritten)
        return fail(recording, m_error, now, wallClock);
    m_status.hasFailed = false;
    recording->isOver = isOver;
    recording->next = progress == PlantRecorder::Recorded ? now : now + LookForRecords;
}

bool RecorderLoop::finishFile(Recording *recording, bool isAbandoned, std::int64_t wallClock)
{
    PlantRecorder &recorder = *recording->recorder;
    const std::uint64_t bytes = recorder.bytes();
    if (!recorder.finish(&m_error))
        return false;
    measure(m_measured);
    m_finished += bytes;
    recording->finishedBytes += bytes;
    if (m_settings.file.isEmpty())
        recording->file = m_folder.finished(recording->file, recording->isMarked);
    m_status.file = recording->file;
    if (m_tell)
        m_tell(
            {recording->file, recorder.description().plant, true, recorder.cycles(), recorder.missing(), isAbandoned});
    recording->former = recording->file;
    recording->file.clear();
    clean(wallClock);
    return true;
}

/// The file of the cycles before stays, too, if they are young enough.
void RecorderLoop::keep(Recording *recording, std::int64_t now)
{
    recording->keepUntil = std::max(recording->keepUntil, now + m_settings.keepAfter);
    if (!m_settings.file.isEmpty())
        return;
    recording->isMarked = true;
    if (!recording->file.isEmpty())
        recording->file = m_status.file = RecordingFolder::mark(recording->file);
    if (!recording->former.isEmpty() && now - recording->begun < m_settings.keepBefore)
        recording->former = RecordingFolder::mark(recording->former);
}

bool RecorderLoop::mark(std::int64_t now)
{
    for (const std::unique_ptr<Recording> &recording : m_recordings)
        keep(recording.get(), now);
    return !m_recordings.empty();
}

/// Figures of the status.
void RecorderLoop::measure(std::int64_t now)
{
    std::uint64_t bytes = m_finished;
    for (const std::unique_ptr<Recording> &recording : m_recordings) {
        const PlantRecorder &recorder = *recording->recorder;
        bytes += recorder.bytes();
        m_status.cycles += recorder.cycles() - std::exchange(recording->toldCycles, recorder.cycles());
        m_status.missing += recorder.missing() - std::exchange(recording->toldMissing, recorder.missing());
    }
    m_status.bytes = bytes;
    if (now == m_measured || now - m_measured < MeasureAfter)
        return;
    if (m_measured != Never)
        m_status.bytesPerSecond = double(bytes - m_before) * 1e9 / double(now - m_measured);
    m_before = bytes;
    m_measured = now;
    m_status.freeBytes = m_disk.freeBytes(place());
}

std::int64_t RecorderLoop::proceed(std::int64_t now, std::int64_t wallClock)
{
    if (m_settings.file.isEmpty() && now - m_controlled >= LookForRings) {
        m_controlled = now;
        control(now, wallClock);
    }
    if (m_settings.looksForRings && !m_status.isStopped && now - m_looked >= LookForRings) {
        m_looked = now;
        look();
    }
    std::int64_t next = now + LookForRings;
    for (const std::unique_ptr<Recording> &recording : m_recordings) {
        step(recording.get(), now, wallClock);
        if (now - recording->reported >= TellAfter)
            report(recording.get(), now);
        next = std::min(next, recording->next);
    }
    measure(now);
    const auto over = std::stable_partition(m_recordings.begin(), m_recordings.end(),
                                            [](const auto &recording) { return !recording->isOver; });
    std::for_each(over, m_recordings.end(), [](const auto &recording) {
        recording->recorder->detach();
        recording->recorder->removeRing();
    });
    m_recordings.erase(over, m_recordings.end());
    m_status.phases = int(m_recordings.size());
    if (wallClock - m_cleaned >= CleanAfter)
        clean(wallClock);
    return std::max<std::int64_t>(next - now, 0);
}

bool RecorderLoop::end(std::int64_t wallClock, QString *error)
{
    bool isWritten = true;
    for (const std::unique_ptr<Recording> &recording : m_recordings) {
        PlantRecorder &recorder = *recording->recorder;
        PlantRecorder::Progress progress = PlantRecorder::Recorded;
        for (int i = 0; recorder.hasFile() && i < MostAtEnd && progress == PlantRecorder::Recorded; ++i)
            progress = recorder.proceed(&m_error);
        const bool isAbandoned = progress == PlantRecorder::Abandoned;
        if (!recorder.hasFile()) {
            if (!m_status.hasFailed)  // a file has ended just now, and the next one has not begun
                recorder.detach();
            continue;
        }
        if (!finishFile(recording.get(), isAbandoned, wallClock)) {
            *error = m_error;
            isWritten = false;  // the ring keeps what is in no file
            if (recorder.cut(&m_error) && m_settings.file.isEmpty())
                m_folder.finished(recording->file, recording->isMarked);
            continue;
        }
        recorder.detach();
        if (isAbandoned || progress == PlantRecorder::Ended || progress == PlantRecorder::CutEnded)
            recorder.removeRing();
    }
    m_recordings.clear();
    m_status.phases = 0;
    return isWritten;
}

}  // namespace qplc
