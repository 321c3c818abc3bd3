// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

#include <optional>

// The face of a node that works with lists, those whose outputs come from outside, and those that
// keep every cycle for a slower reader.
class tst_SignalListNodes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent(testTable()); }
    void cleanup() { QPlcSignalIndexTable::setCurrent({}); }
    void listsCarryValuesInAndOut_data();
    void listsCarryValuesInAndOut();
    void eachValueOfAListGoesToItsSignal();
    void indicesOfAnotherTableAreRefused();
    void unknownNamesAreRefusedInOneMessage();
    void outputsOfAnIoNodeCanBeSetAtAnyTime();
    void anIoNodeBeginsWithItsInitialOutputs();
    void aBurstOfOutputsEndsWithTheNewest();
    void invalidOutputsAreReported();
    void newIndicesRegisterAgain();
    void aLocalIoNodeKeepsItsPlace();
    void aBufferNodeKeepsEveryCycleInOrder_data();
    void aBufferNodeKeepsEveryCycleInOrder();
    void aFullBufferLosesTheNewestAndCounts();
    void rateLimiterDeliversBatches();
    void frameRateLimitIsClampedToItsRange();
};

namespace {

class Doubler : public QPlcSlaveNode
{
public:
    Doubler()
        : QPlcSlaveNode("Doubler", ErrorZeroOrderHold)
    {
    }
    QVector<quint64> cycles;
    QPlcSignalList initial;
    bool wasStopped = false;
    std::optional<int> givenCount;

protected:
    QPlcSignalIndexList declareInputSignals() override
    {
        QPlcSignalIndexList list;
        m_setpoint = list.insert("setpoint");
        m_vector = list.insert("vector");
        return list;
    }
    QPlcSignalIndexList declareOutputSignals() override
    {
        QPlcSignalIndexList list;
        m_echo = list.insert("echo");
        m_count = list.insert("count");
        return list;
    }
    QPlcSignalList initialOutputSignals() override
    {
        QPlcSignalList list;
        list.insert(m_echo, -5);  // "count" keeps the initial value of the table
        return list;
    }
    void initialize(const QPlcSignalList &values) override { initial = values; }
    QPlcSignalList realTimeout(const QPlcSignalList &inputs) override
    {
        cycles << cycle().number();
        QPlcSignalList outputs;
        outputs.insert(m_echo, 2.0 * inputs.value(m_setpoint).toReal() + inputs.value(m_vector).toReal(2));
        if (givenCount)
            outputs.insert(m_count, *givenCount);
        return outputs;
    }
    void stopped() override { wasStopped = true; }

private:
    QPlcSignalIndex m_setpoint = 0;
    QPlcSignalIndex m_vector = 0;
    QPlcSignalIndex m_echo = 0;
    QPlcSignalIndex m_count = 0;
};

}  // namespace

void tst_SignalListNodes::listsCarryValuesInAndOut_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
    QTest::newRow("in process") << "local";
}

void tst_SignalListNodes::listsCarryValuesInAndOut()
{
    QFETCH(QString, kind);
    TestMaster master;
    Doubler node;
    QVERIFY(master.listen());
    QVERIFY(master.admit(node, kind));
    master.setCycleLimit(5);
    QSignalSpy initialized(&master, &QPlcMasterNode::statesInitialized);
    QVERIFY(master.initializeAllStates());
    QTRY_COMPARE(initialized.size(), 1);
    QCOMPARE(master.signalValue("echo").toReal(), -5.0);
    QCOMPARE(node.initial.value("setpoint").toReal(), 0.0);
    QVERIFY(master.setSignalValue("setpoint", 4.0));
    QVERIFY(master.setSignalValue("vector", QPlcValue(std::array<double, 3>{0, 0, 0.5})));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("echo").toReal(), 8.5);
    QCOMPARE(master.signalValue("count").toInt(), 7);
    QTRY_VERIFY(node.wasStopped);
    QCOMPARE(node.cycles, (QVector<quint64>{0, 1, 2, 3, 4}));
    node.disconnectFromMaster();
}

void tst_SignalListNodes::eachValueOfAListGoesToItsSignal()
{
    TestMaster master;
    Doubler node;
    node.givenCount = 42;
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.setSignalValue("setpoint", 4.0));
    master.setCycleLimit(2);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.signalValue("echo").toReal(), 8.0);
    QCOMPARE(master.signalValue("count").toInt(), 42);
}

void tst_SignalListNodes::indicesOfAnotherTableAreRefused()
{
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni(
        "[vector]\ntype=Real64Triple\n[setpoint]\ntype=Real64\n[echo]\ntype=Real64\n[count]\ntype=Int32\n"));
    TestMaster master;
    Doubler node;
    QVERIFY(!master.addLocalNode(&node));  // else it would read and write other signals than it means
    QVERIFY2(master.errorString().contains("table of the process"), qPrintable(master.errorString()));
}

void tst_SignalListNodes::unknownNamesAreRefusedInOneMessage()
{
    QPlcSignalIndexTable::setCurrent(
        QPlcSignalTable::fromIni("[vector]\ntype=Real64Triple\n[setpiont]\ntype=Real64\n"));
    TestMaster master(QPlcClock::lockstep(), QPlcSignalIndexTable::current());
    Doubler node;
    QVERIFY(!master.addLocalNode(&node));
    for (const char *name : {"'setpoint'", "'setpiont'", "'echo'", "'count'"})
        QVERIFY2(master.errorString().contains(name), qPrintable(master.errorString()));
}

void tst_SignalListNodes::outputsOfAnIoNodeCanBeSetAtAnyTime()
{
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QPlcIOSlaveNode node("Operator");
    node.setInputSignalIndices(indices({"count"}));
    node.setOutputSignalIndices(indices({"setpoint", "echo"}));
    node.setOutputSignals(valueOf("setpoint", 3.0));  // before it connects
    QVERIFY(node.inputSignals().isEmpty());
    QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol("udp")), qPrintable(node.errorString()));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("setpoint").toReal(), 3.0);
    node.setOutputSignals(valueOf("echo", 0.25));  // in the middle of the phase; the setpoint stays
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.25);
    QCOMPARE(master.signalValue("setpoint").toReal(), 3.0);
    QTRY_VERIFY(node.inputSignals().value("count").toInt() > 0);
    master.stop();
    QCOMPARE(node.inputSignalIndices(), indices({"count"}));
    QCOMPARE(node.outputSignalIndices().size(), 2);
}

void tst_SignalListNodes::anIoNodeBeginsWithItsInitialOutputs()
{
    TestMaster master;
    QPlcIOSlaveNode node("Operator");
    node.setOutputSignalIndices(indices({"setpoint", "count"}));
    node.setInitialOutputSignals(valueOf("setpoint", -2.0));
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(master.signalValue("setpoint").toReal(), -2.0);
    QCOMPARE(master.signalValue("count").toInt(), 7);  // of the table
}

void tst_SignalListNodes::aBurstOfOutputsEndsWithTheNewest()
{
    TestMaster master;
    QVERIFY(master.listen());
    QPlcIOSlaveNode node("Operator");
    node.setOutputSignalIndices(indices({"echo"}));
    QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    QSignalSpy initialized(&master, &QPlcMasterNode::statesInitialized);
    QVERIFY(master.initializeAllStates());
    QTRY_COMPARE(initialized.size(), 1);
    for (int i = 1; i <= 1000; ++i)  // far more than the ring to the cycle thread holds, while nobody takes them
        node.setOutputSignals(valueOf("echo", double(i)));
    QVERIFY(master.startRealTime());
    QTRY_COMPARE(master.signalValue("echo").toReal(), 1000.0);
    master.stop();
}

void tst_SignalListNodes::invalidOutputsAreReported()
{
    TestMaster master;
    QPlcIOSlaveNode node("Operator");
    node.setOutputSignalIndices(indices({"echo"}));
    QVERIFY(master.addLocalNode(&node));
    LogCapture log;
    node.setOutputSignals(valueOf("sum", 1.0));
    QCOMPARE(log.matching("does not write").size(), 1);
    node.setOutputSignals(valueOf("echo", "fast"));
    QCOMPARE(log.matching("fast does not fit").size(), 1);
    QVERIFY(master.initializeAllStates());
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
}

void tst_SignalListNodes::newIndicesRegisterAgain()
{
    TestMaster master;
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    QPlcIOBufferSlaveNode node("Viewer");
    QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QSignalSpy again(&node, &QPlcSlaveNode::connectedToMaster);
    node.setInputSignalIndices(indices({"count", "sum"}));
    QTRY_COMPARE(again.size(), 1);
    QTRY_COMPARE(master.nodes().value(0).inputs, 2);
    QTRY_VERIFY(!node.inputSignals().isEmpty());
    QCOMPARE(node.inputSignals().value("count").toInt(), 7);
    master.stop();
}

void tst_SignalListNodes::aLocalIoNodeKeepsItsPlace()
{
    TestMaster master;
    QPlcIOSlaveNode node("Operator");
    QVERIFY(master.addLocalNode(&node));
    QVERIFY(master.startRealTime());
    LogCapture log;
    node.setInputSignalIndices(indices({"count"}));
    QCOMPARE(log.matching("process of its master").size(), 1);
    QCOMPARE(node.state(), QPlcSlaveNode::RealTime);
    QVERIFY(master.waitForCycles(10));
    node.disconnectFromMaster();  // as every node does
    QCOMPARE(node.state(), QPlcSlaveNode::Disconnected);
    QVERIFY(master.nodes().isEmpty());
}

void tst_SignalListNodes::aBufferNodeKeepsEveryCycleInOrder_data()
{
    QTest::addColumn<bool>("local");
    QTest::newRow("in process") << true;
    QTest::newRow("over tcp") << false;
}

void tst_SignalListNodes::aBufferNodeKeepsEveryCycleInOrder()
{
    QFETCH(bool, local);
    TestMaster master;
    QVERIFY(master.listen());
    CounterNode counter;
    QPlcIOBufferSlaveNode viewer("Viewer");
    QVERIFY(viewer.isListener());
    viewer.setInputSignalIndices(indices({"count"}));
    QVERIFY(master.addLocalNode(&counter));
    if (local)
        QVERIFY(master.addLocalNode(&viewer));
    else
        QVERIFY(viewer.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    master.setCycleLimit(local ? 500 : 0);
    QVERIFY(viewer.takeInputSignals().isEmpty());
    QVERIFY(master.startRealTime());
    QList<QPlcSignalList> taken;
    QVector<quint64> cycles;
    QTRY_VERIFY((taken += viewer.takeInputSignals(&cycles), taken.size() >= (local ? 500 : 100)));
    if (!local)
        master.stop();
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY(!local || taken.size() == 500);
    for (int i = 0; i < taken.size(); ++i) {
        QCOMPARE(quint64(taken.at(i).value("count").toInt()), cycles.at(i));  // those of the cycle before
        QVERIFY(i == 0 || cycles.at(i) > cycles.at(i - 1));
    }
    QVERIFY(!local || viewer.lostCycles() == 0);
}

void tst_SignalListNodes::aFullBufferLosesTheNewestAndCounts()
{
    TestMaster master;
    QPlcIOBufferSlaveNode viewer("Viewer");
    viewer.setBufferSize(64);
    viewer.setInputSignalIndices(indices({"count"}));
    QVERIFY(master.addLocalNode(&viewer));
    master.setCycleLimit(100);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVector<quint64> cycles;
    QCOMPARE(viewer.takeInputSignals(&cycles).size(), 64);
    QCOMPARE(cycles.last(), quint64(63));
    QCOMPARE(viewer.lostCycles(), quint64(36));
}

void tst_SignalListNodes::rateLimiterDeliversBatches()
{
    TestMaster master;
    QPlcIOBufferSlaveNode viewer("Viewer");
    viewer.setInputSignalIndices(indices({"count"}));
    QVERIFY(master.addLocalNode(&viewer));
    QPlcFrameRateLimiter limiter(&viewer);
    limiter.setFrameRateLimit(100);
    QSignalSpy batches(&limiter, &QPlcFrameRateLimiter::realTimeout);
    QVERIFY(!batches.wait(50));  // nothing, so no empty batch
    master.setCycleLimit(300);
    QVERIFY(master.startRealTime());
    int sum = 0;
    QTRY_VERIFY((sum = 0,
                 std::for_each(batches.begin(), batches.end(),
                               [&](const QList<QVariant> &b) { sum += b.at(0).value<QList<QPlcSignalList>>().size(); }),
                 sum == 300));
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    for (const QList<QVariant> &batch : batches)
        QVERIFY(!batch.at(0).value<QList<QPlcSignalList>>().isEmpty());
}

void tst_SignalListNodes::frameRateLimitIsClampedToItsRange()
{
    auto *viewer = new QPlcIOBufferSlaveNode("Viewer");
    QPlcFrameRateLimiter limiter(viewer);
    QCOMPARE(limiter.frameRateLimit(), 50.0);
    limiter.setFrameRateLimit(0.0);
    QCOMPARE(limiter.frameRateLimit(), 1.0);
    limiter.setFrameRateLimit(1e9);
    QCOMPARE(limiter.frameRateLimit(), 1000.0);
    limiter.setFrameRateLimit(qQNaN());
    QCOMPARE(limiter.frameRateLimit(), 1.0);
    delete viewer;
    QTest::qWait(20);  // the limiter has nobody to ask any more
}

QTEST_GUILESS_MAIN(tst_SignalListNodes)
#include "tst_SignalListNodes.moc"
