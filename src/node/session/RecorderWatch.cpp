// SPDX-License-Identifier: Apache-2.0
#include "RecorderWatch.h"

#include "node/cycle/NodeRegistry.h"
#include "node/state/StateText.h"
#include "realtime/TimeSource.h"

namespace qplc {

namespace {

using messages::RecorderState;

constexpr int LookEach = 1000;  // [ms]

QString recorderAlarm()
{
    return QStringLiteral("recorder");
}

bool isTroubled(RecorderState state)
{
    return state == RecorderState::DiskFull || state == RecorderState::Failing || state == RecorderState::Stalled
        || state == RecorderState::Gone;
}

}  // namespace

RecorderWatch::RecorderWatch(Journal &journal, std::function<std::uint64_t()> missing)
    : m_journal(journal)
    , m_missing(std::move(missing))
{
    m_timer.setInterval(LookEach);
    QObject::connect(&m_timer, &QTimer::timeout, [this] { look(monotonicNow()); });
}

void RecorderWatch::watch(const std::shared_ptr<RecordRing> &ring)
{
    m_journal.clear(recorderAlarm(), QStringLiteral("a new phase has a new recording"));
    m_ring = ring;
    m_status.reset();
    m_isMissingTold = false;
    m_timer.stop();
    if (!ring)
        return;
    m_timer.start();
    look(monotonicNow());
}

void RecorderWatch::look(std::int64_t now)
{
    const std::shared_ptr<RecordRing> ring = m_ring.lock();
    if (!ring) {
        m_timer.stop();
        return;
    }
    // While it is being written, the former one holds.
    const std::optional<RecorderReport> report = ring->memory().header()->report.read();
    messages::RecorderEntry entry = m_status.value_or(messages::RecorderEntry());
    const RecorderState before = entry.state;
    const std::uint64_t missing = entry.missing;
    if (report)
        entry = toEntry(*report);
    entry.state = stateOf(*ring, report.value_or(RecorderReport()), now);
    if (entry.state != RecorderState::Recording)
        entry.bytesPerSecond = 0;
    if (entry.state == RecorderState::None || entry.state == RecorderState::Stopped)
        entry.file.clear();  // it was finished, and has another name
    entry.missing = m_missing();
    m_status = entry;
    tellState(before);
    tellMissing(missing);
}

/// The kernel says whether it lives, and its reports whether it gets on.
RecorderState RecorderWatch::stateOf(const RecordRing &ring, const RecorderReport &report, std::int64_t now)
{
    const bool isThere = ring.memory().isLocked(RingMemory::RecorderLock);
    if (!ring.isRead())
        return report.state == RecorderReport::Stopped ? RecorderState::Stopped : RecorderState::None;
    if (!isThere)
        return RecorderState::Gone;
    const std::uint64_t version = ring.memory().header()->report.version();
    if (version != m_version || m_changed == 0) {
        m_version = version;
        m_changed = now;
    }
    if (now - m_changed > Patience)
        return RecorderState::Stalled;
    const RecorderState said = toEntry(report).state;
    return said == RecorderState::Stopped ? RecorderState::Recording : said;  // it reads the ring, so that word is old
}

void RecorderWatch::tellState(RecorderState before)
{
    const RecorderState state = m_status->state;
    if (state == before)
        return;
    if (!isTroubled(state)) {
        m_journal.clear(recorderAlarm(), recorderText(*m_status));
        return;
    }
    const auto severity = state == RecorderState::Stalled ? JournalEvent::Warning : JournalEvent::Error;
    m_journal.raise(recorderAlarm(), severity, JournalEvent::State, NodeRegistry::masterName(),
                    recorderText(*m_status));
}

void RecorderWatch::tellMissing(std::uint64_t before)
{
    const bool isGrowing = m_status->missing > before;
    if (isGrowing && !m_isMissingTold)
        m_journal.tell(JournalEvent::Error, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("the ring of the recording is full: cycles are missing from now on"));
    else if (!isGrowing && m_isMissingTold && m_status->state == RecorderState::Recording)
        m_journal.tell(
            JournalEvent::Info, JournalEvent::State, NodeRegistry::masterName(),
            QStringLiteral("cycles are recorded again; %1 are missing in this phase").arg(m_status->missing));
    else
        return;
    m_isMissingTold = isGrowing;
}

}  // namespace qplc
