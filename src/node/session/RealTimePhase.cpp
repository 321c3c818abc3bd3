// SPDX-License-Identifier: Apache-2.0
#include "RealTimePhase.h"

#include "realtime/TimeSource.h"

#include <utility>

namespace qplc {

namespace {

constexpr int LookForRecorder = 20;  // [ms]

/// Those that a phase was computed with, for people who read a recording of it.
QMap<QString, QString> parametersOf(const MasterCycle::Phase &phase)
{
    const auto duration = [](std::chrono::nanoseconds value) { return QString::number(value.count()); };
    return {{QStringLiteral("hold_cycles"), QString::number(phase.usualHold)},
            {QStringLiteral("longest_wait_ns"), duration(phase.longestWait)},
            {QStringLiteral("gap_limit_ns"), duration(phase.gapLimit)},
            {QStringLiteral("overrun_policy"), phase.overrunPolicy.toString()},
            {QStringLiteral("overrun_limit"), QString::number(phase.overrunLimit)},
            {QStringLiteral("cycle_limit"), QString::number(phase.cycleLimit)}};
}

}  // namespace

RealTimePhase::RealTimePhase(MasterCycle &cycle, const NodeRegistry &registry, RosterMaker &rosters,
                             OwnSignals &ownSignals, const PhaseSettings &settings, const PhaseProfile &profile,
                             Journal &journal)
    : m_cycle(cycle)
    , m_registry(registry)
    , m_rosters(rosters)
    , m_ownSignals(ownSignals)
    , m_settings(settings)
    , m_profile(profile)
    , m_journal(journal)
    , m_ring(journal)
    , m_recorder(journal, [&cycle] { return cycle.tap().missing(); })
    , m_blackBox(journal, m_ring, {[this] { return m_isRunning; }, [&cycle] { return cycle.cycle(); }})
{
    m_recorderTimer.setInterval(LookForRecorder);
    QObject::connect(&m_recorderTimer, &QTimer::timeout, [this] { lookForRecorder(); });
}

MasterCycle::Phase RealTimePhase::settingsOfCycles() const
{
    const ProfileDefaults &defaults = m_profile.defaults();
    MasterCycle::Phase phase;
    phase.period = m_settings.interval;
    phase.clock = m_settings.clock;
    phase.overrunPolicy = m_settings.overrunPolicy;
    phase.cycleLimit = m_settings.cyclesWanted > 0 ? m_settings.cyclesWanted : m_settings.cycleLimit;
    phase.timeSignal = m_ownSignals.index(OwnSignals::Time);
    phase.jitterSignal = m_ownSignals.index(OwnSignals::Jitter);
    phase.workloadSignal = m_ownSignals.index(OwnSignals::Workload);
    phase.realTimeOptions = m_settings.realTimeOptions;
    phase.gapLimit = m_settings.gapLimit.value_or(defaults.gapLimit);
    phase.longestWait = m_settings.longestWait.value_or(defaults.longestWait);
    if (phase.clock.isExternal() && phase.longestWait == std::chrono::nanoseconds(0))
        phase.longestWait = ProfileDefaults::longestStep;
    phase.usualHold = defaults.hold;
    phase.overrunLimit = m_settings.overrunLimit;
    return phase;
}

/// After renewRoster(): the nodes of the phase make the size of a record.
std::shared_ptr<RecordRing> RealTimePhase::makeRing()
{
    if (!m_settings.hasRing)
        return nullptr;
    static const char *const names[] = {"real-time", "scaled", "lockstep", "external"};
    RingDescription description;
    description.period = m_settings.interval.count();
    description.clock = QString::fromLatin1(names[m_settings.clock.kind()]);
    description.scale = m_settings.clock.scale();
    for (const OwnSignals::Role role : {OwnSignals::Time, OwnSignals::Jitter, OwnSignals::Workload}) {
        if (m_ownSignals.index(role) != QPlcInvalidSignalIndex)
            description.ownSignals.append(m_ownSignals.index(role));
    }
    description.profile = QPlcProfile::name(m_profile.fixed().value);
    description.parameters = parametersOf(settingsOfCycles());
    description.table = m_cycle.table().toIni();
    std::shared_ptr<RecordRing> ring
        = m_ring.make(description, CycleTap::usualSize(m_cycle.image(), m_registry.nodes().size()));
    if (ring)
        m_remoteRecorder.begin(m_ring.file(), monotonicNow());
    return ring;
}

bool RealTimePhase::start(QString *error)
{
    m_rosters.forgetWritten();
    for (const std::shared_ptr<NodeSlot> &slot : m_registry.nodes())
        slot->goesOn = false;
    renewRoster();
    MasterCycle::Phase cycles = settingsOfCycles();
    cycles.ring = makeRing();
    if (!m_cycle.start(cycles)) {
        *error = m_cycle.errorString();
        return false;
    }
    m_recorder.watch(cycles.ring);
    m_blackBox.watch(cycles.ring, m_settings.interval);
    m_isRunning = true;
    for (const QPlcRealTimeSetting &setting : m_cycle.realTimeSettings()) {
        if (!setting.granted)
            m_journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(), setting.toString());
    }
    m_gone.clear();
    m_rosters.forgetAbandoned();
    m_ownSignals.statistics().start(&m_cycle, &m_registry, !m_settings.clock.isTimed());
    m_journal.watchOverruns(&m_cycle.cycleStatistics());
    m_journal.clearAll(QStringLiteral("over, a real-time phase has begun"));
    return true;
}

/// The end of the phase may be a part of what has happened.
void RealTimePhase::keepCycles(const QString &reason)
{
    if (m_isRunning || m_hasEnded)
        m_blackBox.keep(reason);
}

void RealTimePhase::renewRoster()
{
    m_cycle.setRoster(m_rosters.make());
}

void RealTimePhase::whenRecorded(std::function<void()> told)
{
    m_whenRecorded = std::move(told);
    m_waitsUntil = monotonicNow() + std::chrono::nanoseconds(LongestWaitForRecorder).count();
    m_recorderTimer.start();
    lookForRecorder();
}

void RealTimePhase::lookForRecorder()
{
    const std::int64_t now = monotonicNow();
    const QString recorder = m_settings.clock.isTimed() ? QString() : m_remoteRecorder.behind(now);
    if (!recorder.isEmpty() && now < m_waitsUntil)
        return;
    if (!recorder.isEmpty())
        m_journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("the recorder %1 has not recorded the end of the phase within %2 s; if this "
                                      "master ends, the ring keeps it for `qtplc record FOLDER/` on this computer")
                           .arg(recorder)
                           .arg(LongestWaitForRecorder.count()));
    waitNoLonger();
}

bool RealTimePhase::waitNoLonger()
{
    m_recorderTimer.stop();
    const std::function<void()> told = std::exchange(m_whenRecorded, nullptr);
    if (told)
        told();
    return bool(told);
}

void RealTimePhase::end()
{
    if (!m_isRunning)
        return;
    m_isRunning = false;
    m_cycle.stop();
    m_ownSignals.statistics().stop();
    m_journal.watchOverruns(nullptr);
    m_hasEnded = true;
}

bool RealTimePhase::takeEnd()
{
    if (m_hasEnded)
        m_cycle.setRoster({});
    return std::exchange(m_hasEnded, false);
}

/// \param node  null: its cyclic channel was not there yet
void RealTimePhase::nodeLeft(const NodeSession *node, const NodeSlot &slot)
{
    m_gone.add({slot.id, slot.name, slot.listener});
    const bool wasRunning = node && node->stage() == NodeSession::Running;
    const bool wasJoining = m_isRunning && node && node->stage() >= NodeSession::OutputsGiven;
    if (!wasRunning && wasJoining)
        m_rosters.abandon(slot);
    if (wasRunning || wasJoining)
        renewRoster();
}

QString RealTimePhase::nodeName(quint16 id) const
{
    const std::shared_ptr<NodeSlot> slot = m_registry.find(id);
    if (slot)
        return slot->name;
    const GoneNodes::Node *gone = m_gone.find(id);
    return gone ? gone->name : QStringLiteral("number %1").arg(id);
}

bool RealTimePhase::wasListener(quint16 id) const
{
    const GoneNodes::Node *gone = m_gone.find(id);
    return gone && gone->isListener;
}

QString RealTimePhase::cycleText() const
{
    return m_isRunning ? QStringLiteral(" in cycle %1").arg(m_cycle.cycle()) : QString();
}

}  // namespace qplc
