// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

// Initialization and start wait for no listener: it goes through both at its own pace, and joins
// when it has come so far.
class tst_ListenerSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void silentListenerDelaysNoSequence();
    void aPunctualListenerIsInitializedWithTheOutputsOfTheOthers();
    void listenerCatchesUpWithTheMaster();
    void aLateListenerJoinsTheRunningPlant();
    void earlyReadyListenerReceivesTheStart();
    void answersToAnEarlierSequenceAreDropped();
    void listenerOutputsAreUsedOnArrival();
    void listenerMayLeaveDuringASequence();
    void listenerFaultsDoNotStopThePlant_data();
    void listenerFaultsDoNotStopThePlant();
};

namespace {

class Listener : public ScriptedNode
{
public:
    explicit Listener(bool hasOutputs = false)
        : ScriptedNode(QStringLiteral("Listener"))
    {
        playsAlong = false;
        if (hasOutputs)
            listener = true;
        else
            onlyListen();
    }
    void giveOutputs()
    {
        send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(initialValues)}});
    }
};

int countIn(const QPlcMessage &message)
{
    return QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Int32), message.bytes("values")).toInt();
}

}  // namespace

void tst_ListenerSequence::silentListenerDelaysNoSequence()
{
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    Listener listener;
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(master.state(), QPlcMasterNode::Ready);
    for (int phase = 0; phase < 3; ++phase) {
        QVERIFY(master.startRealTime());
        QCOMPARE(master.state(), QPlcMasterNode::RealTime);
        QVERIFY(master.waitForCycles(10));
        master.stop();
    }
    QCOMPARE(listener.requests.size(), 0);
    QCOMPARE(master.nodes().size(), 2);
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
}

void tst_ListenerSequence::aPunctualListenerIsInitializedWithTheOutputsOfTheOthers()
{
    TestMaster master;
    QVERIFY(master.listen());
    Listener listener;
    ScriptedNode slow("Slow");
    slow.playsAlong = false;
    slow.inputs.clear();
    slow.outputs = QStringList{"count"};
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(slow.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(listener.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    listener.giveOutputs();
    QCOMPARE(listener.next(50).kind(), QPlcMessage::Invalid);  // the values are not there yet
    slow.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(QPlcValue(42).toBytes())}});
    const QPlcMessage values = listener.next();
    QCOMPARE(values.kind(), QPlcMessage::InitializeWithValues);
    QCOMPARE(countIn(values), 42);
    listener.send(QPlcMessage::Initialized);
    slow.send(QPlcMessage::Initialized);
    QCOMPARE(listener.next().kind(), QPlcMessage::StatesInitialized);
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
}

void tst_ListenerSequence::listenerCatchesUpWithTheMaster()
{
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    Listener listener;
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(listener.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(listener.next().kind(), QPlcMessage::StatesInitialized);
    listener.giveOutputs();
    QCOMPARE(listener.next().kind(), QPlcMessage::InitializeWithValues);
    listener.send(QPlcMessage::Initialized);
    QCOMPARE(listener.next(50).kind(), QPlcMessage::Invalid);
    QVERIFY(master.startRealTime());
    const QPlcMessage started = listener.next();
    QCOMPARE(started.kind(), QPlcMessage::RealTimeStarted);
    QCOMPARE(started.hex64("firstCycle"), started.hex64("cycleZero"));
    QCOMPARE(counter.resets, 1);
    master.stop();
    QCOMPARE(listener.next().kind(), QPlcMessage::RealTimeStopped);
}

void tst_ListenerSequence::aLateListenerJoinsTheRunningPlant()
{
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    Listener listener;
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForCycles(20));
    QCOMPARE(listener.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(listener.next().kind(), QPlcMessage::StatesInitialized);
    listener.giveOutputs();
    const QPlcMessage values = listener.next();
    QCOMPARE(values.kind(), QPlcMessage::InitializeWithValues);
    QVERIFY(countIn(values) >= 20);
    listener.playsAlong = true;
    listener.send(QPlcMessage::Initialized);
    const QPlcMessage started = listener.next();
    QCOMPARE(started.kind(), QPlcMessage::RealTimeStarted);
    QVERIFY(started.hex64("firstCycle") > started.hex64("cycleZero"));
    QVERIFY(listener.waitForRequests(10));
    master.stop();
}

void tst_ListenerSequence::earlyReadyListenerReceivesTheStart()
{
    TestMaster master;
    QVERIFY(master.listen());
    Listener listener;
    ScriptedNode slow("Slow");
    slow.inputs.clear();
    slow.outputs.clear();
    slow.initialValues.clear();
    slow.answerAll();
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(slow.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QVERIFY(slow.waitForMessage(QPlcMessage::StatesInitialized));
    slow.playsAlong = false;
    QVERIFY(master.startRealTime());
    QVERIFY(slow.waitForMessage(QPlcMessage::RealTimeStarted));
    listener.playsAlong = true;
    listener.giveOutputs();
    QVERIFY(listener.waitForMessage(QPlcMessage::RealTimeStarted));
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    QVERIFY(!waitUntil([&] { return !listener.requests.isEmpty(); }, 50));
    slow.send(QPlcMessage::RealTimeReady);
    QVERIFY(listener.waitForRequests(1));
    QCOMPARE(listener.requests.at(0).cycle, listener.messages.last().hex64("cycleZero"));  // nothing is missed
    master.stop();
}

void tst_ListenerSequence::answersToAnEarlierSequenceAreDropped()
{
    TestMaster master;
    QVERIFY(master.listen());
    Listener listener;
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    master.stop();
    for (QPlcMessage::Kind kind :
         {QPlcMessage::SendYourInitialOutputStates, QPlcMessage::StatesInitialized, QPlcMessage::RealTimeStopped})
        QCOMPARE(listener.next().kind(), kind);
    listener.giveOutputs();  // as it was asked before the stop
    QCOMPARE(listener.next(50).kind(), QPlcMessage::Invalid);
    listener.forgetMessages();
    QVERIFY(master.startRealTime());
    QVERIFY(listener.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
    listener.send(QPlcMessage::RealTimeReady);
    listener.send(QPlcMessage::Initialized);
    listener.playsAlong = true;
    listener.giveOutputs();
    listener.giveOutputs();  // of two sequences, one answer is enough
    QVERIFY(listener.waitForRequests(10));
    QVERIFY(std::none_of(listener.messages.begin(), listener.messages.end(),
                         [](const QPlcMessage &message) { return message.kind() == QPlcMessage::Failed; }));
    master.stop();
}

void tst_ListenerSequence::listenerOutputsAreUsedOnArrival()
{
    TestMaster master;
    QVERIFY(master.listen());
    Listener listener(true);
    listener.initialValues = QPlcValue(0.25).toBytes();
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    listener.giveOutputs();
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.25);
    QVERIFY(listener.waitForMessage(QPlcMessage::InitializeWithValues));
    master.stop();
    QVERIFY(master.startRealTime());
    QCOMPARE(master.signalQuality("echo").kind(), QPlcQuality::Safe);  // it is of another phase
    listener.initialValues = QPlcValue(0.75).toBytes();
    listener.playsAlong = true;
    listener.send(QPlcMessage::Initialized);
    QVERIFY(listener.waitForRequests(1));
    listener.answer(listener.requests.last().cycle, 0.5);
    QTRY_COMPARE(master.signalValue("echo").toReal(), 0.5);
    master.stop();
}

void tst_ListenerSequence::listenerMayLeaveDuringASequence()
{
    TestMaster master;
    QVERIFY(master.listen());
    Listener listener;
    ScriptedNode slow("Slow");
    slow.playsAlong = false;
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(slow.registerAt(master.serverPort()));
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    QVERIFY(master.startRealTime());
    QVERIFY(listener.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
    listener.control.abort();
    QTRY_COMPARE(lost.size(), 1);
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    slow.playsAlong = true;
    slow.answerAll();
    slow.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(slow.initialValues)}});
    QVERIFY(master.waitForCycles(10));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    master.stop();
}

void tst_ListenerSequence::listenerFaultsDoNotStopThePlant_data()
{
    QTest::addColumn<QString>("what");
    for (const char *what :
         {"wrong size", "not finite", "fault in the initialization", "fault in a cycle", "answer with a fault"})
        QTest::newRow(what) << QString(what);
}

void tst_ListenerSequence::listenerFaultsDoNotStopThePlant()
{
    QFETCH(QString, what);
    TestMaster master(QPlcClock::realTime());
    master.setInterval(0.002);
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    Listener listener(true);
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    if (what == "wrong size")
        listener.initialValues = "abc";
    else if (what == "not finite")
        listener.initialValues = QPlcValue(qQNaN()).toBytes();
    listener.playsAlong = !what.contains("initialization");
    QVERIFY(listener.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QVERIFY(listener.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
    if (what.contains("initialization"))
        listener.send(QPlcMessage::NodeFault, {{"text", "no screen"}});
    if (what.contains("cycle") || what.contains("answer")) {
        QVERIFY(listener.waitForMessage(QPlcMessage::InitializeWithValues));
        QVERIFY(master.startRealTime());
        QVERIFY(listener.waitForRequests(1));
        const QByteArray values = QPlcValue(1.0).toBytes();
        const quint8 flags = what.contains("fault") ? qplc::FaultFlag : 0;
        if (what.contains("cycle"))
            listener.send(QPlcMessage::NodeFault, {{"text", "no screen"}});
        listener.onRequest
            = [&listener, values, flags](const ScriptedNode::Request &r) { listener.answer(r.cycle, values, flags); };
        QTRY_COMPARE(lost.size(), 1);
    } else {
        QTRY_COMPARE(lost.size(), 1);
        QVERIFY(master.startRealTime());
    }
    QCOMPARE(lost.at(0).at(0).toString(), QString("Listener"));
    QTRY_VERIFY(!listener.control.isConnected());
    QVERIFY(master.waitForCycles(master.statistics().cycles + 10));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    master.stop();
}

QTEST_GUILESS_MAIN(tst_ListenerSequence)
#include "tst_ListenerSequence.moc"
