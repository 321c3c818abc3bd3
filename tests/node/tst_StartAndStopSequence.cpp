// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"

using namespace std::chrono_literals;

// Figure 4.17 of the thesis: start and stop of the real-time phase, asked for by a tool.
class tst_StartAndStopSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void masterStartsWhenAllAreReady();
    void startInitializesAnUninitializedMaster();
    void anInitializedMasterStartsWithoutAnotherInitialization();
    void aNodeThatIsNotReadyInTimeEndsTheStart();
    void aFaultThatArrivesAfterItsPhaseEndsNoStart();
    void stopDuringTheInitializationEndsIt();
    void stopIsAllowedInEveryState();
    void theStateTellsWhoHasStopped();
    void slaveStartsAndStopsStepByStep();
    void aSecondStartIsRefused();
    void cycleLimitIsCheckedAndKept_data();
    void cycleLimitIsCheckedAndKept();
    void invalidPhaseIsRefused_data();
    void invalidPhaseIsRefused();
    void cycleBeyondTheTimeRangeIsRejected();
    void masterEndIsNotifiedAndMasterLossIsAnError();
};

void tst_StartAndStopSequence::masterStartsWhenAllAreReady()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    ScriptedTool tool;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::InitializeAllStates).kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QTRY_COMPARE(node.messages.last().kind(), QPlcMessage::StatesInitialized);
    node.forgetMessages();
    node.playsAlong = false;

    tool.send(QPlcMessage::StartRealTime);
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStarted));
    const QPlcMessage started = node.messages.at(0);
    QCOMPARE(started.fields().value("period").toDouble(), 10e6);
    QCOMPARE(started.text("clock"), QString("Lockstep"));
    QCOMPARE(started.fields().value("scale").toDouble(-1.0), 0.0);
    QCOMPARE(started.hex64("firstCycle"), started.hex64("cycleZero"));
    QCOMPARE(tool.next(50).kind(), QPlcMessage::Invalid);
    QCOMPARE(node.requests.size(), 0);  // no frame before RealTimeReady
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);

    node.send(QPlcMessage::RealTimeReady);
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    QVERIFY(node.waitForRequests(1));
    QCOMPARE(node.requests.at(0).cycle, started.hex64("firstCycle"));

    tool.send(QPlcMessage::Stop);
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));
    QVERIFY2(node.messages.last().text("reason").contains("'Tool'"), qPrintable(node.messages.last().text("reason")));
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_StartAndStopSequence::startInitializesAnUninitializedMaster()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    QVERIFY(node.registerAt(master.serverPort()));
    QSignalSpy initialized(&master, &QPlcMasterNode::statesInitialized);
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    node.answerAll();
    QVERIFY(master.startRealTime());
    for (QPlcMessage::Kind kind : {QPlcMessage::SendYourInitialOutputStates, QPlcMessage::InitializeWithValues,
                                   QPlcMessage::StatesInitialized, QPlcMessage::RealTimeStarted})
        QCOMPARE(node.next().kind(), kind);
    QVERIFY(master.waitForCycles(10));
    QCOMPARE(initialized.size(), 1);
    QCOMPARE(states.size(), 2);
    master.stop();
    QCOMPARE(node.next().kind(), QPlcMessage::RealTimeStopped);
}

void tst_StartAndStopSequence::anInitializedMasterStartsWithoutAnotherInitialization()
{
    TestMaster master;
    master.setCycleLimit(3);
    CounterNode counter;
    EchoNode echo;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(counter.resets, 1);
    QVERIFY(master.startRealTime());  // after a phase everything begins at the top
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(counter.resets, 2);
    QVERIFY(master.initializeAllStates());
    QVERIFY(master.addLocalNode(&echo));  // and so it does when somebody has joined
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(counter.resets, 4);
    QCOMPARE(counter.initialEcho, 0.5);
}

void tst_StartAndStopSequence::aNodeThatIsNotReadyInTimeEndsTheStart()
{
    TestMaster master;
    master.setInitializationTimeout(std::chrono::milliseconds(200));
    QVERIFY(master.listen());
    ScriptedNode good("Good");
    ScriptedNode sleepy("Sleepy");
    sleepy.inputs.clear();
    sleepy.outputs.clear();
    sleepy.initialValues.clear();
    QVERIFY(good.registerAt(master.serverPort()));
    QVERIFY(sleepy.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QVERIFY(sleepy.waitForMessage(QPlcMessage::StatesInitialized));
    sleepy.playsAlong = false;
    QVERIFY(master.startRealTime());
    QVERIFY(good.waitForMessage(QPlcMessage::RealTimeStopped));  // it had begun already
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QVERIFY2(master.errorString().contains("'Sleepy'") && master.errorString().contains("RealTimeStarted"),
             qPrintable(master.errorString()));
    // The next start begins with an initialization: cycle 0 is not computed without its nodes.
    sleepy.playsAlong = true;
    good.answerAll();
    sleepy.answerAll();
    good.forgetMessages();
    QVERIFY(master.startRealTime());
    QVERIFY(good.waitForMessage(QPlcMessage::RealTimeStarted));
    QCOMPARE(good.messages.at(0).kind(), QPlcMessage::SendYourInitialOutputStates);
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(good.requests.at(0).cycle, good.messages.last().hex64("cycleZero"));
    master.stop();
}

void tst_StartAndStopSequence::aFaultThatArrivesAfterItsPhaseEndsNoStart()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.answerAll();
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStarted));
    const QString phase = node.messages.last().text("cycleZero");
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    master.stop();
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));

    const auto startWithAFaultOf = [&](const QJsonObject &fields) {
        node.forgetMessages();
        node.playsAlong = false;
        QVERIFY(master.startRealTime());
        QVERIFY(node.waitForMessage(QPlcMessage::SendYourInitialOutputStates));
        node.send(QPlcMessage::NodeFault, fields);
        node.playsAlong = true;
        node.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(node.initialValues)}});
    };
    startWithAFaultOf({{"text", "cable"}, {"phase", phase}});
    QVERIFY(master.waitForState(QPlcMasterNode::RealTime));
    master.stop();
    QVERIFY(node.waitForMessage(QPlcMessage::RealTimeStopped));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);

    startWithAFaultOf({{"text", "reset"}});  // in its initialization
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QVERIFY2(master.errorString().contains("reset"), qPrintable(master.errorString()));
}

void tst_StartAndStopSequence::stopDuringTheInitializationEndsIt()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.playsAlong = false;
    ScriptedTool asker;
    ScriptedTool stopper("Stopper");
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(asker.greetAt(master.serverPort()));
    QVERIFY(stopper.greetAt(master.serverPort()));
    asker.send(QPlcMessage::StartRealTime);
    QCOMPARE(node.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(stopper.ask(QPlcMessage::InitializeAllStates).text("error"), QString("WrongState"));
    stopper.send(QPlcMessage::Stop);
    QCOMPARE(stopper.next().kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(stopper.next().kind(), QPlcMessage::Done);
    QCOMPARE(asker.next().kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(asker.next().kind(), QPlcMessage::Failed);
    QCOMPARE(node.next().kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_StartAndStopSequence::stopIsAllowedInEveryState()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QSignalSpy stopped(&master, &QPlcMasterNode::realTimeHasStopped);
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::StartRealTime).kind(), QPlcMessage::StatesInitialized);
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(tool.ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(stopped.size(), 1);
}

void tst_StartAndStopSequence::theStateTellsWhoHasStopped()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedTool anna("Anna");
    ScriptedTool bert("Bert");
    QVERIFY(anna.greetAt(master.serverPort()) && bert.greetAt(master.serverPort()));
    QVERIFY(!anna.ask(QPlcMessage::GetState).fields().contains("stopped"));
    QVERIFY(master.startRealTime());
    QVERIFY(anna.waitForMessage(QPlcMessage::StatesInitialized) && bert.waitForMessage(QPlcMessage::StatesInitialized));
    QCOMPARE(anna.answerTo(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    const QJsonObject hers = anna.ask(QPlcMessage::GetState).fields().value("stopped").toObject();
    QCOMPARE(hers.value("whoever").toString(), QString("Anna"));
    QVERIFY(hers.value("yours").toBool());
    const QJsonObject others = bert.answerTo(QPlcMessage::GetState).fields().value("stopped").toObject();
    QCOMPARE(others.value("whoever").toString(), QString("Anna"));
    QVERIFY(!others.value("yours").toBool());
}

void tst_StartAndStopSequence::slaveStartsAndStopsStepByStep()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.admit(node, master.udp()));
    QSignalSpy started(&node, &QPlcSlaveNode::realTimeHasStarted);
    QSignalSpy stopped(&node, &QPlcSlaveNode::realTimeHasStopped);
    for (int phase = 1; phase <= 3; ++phase) {
        QVERIFY(master.start("Lockstep"));
        QCOMPARE(node.state(), QPlcSlaveNode::RealTime);
        QCOMPARE(started.size(), phase);
        master.request(0);
        QVERIFY(master.waitForAnswers(1));
        QCOMPARE(node.counters().cycles, quint64(1));  // of this phase
        master.send(QPlcMessage::RealTimeStopped, {{"reason", "the end"}});
        QTRY_COMPARE(stopped.size(), phase);
        QCOMPARE(node.stops, phase);
        QCOMPARE(node.state(), QPlcSlaveNode::Off);
        master.answers.clear();
        master.first += 1000;
    }
}

void tst_StartAndStopSequence::aSecondStartIsRefused()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QVERIFY(master.startRealTime());
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    const QPlcMessage failed = tool.ask(QPlcMessage::StartRealTime);
    QCOMPARE(failed.kind(), QPlcMessage::Failed);
    QCOMPARE(failed.text("error"), QString("WrongState"));
    QCOMPARE(tool.ask(QPlcMessage::InitializeAllStates).text("error"), QString("WrongState"));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    master.stop();
}

void tst_StartAndStopSequence::cycleLimitIsCheckedAndKept_data()
{
    QTest::addColumn<QJsonValue>("cycles");
    QTest::addColumn<quint64>("expected");  // 0: refused
    QTest::newRow("one") << QJsonValue(1) << quint64(1);
    QTest::newRow("many") << QJsonValue(1234) << quint64(1234);
    QTest::newRow("negative") << QJsonValue(-1) << quint64(0);
    QTest::newRow("half") << QJsonValue(0.5) << quint64(0);
    QTest::newRow("huge") << QJsonValue(1e300) << quint64(0);
    QTest::newRow("text") << QJsonValue("3") << quint64(0);
    QTest::newRow("null") << QJsonValue() << quint64(0);
}

void tst_StartAndStopSequence::cycleLimitIsCheckedAndKept()
{
    QFETCH(QJsonValue, cycles);
    QFETCH(quint64, expected);
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    const QPlcMessage first = tool.ask(QPlcMessage::StartRealTime, {{"cycles", cycles}});
    if (expected == 0) {
        QCOMPARE(first.kind(), QPlcMessage::Failed);
        QCOMPARE(first.text("error"), QString("MalformedMessage"));
        QCOMPARE(master.state(), QPlcMasterNode::Off);
        return;
    }
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().cycles, expected);
    QCOMPARE(master.signalValue("count").toUInt64(), expected);
}

void tst_StartAndStopSequence::invalidPhaseIsRefused_data()
{
    QTest::addColumn<QString>("field");
    QTest::addColumn<QJsonValue>("value");
    QTest::addColumn<QString>("word");
    QTest::newRow("no period") << "period" << QJsonValue() << "field 'period'";
    QTest::newRow("period 0") << "period" << QJsonValue(0) << "a period of 0 s";
    QTest::newRow("period below 0") << "period" << QJsonValue(-10e6) << "a period of -0.01 s";
    QTest::newRow("period too short") << "period" << QJsonValue(9999) << "a period of";
    QTest::newRow("period too long") << "period" << QJsonValue(10e9 + 1) << "a period of 10";
    QTest::newRow("period beyond 64 bits") << "period" << QJsonValue(1e300) << "field 'period'";
    QTest::newRow("scale 0") << "scale" << QJsonValue(0) << "a clock of 0 times";
    QTest::newRow("scale below 0") << "scale" << QJsonValue(-1) << "a clock of -1 times";
    QTest::newRow("scale too small") << "scale" << QJsonValue(1e-300) << "a clock of 1e-300 times";
    QTest::newRow("scale too large") << "scale" << QJsonValue(1001) << "a clock of 1001 times";
    QTest::newRow("unknown clock") << "clock" << QJsonValue("Sundial") << "field 'clock'";
    QTest::newRow("group that is none") << "group" << QJsonValue(5) << "field 'group'";
    QTest::newRow("first cycle before cycle 0")
        << "cycleZero" << QJsonValue(QPlcMessage::fromHex64(101)) << "begins with cycle -1";
    QTest::newRow("first cycle after the end of time")
        << "firstCycle" << QJsonValue(QPlcMessage::fromHex64(Q_UINT64_C(1) << 62)) << "begins with cycle 4611";
}

void tst_StartAndStopSequence::invalidPhaseIsRefused()
{
    QFETCH(QString, field);
    QFETCH(QJsonValue, value);
    QFETCH(QString, word);
    ScriptedMaster master;
    CounterNode node;
    node.activateWatchdog(20ms);
    QVERIFY(master.admit(node, master.udp()));
    QJsonObject fields = master.startFields(QStringLiteral("Scaled"));
    fields.insert(field, value);
    master.send(QPlcMessage::RealTimeStarted, fields);
    const QPlcMessage answer = master.next();
    QCOMPARE(answer.kind(), QPlcMessage::NodeFault);
    QVERIFY2(answer.text("text").contains(word), qPrintable(answer.text("text")));
    QCOMPARE(node.error(), QPlcSlaveNode::ProtocolError);
    QVERIFY2(node.errorString().contains(word), qPrintable(node.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Registered);
    QVERIFY(master.start());  // one that can be meant
    QCOMPARE(node.state(), QPlcSlaveNode::RealTime);
    node.disconnectFromMaster();
}

void tst_StartAndStopSequence::cycleBeyondTheTimeRangeIsRejected()
{
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(master.start(QStringLiteral("Lockstep"), 10'000'000'000));
    master.request(0x7FFFFFFF);  // in 681 years
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QCOMPARE(node.counters().rejected, quint64(1));
    QCOMPARE(node.counters().cycles, quint64(1));
    QCOMPARE(node.counters().missed, quint64(0));
    node.disconnectFromMaster();
}

void tst_StartAndStopSequence::masterEndIsNotifiedAndMasterLossIsAnError()
{
    CounterNode ended;
    CounterNode lost;
    QSignalSpy goodbye(&ended, &QPlcSlaveNode::disconnectedFromMaster);
    {
        TestMaster master;
        QVERIFY(master.listen());
        QVERIFY(ended.connectToMasterAndWaitForConnected(master.protocol("udp")));
        QVERIFY(master.startRealTime());
        QTRY_COMPARE(ended.state(), QPlcSlaveNode::RealTime);
    }
    QTRY_COMPARE(goodbye.size(), 1);
    QCOMPARE(ended.error(), QPlcSlaveNode::NoError);
    QCOMPARE(ended.state(), QPlcSlaveNode::Disconnected);
    QCOMPARE(ended.stops, 1);

    ScriptedMaster master;
    QVERIFY(master.admit(lost, master.tcp()));
    QVERIFY(master.start());
    QSignalSpy errors(&lost, &QPlcSlaveNode::errorWithMaster);
    master.control->abort();
    QTRY_COMPARE(errors.size(), 1);
    QCOMPARE(lost.error(), QPlcSlaveNode::ConnectionError);
    QCOMPARE(lost.state(), QPlcSlaveNode::SafeStop);
    QCOMPARE(lost.stops, 1);
}

QTEST_GUILESS_MAIN(tst_StartAndStopSequence)
#include "tst_StartAndStopSequence.moc"
