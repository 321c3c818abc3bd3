// SPDX-License-Identifier: Apache-2.0
#include "SoakMaster.h"

#include "SoakPlant.h"

#include <QtCore/QMetaEnum>

namespace soak {

namespace {

/// Less than a master is stopped for, more than a busy machine takes.
constexpr std::chrono::milliseconds LongestGap{200};

/// By its name: histories are read by who knows nothing of the numbers of the library.
Record::MasterState numberOf(QPlcMasterNode::State state)
{
    static const char *const names[]
        = {"Off", "Initializing", "Ready", "RealTime", "WaitingForLateSlaves", "SafeStop", "Fault"};
    const char *name = QMetaEnum::fromType<QPlcMasterNode::State>().valueToKey(state);
    int number = 0;
    while (number < Record::UnknownState && qstrcmp(names[number], name) != 0)
        ++number;
    return Record::MasterState(number);
}

}  // namespace

CycleRecorder::CycleRecorder(HistoryWriter &history)
    : QPlcCompactSlaveNode(QStringLiteral("Recorder"), SilentZeroOrderHold)
    , m_history(history)
{
}

void CycleRecorder::step(const QPlcCycle &cycle)
{
    m_history.append(Record::Cycle, Record::Nobody, {m_phase}, cycle.number());
}

SoakMaster::SoakMaster(const NodeOptions &options, HistoryWriter &history)
    : m_options(options)
    , m_history(history)
    , m_recorder(history)
{
    connect(this, &QPlcMasterNode::stateChanged, this, [this](State state) {
        m_history.append(Record::State, Record::Nobody, {quint64(numberOf(state))}, cycle());
    });
    // Not earlier: until then the counters are those of the phase before.
    connect(this, &QPlcMasterNode::realTimeHasStarted, this, [this] { m_phase = m_recorder.phase(); });
    connect(this, &QPlcMasterNode::realTimeHasStopped, this, [this] { count(); });
    recordNodes();
    connect(&m_timer, &QTimer::timeout, this, [this] { count(); });
    m_timer.start(options.shape.nodes > 100 ? 1000 : 100);  // each look at a crowd is work
}

SoakMaster::~SoakMaster()
{
    removeLocalNode(&m_recorder);
}

bool SoakMaster::start(std::chrono::microseconds period, const QPlcUnderlyingProtocol &place)
{
    setProfile(QPlcProfile::Plant);
    setGapLimit(LongestGap);
    return setSignalTable(table(m_options.shape)) && setInterval(period) && addLocalNode(&m_recorder)
        && startServer(place);
}

void SoakMaster::recordNodes()
{
    const auto record
        = [this](Record::Kind kind, const QString &name) { m_history.append(kind, nodeNumber(name), {}, cycle()); };
    connect(this, &QPlcMasterNode::nodeRegistered, this,
            [=](const QString &name) { record(Record::Registered, name); });
    connect(this, &QPlcMasterNode::nodeLost, this, [=](const QString &name) {
        if (nodeNumber(name) >= 0)
            record(Record::Lost, name);
    });
    connect(this, &QPlcMasterNode::nodeRefused, this, [=](const QString &name) { record(Record::Refused, name); });
    connect(this, &QPlcMasterNode::realTimeViolated, this,
            [=](const QString &name, quint64 cycle) { m_history.append(Record::Late, nodeNumber(name), {}, cycle); });
    connect(this, &QPlcMasterNode::errorOccurred, this,
            [this](Error error) { m_history.append(Record::Error, Record::Nobody, {quint64(error)}, cycle()); });
}

void SoakMaster::count()
{
    if (m_phase == 0)
        return;
    const QPlcCycleStatistics all = cycleStatistics();
    const QPlcMasterStatistics sinceStart = statistics();
    m_history.append(Record::Counters, Record::Nobody,
                     {m_phase, all.cycles, all.skippedCycles, all.strangers, all.lateAnswers, all.overruns,
                      all.incompleteCycles, sinceStart.failedHandshakes, sinceStart.deniedMessages},
                     cycle());
    for (const QPlcNodeStatistics &node : all.nodes) {
        if (nodeNumber(node.name) >= 0)
            m_history.append(Record::NodeCounters, nodeNumber(node.name),
                             {m_phase, node.answers, node.late, node.lost, node.duplicated, node.reordered,
                              node.rejected, node.resent},
                             cycle());
    }
}

}  // namespace soak
