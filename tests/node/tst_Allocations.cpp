// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "ThreadCosts.h"
#include "transport/CyclicHub.h"
#include "transport/StreamTransport.h"
#include "transport/UdpTransport.h"

#include <mutex>
#include <thread>

// A cycle allocates nothing and locks nothing, whatever the ports.
class tst_Allocations : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void localCyclesAllocateNothing();
    void stepsAllocateNothing();
    void networkCyclesAllocateNothing_data();
    void networkCyclesAllocateNothing();
    void leasesDuringCyclesAllocateNothing();
    void stagesAndTwoPhaseNodesAllocateNothing_data();
    void stagesAndTwoPhaseNodesAllocateNothing();
    void buffersAndIoNodesAllocateNothing();
    void peersComeAndGo();
};

namespace {

QPlcSignalTable everyType()
{
    return QPlcSignalTable::fromIni(R"(
[real]
type = Real64
[single]
type = Real32
[integer]
type = Int32
[truth]
type = Bool
[triple]
type = RealTriple
[time]
type = DateTime
[realOut]
type = Real64
[singleOut]
type = Real32
[wideOut]
type = Int64
[truthOut]
type = Bool
[tripleOut]
type = Real64Triple
[compactOut]
type = Real64Triple
[workload]
type = Real64
)");
}

/// Ports of every kind. The first step tells the counter that this is a cycle thread.
class Everything : public QPlcCompactSlaveNode
{
public:
    Everything()
        : QPlcCompactSlaveNode("Everything")
    {
        activateWorkloadMeasurement("workload");
    }

private:
    QPlcInput<double> m_real{this, "real"};
    QPlcInput<double> m_single{this, "single"};
    QPlcInput<qint64> m_integer{this, "integer"};
    QPlcInput<bool> m_truth{this, "truth"};
    QPlcInput<std::array<double, 3>> m_triple{this, "triple"};
    QPlcInput<qint64> m_time{this, "time"};
    QPlcOutput<double> m_realOut{this, "realOut"};
    QPlcOutput<double> m_singleOut{this, "singleOut"};
    QPlcOutput<int> m_wideOut{this, "wideOut"};
    QPlcOutput<bool> m_truthOut{this, "truthOut"};
    QPlcOutput<std::array<double, 3>> m_tripleOut{this, "tripleOut"};
    QPlcCompactSignal m_compactOut = QPlcCompactSignal("compactOut", QPlcCompactSignal::Output, this);

    void step(const QPlcCycle &cycle) override
    {
        ThreadCosts::watchThisThread();
        m_realOut = m_real + cycle.dt();
        m_singleOut = m_single + m_triple.value()[1];
        m_wideOut = int(m_integer) + 1;
        m_truthOut = !m_truth;
        m_tripleOut = std::array<double, 3>{1.0, double(m_time), m_realOut};
        m_compactOut = m_tripleOut.value();
    }
};

/// Runs a phase, in which \a cycles cycles between its begin and its end spend nothing.
void checkCosts(TestMaster &master, quint64 cycles)
{
    constexpr quint64 begin = 100;
    constexpr quint64 end = 50;
    master.setCycleLimit(begin + cycles + end);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(begin));
    const ThreadCosts before = ThreadCosts::ofWatchedThreads();
    QVERIFY(waitUntil([&] { return master.statistics().cycles >= begin + cycles; }, 50000));
    const ThreadCosts spent = ThreadCosts::ofWatchedThreads() - before;
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, begin + cycles + end);
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
}

}  // namespace

void tst_Allocations::initTestCase()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer owns malloc", "");
    // The counter counts: a test that sees nothing would prove nothing.
    std::thread([] {
        ThreadCosts::watchThisThread();
        std::free(std::malloc(3));
        delete new QObject;
        std::mutex mutex;
        const std::lock_guard<std::mutex> lock(mutex);
    }).join();
    const ThreadCosts costs = ThreadCosts::ofWatchedThreads();
    QVERIFY(costs.allocations >= 3);
    QVERIFY(costs.locks >= 1);
}

void tst_Allocations::localCyclesAllocateNothing()
{
    TestMaster master(QPlcClock::lockstep(), everyType());
    QVERIFY(master.setTimeSignal("time"));
    Everything node;
    QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
    checkCosts(master, 1'000'000);
}

/// On the thread that turns the clock.
void tst_Allocations::stepsAllocateNothing()
{
    TestMaster master(QPlcClock::external(), everyType());
    QVERIFY(master.setTimeSignal("time"));
    Everything node;
    QVERIFY2(master.addLocalNode(&node), qPrintable(master.errorString()));
    QVERIFY(master.startRealTime());
    const auto turn = [&master](int cycles) {
        for (int i = 0; i < cycles; ++i) {
            if (master.step() != QPlcMasterNode::StepResult::Complete)
                return false;
        }
        return true;
    };
    bool isComplete = false;
    ThreadCosts spent;
    std::thread([&] {
        isComplete = turn(100);  // the first step tells the counter that this is the thread
        const ThreadCosts before = ThreadCosts::ofWatchedThreads();
        isComplete = isComplete && turn(100'000);
        spent = ThreadCosts::ofWatchedThreads() - before;
    }).join();
    QVERIFY(isComplete);
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
    master.stop();
}

void tst_Allocations::networkCyclesAllocateNothing_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
}

void tst_Allocations::networkCyclesAllocateNothing()
{
    QFETCH(QString, kind);
    class Marker : public QPlcCompactSlaveNode  // marks the cycle thread of the master
    {
    public:
        Marker()
            : QPlcCompactSlaveNode("Marker")
        {
        }
        void step(const QPlcCycle &) override { ThreadCosts::watchThisThread(); }
    } marker;
    TestMaster master(QPlcClock::lockstep(), everyType());
    QVERIFY(master.setTimeSignal("time"));
    QVERIFY(master.addLocalNode(&marker));
    QVERIFY(master.listen());
    Everything node;
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol(kind)), qPrintable(node.errorString()));
    checkCosts(master, 20'000);
    node.disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_Allocations::leasesDuringCyclesAllocateNothing()
{
    TestMaster master(QPlcClock::realTime(), everyType());
    Everything node;
    ScriptedTool anna("Anna");
    QVERIFY(master.setInterval(0.001));
    QVERIFY(master.listen());
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(anna.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    QVERIFY(anna.waitForMessage(QPlcMessage::StatesInitialized));
    anna.forgetMessages();
    const ThreadCosts before = ThreadCosts::ofWatchedThreads();
    for (int i = 0; i < 50; ++i) {
        const QJsonObject values{{"realOut", "-1"}, {"tripleOut", "1, 2, 3"}};
        QCOMPARE(anna.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"realOut", "tripleOut"}}, {"values", values}})
                     .kind(),
                 QPlcMessage::Done);
        QTRY_COMPARE(master.signalValue("realOut").toReal(), -1.0);
        QCOMPARE(anna.ask(QPlcMessage::ReleaseLease).kind(), QPlcMessage::Done);
        QTRY_VERIFY(master.signalValue("realOut").toReal() >= 0.0);
    }
    const ThreadCosts spent = ThreadCosts::ofWatchedThreads() - before;
    master.stop();
    QCOMPARE(spent.allocations, std::uint64_t(0));
    QCOMPARE(spent.locks, std::uint64_t(0));
}

void tst_Allocations::stagesAndTwoPhaseNodesAllocateNothing_data()
{
    networkCyclesAllocateNothing_data();
    QTest::newRow("inprocess") << "inprocess";
}

void tst_Allocations::stagesAndTwoPhaseNodesAllocateNothing()
{
    QFETCH(QString, kind);
    class Model : public QPlcCompactSlaveNode
    {
    public:
        Model()
            : QPlcCompactSlaveNode("Model")
        {
            setTwoPhase(true);
            setSameCycle(true);
        }
        void outputs() override { m_real = m_state; }
        void update(const QPlcCycle &) override
        {
            ThreadCosts::watchThisThread();
            m_state = 0.5 * m_in;
        }
        double m_state = 1.0;
        QPlcInput<double> m_in{this, "realOut"};
        QPlcOutput<double> m_real{this, "real"};
    } model;
    TestMaster master(QPlcClock::lockstep(), everyType());
    QVERIFY(master.listen());
    Everything node;
    node.setSameCycle(true);
    QVERIFY(master.addLocalNode(&model));
    QVERIFY(kind == QLatin1String("inprocess") ? master.addLocalNode(&node)
                                               : node.connectToMasterAndWaitForConnected(master.protocol(kind)));
    QCOMPARE(master.schedule().stages.size(), 3);
    checkCosts(master, 20'000);
    node.disconnectFromMaster();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_Allocations::buffersAndIoNodesAllocateNothing()
{
    QPlcSignalIndexTable::setCurrent(everyType());
    TestMaster master(QPlcClock::lockstep(), everyType());
    QPlcIOBufferSlaveNode viewer("Viewer");
    QPlcSignalIndexList inputs;
    inputs.insert("real");
    inputs.insert("triple");
    QPlcSignalIndexList outputs;
    outputs.insert("single");
    viewer.setInputSignalIndices(inputs);
    viewer.setOutputSignalIndices(outputs);
    Everything node;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.addLocalNode(&viewer));
    checkCosts(master, 10'000);
    QPlcSignalIndexTable::setCurrent({});
}

/// Nodes join and leave between two cycles, on the thread of the cycles.
void tst_Allocations::peersComeAndGo()
{
    constexpr int count = 100;
    const qplc::SocketAddress address(QHostAddress(QHostAddress::LocalHost), 1);
    qplc::CyclicHub hub;
    std::vector<std::unique_ptr<qplc::HubPeer>> peers;
    for (int i = 0; i < count; ++i) {
        peers.push_back(hub.find<qplc::UdpTransport>()->peer(address));
        peers.push_back(qplc::StreamTransport::peer(-1, qplc::FrameCutter(), 1000));
    }
    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (const auto &peer : peers)
        hub.attach(peer.get());
    for (const auto &peer : peers)
        hub.detach(peer.get());
    QCOMPARE((ThreadCosts::ofThisThread() - before).allocations, std::uint64_t(0));
}

QTEST_GUILESS_MAIN(tst_Allocations)
#include "tst_Allocations.moc"
