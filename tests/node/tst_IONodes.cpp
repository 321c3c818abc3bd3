// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "NodeFixtures.h"

#include <QtCore/QThread>

#include <atomic>
#include <thread>

// Nodes whose outputs come from outside and whose inputs are read elsewhere: between phases, across
// threads, and when what they want changes.
class tst_IONodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent(testTable()); }
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void outputsSetBetweenPhasesBeginTheNextOne_data();
    void outputsSetBetweenPhasesBeginTheNextOne();
    void newOutputsReplaceAndReleaseTheOldOnes_data();
    void newOutputsReplaceAndReleaseTheOldOnes();
    void aRefusedChangeIsAnError();
    void inputsAreConsistentInAnyThread();
    void aNodeMayLiveInAThreadOfItsOwn_data();
    void aNodeMayLiveInAThreadOfItsOwn();
    void realTimedOutTellsThatThereAreNewInputs_data();
    void realTimedOutTellsThatThereAreNewInputs();
    void realTimedOutIsEmittedInTheThreadOfTheNode();
    void fullBufferInAnotherThreadDelaysNoCycle();
    void framesTellCyclePhaseAndPeriod();
    void aNodeMayReadAllSignalsOfAnyTable();
};

namespace {

/// Runs \a task in the thread of \a node, and waits for its end.
template<typename Task>
void inThreadOf(QPlcSlaveNode *node, Task task)
{
    QMetaObject::invokeMethod(node, task, Qt::BlockingQueuedConnection);
}

/// A viewer of "count" and "echo" in a thread of its own.
class ThreadedViewer
{
public:
    explicit ThreadedViewer(int bufferSize)
    {
        node->setListener(false);  // in lockstep it is waited for, so that it sees every cycle
        node->setBufferSize(bufferSize);
        node->setInputSignalIndices(indices({"count", "echo"}));
        node->moveToThread(&m_thread);
        QObject::connect(&m_thread, &QThread::finished, node, &QObject::deleteLater);
        m_thread.start();
    }
    ~ThreadedViewer()
    {
        inThreadOf(node, [this] { node->disconnectFromMaster(); });
        m_thread.quit();
        m_thread.wait();
    }
    bool connectTo(const QPlcUnderlyingProtocol &protocol)
    {
        inThreadOf(node, [&] { node->connectToMaster(protocol); });
        return waitUntil([this] { return state() == QPlcSlaveNode::Off; }, 5000);
    }
    QPlcSlaveNode::State state()
    {
        // The master of these tests lives in this thread and must go on meanwhile: never wait
        // without its event loop.
        const auto answer = std::make_shared<std::atomic<int>>(-1);
        QMetaObject::invokeMethod(
            node, [this, answer] { *answer = node->state(); }, Qt::QueuedConnection);
        (void)waitUntil([&] { return *answer >= 0; }, 5000);
        return QPlcSlaveNode::State(answer->load());
    }
    QPlcIOBufferSlaveNode *node = new QPlcIOBufferSlaveNode("Viewer");

private:
    QThread m_thread;
};

}  // namespace

void tst_IONodes::outputsSetBetweenPhasesBeginTheNextOne_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("in process") << "local";
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
}

void tst_IONodes::outputsSetBetweenPhasesBeginTheNextOne()
{
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    QPlcIOSlaveNode node("Operator");
    node.setOutputSignalIndices(indices({"setpoint"}));
    QVERIFY(master.admit(node, kind));
    for (double value : {1.0, 2.0, 3.0}) {
        node.setOutputSignals(valueOf("setpoint", value));  // no cycle runs
        const double before = master.signalValue("setpoint").toReal();
        QTest::qWait(1);
        QCOMPARE(master.signalValue("setpoint").toReal(), before);
        QSignalSpy initialized(&master, &QPlcMasterNode::statesInitialized);
        QVERIFY(master.startRealTime());
        QTRY_COMPARE(initialized.size(), 1);
        QCOMPARE(master.signalValue("setpoint").toReal(), value);
        QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
        QVERIFY(master.waitForCycles(3));
        QCOMPARE(master.signalValue("setpoint").toReal(), value);
        node.setOutputSignals(valueOf("setpoint", -value));
        QTRY_COMPARE(master.signalValue("setpoint").toReal(), -value);
        master.stop();
        QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
        QCOMPARE(master.signalValue("setpoint").toReal(), -value);  // the plant keeps its last values
    }
    node.disconnectFromMaster();
}

void tst_IONodes::newOutputsReplaceAndReleaseTheOldOnes_data()
{
    QTest::addColumn<bool>("running");
    QTest::newRow("off") << false;
    QTest::newRow("while cycles run") << true;
}

void tst_IONodes::newOutputsReplaceAndReleaseTheOldOnes()
{
    QFETCH(bool, running);
    TestMaster master;
    QVERIFY(master.listen());
    QPlcIOSlaveNode node("Operator");
    node.setOutputSignalIndices(indices({"setpoint"}));
    QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    if (running) {
        QVERIFY(master.startRealTime());
        QTRY_COMPARE(node.state(), QPlcSlaveNode::RealTime);
    }
    node.setOutputSignalIndices(indices({"echo", "sum"}));
    node.setOutputSignals(valueOf("sum", 4.0));  // on its way to the master already
    QTRY_COMPARE(master.writer("sum"), QString("Operator"));
    QCOMPARE(master.writer("setpoint"), QString());
    QTRY_COMPARE(node.state(), running ? QPlcSlaveNode::RealTime : QPlcSlaveNode::Off);
    QVERIFY(master.setSignalValue("setpoint", 5.0));
    if (!running)
        QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("sum").toReal(), 4.0);
    QTRY_COMPARE(master.signalValue("setpoint").toReal(), 5.0);
    QCOMPARE(master.nodes().size(), 1);
    master.stop();
    node.disconnectFromMaster();
}

void tst_IONodes::aRefusedChangeIsAnError()
{
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QPlcIOSlaveNode node("Operator");
    QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("udp")));
    node.setOutputSignalIndices(indices({"count"}));  // the counter writes it
    QTRY_COMPARE(node.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(node.errorString().contains("'count'") && node.errorString().contains("'Counter'"),
             qPrintable(node.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Rejected);
    QCOMPARE(master.writer("count"), QString("Counter"));
    node.setReceivesQuality(false);  // not registered: it may be set as before
    node.setOutputSignalIndices(indices({"setpoint"}));
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol("udp")), qPrintable(node.errorString()));
    node.disconnectFromMaster();
}

void tst_IONodes::inputsAreConsistentInAnyThread()
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    QPlcIOSlaveNode node("Operator");
    node.setInputSignalIndices(indices({"count", "echo"}));
    for (QPlcSlaveNode *local : std::initializer_list<QPlcSlaveNode *>{&counter, &echo, &node})
        QVERIFY2(master.addLocalNode(local), qPrintable(master.errorString()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(100));
    std::atomic<int> torn{0};
    std::thread reader([&] {
        const QPlcSignalIndex count = testTable().indexOf("count");
        const QPlcSignalIndex echoed = testTable().indexOf("echo");
        double newest = 0.0;
        for (int i = 0; i < 3000; ++i) {
            const QPlcSignalList inputs = node.inputSignals();
            const double value = inputs.value(count).toReal();
            torn += inputs.value(echoed).toReal() != value - 1.0 || value < newest;
            newest = value;
        }
    });
    reader.join();
    master.stop();
    QCOMPARE(torn.load(), 0);
}

void tst_IONodes::aNodeMayLiveInAThreadOfItsOwn_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
}

void tst_IONodes::aNodeMayLiveInAThreadOfItsOwn()
{
    constexpr int cycles = 1000;
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.addLocalNode(&echo));
    ThreadedViewer viewer(cycles);
    QVERIFY(viewer.connectTo(master.protocol(kind)));
    QPlcFrameRateLimiter limiter(viewer.node);
    limiter.setFrameRateLimit(500);
    QVector<int> counts;
    bool foreign = false;
    connect(&limiter, &QPlcFrameRateLimiter::realTimeout, this, [&](const QList<QPlcSignalList> &batch) {
        foreign = foreign || QThread::currentThread() != thread();
        for (const QPlcSignalList &inputs : batch)
            counts << inputs.value("count").toInt();
    });
    master.setCycleLimit(cycles);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(counts.size(), cycles);
    for (int i = 0; i < cycles; ++i)
        QCOMPARE(counts.at(i), i);  // of the cycle before, all of them, in order
    QVERIFY(!foreign);
    QCOMPARE(viewer.node->lostCycles(), quint64(0));
    QCOMPARE(viewer.node->counters().cycles, quint64(cycles));
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

void tst_IONodes::realTimedOutTellsThatThereAreNewInputs_data()
{
    QTest::addColumn<QString>("kind");
    for (const char *kind : {"local", "udp", "tcp"})
        QTest::newRow(kind) << kind;
}

/// As the thesis has it: the signal tells that the buffer holds something, and the buffer is
/// emptied then.
void tst_IONodes::realTimedOutTellsThatThereAreNewInputs()
{
    constexpr int cycles = 200;
    QFETCH(QString, kind);
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QPlcIOBufferSlaveNode viewer("Viewer");
    viewer.setListener(false);  // in lockstep it is waited for, so that it sees every cycle
    viewer.setInputSignalIndices(indices({"count"}));
    QVERIFY(master.admit(viewer, kind));
    QVector<int> counts;
    int told = 0;
    const auto take = [&] {
        ++told;
        const QList<QPlcSignalList> batch = viewer.returnAndClearInputSignalsBuffer();
        for (const QPlcSignalList &inputs : batch)
            counts << inputs.value("count").toInt();
    };
    connect(&viewer, &QPlcSlaveNode::realTimedOut, this, take);
    master.setCycleLimit(cycles);
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(counts.size(), cycles);
    for (int i = 0; i < cycles; ++i)
        QCOMPARE(counts.at(i), i);
    QVERIFY(told >= 1 && told <= cycles);
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    const int before = told;
    QTest::qWait(20);
    QCOMPARE(told, before);  // no cycles, no news
    QVERIFY(viewer.returnAndClearInputSignalsBuffer().isEmpty());
    viewer.disconnectFromMaster();
}

void tst_IONodes::realTimedOutIsEmittedInTheThreadOfTheNode()
{
    TestMaster master;
    QVERIFY(master.listen());
    ThreadedViewer viewer(1000);
    std::atomic<int> inItsThread{0}, elsewhere{0};
    connect(
        viewer.node, &QPlcSlaveNode::realTimedOut, viewer.node,
        [&] { ++(QThread::currentThread() == viewer.node->thread() ? inItsThread : elsewhere); }, Qt::DirectConnection);
    QVERIFY(viewer.connectTo(master.protocol("udp")));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(inItsThread > 2);
    QCOMPARE(elsewhere.load(), 0);
    master.stop();
}

void tst_IONodes::fullBufferInAnotherThreadDelaysNoCycle()
{
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    ThreadedViewer viewer(64);
    QVERIFY(viewer.connectTo(master.protocol("tcp")));
    master.setCycleLimit(500);  // and nobody takes what the viewer keeps
    QVERIFY(master.startRealTime());
    QVERIFY(waitUntil([&] { return master.statistics().cycles == 500; }));
    QTRY_COMPARE(viewer.node->lostCycles(), quint64(500 - 64));
    QVector<quint64> numbers;
    QCOMPARE(viewer.node->takeInputSignals(&numbers).size(), 64);
    for (int i = 0; i < 64; ++i)
        QCOMPARE(numbers.at(i), quint64(i));
    QVERIFY(viewer.node->takeInputSignals().isEmpty());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
}

void tst_IONodes::framesTellCyclePhaseAndPeriod()
{
    TestMaster master;
    QVERIFY(master.listen());
    QVERIFY(master.setInterval(0.25));
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    ThreadedViewer viewer(64);
    QVERIFY(viewer.connectTo(master.protocol("udp")));
    master.setCycleLimit(10);
    quint64 lastPhase = 0;
    for (int run = 0; run < 2; ++run) {
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        QVector<quint64> cycles;
        QVector<int> counts;
        QSet<quint64> phases;
        const int taken = viewer.node->takeFrames([&](const QPlcIOBufferSlaveNode::Frame &frame) {
            cycles << frame.cycle;
            counts << QPlcValue::fromBytes(QPlcSignalType::Int32, frame.inputs).toInt();
            phases << frame.phase;
            QVERIFY(frame.period == std::chrono::milliseconds(250));
        });
        QCOMPARE(taken, 10);
        QCOMPARE(cycles, (QVector<quint64>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
        QCOMPARE(counts.mid(1), (QVector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
        QCOMPARE(phases.size(), 1);
        QVERIFY(*phases.begin() > lastPhase);
        lastPhase = *phases.begin();
    }
    QCOMPARE(viewer.node->takeFrames([](const QPlcIOBufferSlaveNode::Frame &) { QFAIL("nothing is left"); }), 0);
}

void tst_IONodes::aNodeMayReadAllSignalsOfAnyTable()
{
    struct Recorder : QPlcIOBufferSlaveNode
    {
        Recorder()
            : QPlcIOBufferSlaveNode("Recorder")
        {
            readAllSignals();
        }
    } recorder;
    TestMaster master;
    QVERIFY(master.listen());
    recorder.setSignalTable(testTable());
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni("[other]\ntype = Real64\n"));
    QVERIFY(recorder.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(master.nodes().first().inputs, testTable().size());
    QCOMPARE(master.nodes().first().outputs, 0);
}

QTEST_GUILESS_MAIN(tst_IONodes)
#include "tst_IONodes.moc"
