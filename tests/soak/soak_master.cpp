// SPDX-License-Identifier: Apache-2.0
// soak_master: the master of the soak's plant, with a history of every cycle, of what happens to its nodes, and of its counters.
#include "NodeOptions.h"

#include <QtCore/QMetaEnum>
#include <QtCore/QTimer>

#include <atomic>
#include <cstdio>
#include <malloc.h>

namespace soak {

namespace {

/// Records each cycle on the cycle thread itself.
class CycleRecorder : public QPlcCompactSlaveNode
{
public:
    explicit CycleRecorder(HistoryWriter &history)
        : QPlcCompactSlaveNode(QStringLiteral("Recorder"), SilentZeroOrderHold)
        , m_history(history)
    {
    }

    /// That runs, or comes next; 0: none.
    quint64 phase() const { return m_phase; }

private:
    void reset() override { ++m_phase; }
    void step(const QPlcCycle &cycle) override
    {
        m_history.append(Record::Cycle, Record::Nobody, {m_phase}, cycle.number());
    }
    HistoryWriter &m_history;
    std::atomic<quint64> m_phase{0};
    QPlcInput<quint32> m_counter{this, "n0.counter"};
};

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

class Master : public QPlcMasterNode
{
public:
    Master(const NodeOptions &options, HistoryWriter &history)
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
        connect(&m_heapTimer, &QTimer::timeout, this, [this] { weigh(); });
        m_heapTimer.start(1000);
    }
    ~Master() override { removeLocalNode(&m_recorder); }
    bool start(std::chrono::microseconds period, quint16 port)
    {
        setProfile(QPlcProfile::Plant);
        setGapLimit(LongestGap);
        return setSignalTable(table(m_options.shape)) && setInterval(period) && addLocalNode(&m_recorder)
            && startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port));
    }

private:
    static constexpr std::chrono::milliseconds LongestGap{
        200};  // less than a master is stopped for, more than a busy machine takes

    void recordNodes()
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
        connect(this, &QPlcMasterNode::realTimeViolated, this, [=](const QString &name, quint64 cycle) {
            m_history.append(Record::Late, nodeNumber(name), {}, cycle);
        });
        connect(this, &QPlcMasterNode::errorOccurred, this,
                [this](Error error) { m_history.append(Record::Error, Record::Nobody, {quint64(error)}, cycle()); });
    }
    void count()
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

    /// What the heap has lent, for a leak that does not show in resident memory as long as the heap has a reserve.
    void weigh()
    {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
        const struct mallinfo2 heap = ::mallinfo2();
        m_history.append(Record::Heap, Record::Nobody,
                         {heap.uordblks + heap.hblkhd, heap.arena + heap.hblkhd, heap.keepcost}, cycle());
#endif
    }

    const NodeOptions m_options;
    HistoryWriter &m_history;
    CycleRecorder m_recorder;
    QTimer m_timer;
    QTimer m_heapTimer;
    quint64 m_phase = 0;  // whose counters there are; 0: none
};

}  // namespace

}  // namespace soak

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    soak::addShapeOptions(application);
    application.addOption(
        {QStringLiteral("period-us"), QStringLiteral("Period [us]."), QStringLiteral("US"), QStringLiteral("10000")});
    application.addOption({QStringLiteral("port"), QStringLiteral("Port to listen on. 0: a free one."),
                           QStringLiteral("PORT"), QStringLiteral("0")});
    application.addRealTimeOptions();
    application.addSecurityOptions(QPlcSecurity::MasterSide);
    soak::NodeOptions options;
    soak::HistoryWriter history;
    QPlcRealTimeOptions realTime;
    QPlcSecurity security;
    qint64 period = 0, port = 0;
    if (!application.parseOptions() || !application.integer(QStringLiteral("period-us"), 100, 1'000'000, &period)
        || !application.integer(QStringLiteral("port"), 0, 65535, &port) || !application.readRealTimeOptions(&realTime)
        || !application.readSecurityOptions(QPlcSecurity::MasterSide, &security)
        || !soak::readShapeOptions(application, &options, &history))
        return application.exitCode();
    history.append(soak::Record::Born, soak::Record::Nobody, {quint64(QCoreApplication::applicationPid())});
    soak::Master master(options, history);
    master.setRealTimeOptions(realTime);
    master.setSecurity(security);
    if (!master.start(std::chrono::microseconds(period), quint16(port)))
        return application.usageError(master.errorString());
    std::printf("port %d\n", int(master.serverPort()));
    std::fflush(stdout);
    application.quitOnSignals();
    const int code = QCoreApplication::exec();
    master.stop();
    master.stopServer();
    return code;
}
