// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

// Nodes that come and go while others run.
class tst_HotJoin : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void joinerGetsTheCurrentValues();
    void cyclesContinueWhileNodesJoinAndLeave_data();
    void cyclesContinueWhileNodesJoinAndLeave();
    void aJoinerThatFailsIsDropped_data();
    void aJoinerThatFailsIsDropped();
    void aJoinerThatAnswersNothingLosesItsName();
    void nodeRegisteredDuringTheStartJoinsAfterwards();
    void answersOutOfTurnFail();
    void aProcessThatStaysAliveKeepsItsState_data();
    void aProcessThatStaysAliveKeepsItsState();
};

void tst_HotJoin::joinerGetsTheCurrentValues()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    ScriptedNode joiner;
    QVERIFY(joiner.registerAt(master.serverPort()));
    QCOMPARE(joiner.registered.text("state"), QString("RealTime"));
    QCOMPARE(joiner.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    const QPlcMessage values = joiner.next();
    QCOMPARE(values.kind(), QPlcMessage::InitializeWithValues);
    QVERIFY(QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Int32), values.bytes("values")).toInt() >= 20);
    const QPlcMessage started = joiner.next();
    QCOMPARE(started.kind(), QPlcMessage::RealTimeStarted);
    QVERIFY(started.hex64("firstCycle") >= started.hex64("cycleZero") + 19);
    QVERIFY(joiner.waitForRequests(2));
    QVERIFY(joiner.requests.at(0).cycle >= started.hex64("firstCycle"));
    const int count
        = QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Int32), joiner.requests.at(0).payload).toInt();
    QVERIFY(quint64(count) <= joiner.requests.at(0).cycle - started.hex64("cycleZero"));
    master.stop();
}

void tst_HotJoin::cyclesContinueWhileNodesJoinAndLeave_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
}

void tst_HotJoin::cyclesContinueWhileNodesJoinAndLeave()
{
    QFETCH(QString, kind);
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    for (int round = 1; round <= 10; ++round) {
        EchoNode echo;
        quint64 firstCycle = 0;
        quint64 steps = 0;
        echo.onStep = [&](const QPlcCycle &cycle) { firstCycle = steps++ == 0 ? cycle.number() : firstCycle; };
        const quint64 before = master.statistics().cycles;
        QVERIFY2(echo.connectToMasterAndWaitForConnected(master.protocol(kind)), qPrintable(echo.errorString()));
        QTRY_VERIFY(echo.counters().cycles > 10);
        QCOMPARE(echo.counters().missed, quint64(0));
        echo.disconnectFromMaster();
        QVERIFY(firstCycle + 1 >= before);
        QTRY_COMPARE(lost.size(), round);
        QVERIFY(master.waitForCycles(master.statistics().cycles + 10));
    }
    master.stop();
    QCOMPARE(counter.resets, 1);
    QCOMPARE(counter.lastCycle + 1, master.statistics().cycles);
    QCOMPARE(master.signalValue("count").toUInt64(), master.statistics().cycles);
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
}

void tst_HotJoin::aJoinerThatFailsIsDropped_data()
{
    QTest::addColumn<QByteArray>("initialValues");
    QTest::newRow("wrong size") << QByteArray(7, '\0');
    QTest::newRow("not a number") << QPlcValue(qQNaN()).toBytes();
    QTest::newRow("it says so itself") << QByteArray();
}

void tst_HotJoin::aJoinerThatFailsIsDropped()
{
    QFETCH(QByteArray, initialValues);
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    ScriptedNode joiner;
    joiner.initialValues = initialValues;
    joiner.playsAlong = !initialValues.isEmpty();
    QVERIFY(joiner.registerAt(master.serverPort()));
    if (initialValues.isEmpty())
        joiner.send(QPlcMessage::NodeFault, {{"text", "no sensor"}});
    QTRY_COMPARE(lost.size(), 1);
    QTRY_VERIFY(!joiner.control.isConnected());
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    master.stop();
}

void tst_HotJoin::nodeRegisteredDuringTheStartJoinsAfterwards()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode slow("Slow");
    slow.playsAlong = false;
    slow.inputs.clear();
    slow.outputs.clear();
    slow.initialValues.clear();
    QVERIFY(slow.registerAt(master.serverPort()));
    slow.answerAll();
    QVERIFY(master.startRealTime());
    QCOMPARE(slow.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    ScriptedNode late("Late");
    late.answerAll();
    QVERIFY(late.registerAt(master.serverPort()));
    QCOMPARE(late.registered.text("state"), QString("Initializing"));
    QCOMPARE(late.next(50).kind(), QPlcMessage::Invalid);
    slow.playsAlong = true;
    slow.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", ""}});
    QVERIFY(late.waitForRequests(10));
    QVERIFY(slow.waitForRequests(10));
    master.stop();
}

void tst_HotJoin::aJoinerThatAnswersNothingLosesItsName()
{
    TestMaster master;
    QVERIFY(master.setInitializationTimeout(std::chrono::milliseconds(50)));
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    ScriptedNode silent;
    silent.playsAlong = false;
    QVERIFY(silent.registerAt(master.serverPort()));
    QCOMPARE(silent.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QTRY_VERIFY(master.nodes().isEmpty());
    ScriptedNode successor;
    successor.answerAll();
    QVERIFY(successor.registerAt(master.serverPort()));
    QVERIFY(successor.waitForRequests(10));
    master.stop();
}

void tst_HotJoin::answersOutOfTurnFail()
{
    TestMaster master;
    QVERIFY(master.listen());
    QVERIFY(master.startRealTime());
    ScriptedNode node;
    node.playsAlong = false;
    QVERIFY(node.registerAt(master.serverPort()));
    QCOMPARE(node.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    node.send(QPlcMessage::RealTimeReady);
    QCOMPARE(node.next().text("error"), QString("WrongState"));
    node.send(QPlcMessage::Initialized);
    QCOMPARE(node.next().text("error"), QString("WrongState"));
    QVERIFY(master.waitForCycles(master.statistics().cycles + 5));  // it has not joined: nobody waits for it
    master.stop();
    QCOMPARE(node.next().kind(), QPlcMessage::RealTimeStopped);
}

void tst_HotJoin::aProcessThatStaysAliveKeepsItsState_data()
{
    QTest::addColumn<int>("profile");
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("keeps");
    QTest::newRow("simulation, udp") << int(QPlcProfile::Simulation) << "udp" << true;
    QTest::newRow("simulation, tcp") << int(QPlcProfile::Simulation) << "tcp" << true;
    QTest::newRow("plant, udp") << int(QPlcProfile::Plant) << "udp" << false;
}

void tst_HotJoin::aProcessThatStaysAliveKeepsItsState()
{
    QFETCH(int, profile);
    QFETCH(QString, kind);
    QFETCH(bool, keeps);
    const LogCapture log;
    TestMaster master(QPlcClock::realTime());
    master.setProfile(QPlcProfile::Value(profile));
    master.setInterval(0.005);
    QVERIFY(master.listen());
    CounterNode counter;
    std::atomic<bool> isBack{false};
    std::atomic<int> smallest{1000000};
    counter.onStep = [&](const QPlcCycle &) {
        if (isBack)
            smallest = std::min(smallest.load(), counter.count());
    };
    QVERIFY(master.admit(counter, kind));
    QVERIFY(master.startRealTime());
    QTRY_VERIFY(master.signalValue("count").toInt() > 50);
    counter.disconnectFromMaster();
    QTRY_VERIFY(master.nodes().isEmpty());
    const int before = master.signalValue("count").toInt();
    QVERIFY(master.admit(counter, kind));
    QTRY_COMPARE(counter.state(), QPlcSlaveNode::RealTime);
    isBack = true;
    QTRY_VERIFY(smallest < 1000000);
    QCOMPARE(counter.resets, keeps ? 1 : 2);
    QCOMPARE(counter.initializations, keeps ? 1 : 2);
    if (keeps)
        QVERIFY2(smallest >= before, qPrintable(QString::number(smallest)));
    QCOMPARE(log.matching("node Counter goes on where it was").size(), keeps ? 1 : 0);
    master.stop();
}

QTEST_GUILESS_MAIN(tst_HotJoin)
#include "tst_HotJoin.moc"
