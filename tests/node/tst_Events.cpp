// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "VirtualTime.h"

#include "realtime/TimeSource.h"

using namespace std::chrono_literals;

// What a master tells viewers of what happens in it.
class tst_Events : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void statesAreEventsWithReasons();
    void joiningAndLeavingAreEventsWithReasons();
    void lostNodeRaisesAnAlarmUntilItReturns();
    void lostNodeHasNotReturnedUntilItTakesPartInCycles();
    void aNodeThatWasJoiningHasReturnedWhenThePhaseEnds();
    void aPhaseThatBeginsWithoutANodeEndsItsAlarm();
    void refusedNodeIsAWarning();
    void lateAnswersAreReportedOncePerSecond();
    void silentPolicyLeavesNoEvent_data();
    void silentPolicyLeavesNoEvent();
    void faultsAreErrorsOfTheirNode();
    void setSignalEventsNameAuthorAndBothValues();
    void repeatedSettingsAreCombinedIntoOneEvent();
    void restoredValueIsReported();
    void leaseChangesAreReported();
    void skippedCyclesAreReported();
    void nodesReportEventsAndAlarms_data();
    void nodesReportEventsAndAlarms();
    void anAlarmOfANodeLastsAsLongAsTheNodeIsThere();
    void anAlarmOfANodeOutlivesAPhase();
    void aNodeThatReportsTooMuchIsToldTogether();
    void onlyRegisteredNodesReport();
    void noteIsAnEventOfItsWriter();
    void noteThatIsNoOneLineIsRefused_data();
    void noteThatIsNoOneLineIsRefused();
    void notesHaveALimit();
    void backlogIsAskedForInParts();
    void eventsArePushedToToolsWithTheFeature();
    void logAndEventHaveTheSameText();
    void invalidSinceIsRefused_data();
    void invalidSinceIsRefused();

private:
    /// All events of a kind, as "severity source: text".
    QStringList events(const QString &kind)
    {
        QStringList texts;
        const QPlcMessage answer = m_tool->ask(QPlcMessage::GetEvents);
        for (const QJsonValue event : answer.fields().value("events").toArray()) {
            if (event["kind"].toString() == kind)
                texts << QStringLiteral("%1 %2: %3")
                             .arg(event["severity"].toString(), event["source"].toString(), event["text"].toString());
        }
        return texts;
    }
    /// All alarms, as "+ node X" and "- node X".
    QStringList alarms()
    {
        QStringList texts;
        const QPlcMessage answer = m_tool->ask(QPlcMessage::GetEvents);
        for (const QJsonValue event : answer.fields().value("events").toArray()) {
            if (event["alarm"].isString())
                texts << (event["active"].toBool() ? "+ " : "- ") + event["alarm"].toString();
        }
        return texts;
    }
    bool start()
    {
        const bool isStarted = m_master->startRealTime() && m_tool->waitForMessage(QPlcMessage::StatesInitialized)
            && m_master->waitForState(QPlcMasterNode::RealTime);
        m_tool->forgetMessages();
        return isStarted;
    }
    /// A node is lost while cycles run. \a again registers in its place.
    bool loseNodeThatReturnsAs(ScriptedNode &again)
    {
        {
            ScriptedNode node;
            node.answerAll();
            if (!node.registerAt(m_master->serverPort()) || !start() || !node.waitForRequests(3))
                return false;
        }
        return waitUntil([this] { return m_master->nodes().isEmpty(); }) && again.registerAt(m_master->serverPort());
    }
    QScopedPointer<TestMaster> m_master;
    QScopedPointer<ScriptedTool> m_tool;
};

void tst_Events::init()
{
    m_tool.reset();
    m_master.reset(new TestMaster(QPlcClock::realTime()));
    QVERIFY(m_master->listen());
    m_tool.reset(new ScriptedTool("Anna"));
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
}

void tst_Events::statesAreEventsWithReasons()
{
    const std::int64_t before = qplc::wallClockNow();
    QVERIFY(start());
    QCOMPARE(m_tool->ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(events("state"),
             (QStringList{"info Master: state Initializing", "info Master: profile Plant: set at the master",
                          "info Master: state Real time", "info Master: state Off: 'Anna' asked for it"}));
    const QJsonArray all = m_tool->ask(QPlcMessage::GetEvents).fields().value("events").toArray();
    for (int i = 0; i < all.size(); ++i) {
        QCOMPARE(all.at(i)["sequence"].toInt(), i + 1);
        const auto time = std::int64_t(all.at(i)["time"].toString().toULongLong(nullptr, 16));
        QVERIFY(time >= before && time <= qplc::wallClockNow());
    }
}

void tst_Events::joiningAndLeavingAreEventsWithReasons()
{
    CounterNode counter;  // is a part of the master, and no news
    QVERIFY(m_master->addLocalNode(&counter));
    {
        ScriptedNode node;
        node.answerAll();
        QVERIFY(node.registerAt(m_master->serverPort()));
        QVERIFY(start());
        QVERIFY(node.waitForRequests(3));
        node.control.abort();
        QTRY_COMPARE(m_master->nodes().size(), 1);
    }
    const QStringList texts = events("node");
    QCOMPARE(texts.size(), 2);
    QCOMPARE(texts.at(0), QString("info Scripted: node Scripted registered over sim"));
    QVERIFY2(texts.at(1).startsWith("error Scripted: node Scripted is gone in the middle of its work: "),
             qPrintable(texts.at(1)));
    m_master->stop();
}

void tst_Events::lostNodeRaisesAnAlarmUntilItReturns()
{
    ScriptedNode node;
    node.answerAll();
    QVERIFY(node.registerAt(m_master->serverPort()));
    QCOMPARE(alarms(), QStringList());
    QVERIFY(start());
    QVERIFY(node.waitForRequests(3));
    node.control.abort();
    QTRY_VERIFY(m_master->nodes().isEmpty());
    QCOMPARE(alarms(), QStringList{"+ node Scripted"});
    pass(1500ms);
    ScriptedNode again;
    again.answerAll();
    QVERIFY(again.registerAt(m_master->serverPort()));
    QTRY_COMPARE(alarms(), (QStringList{"+ node Scripted", "- node Scripted"}));
    QVERIFY2(events("node").contains("info Scripted: node Scripted is back, after 1.5 s"),
             qPrintable(events("node").join('\n')));
    QVERIFY(events("node").contains("warning Scripted: node Scripted begins again at its initial state"));
    m_master->stop();
}

/// A node that registers and then stops answers no request, and no event tells of it: the alarm of
/// its loss must not end.
void tst_Events::lostNodeHasNotReturnedUntilItTakesPartInCycles()
{
    ScriptedNode again;
    again.playsAlong = false;
    QVERIFY(loseNodeThatReturnsAs(again));
    pass(1s);  // it may be silent for twice as long at least
    QCOMPARE(alarms(), QStringList{"+ node Scripted"});
    again.send(QPlcMessage::ReceiveMyInitialOutputStates,
               {{QStringLiteral("values"), QPlcMessage::fromBytes(again.initialValues)}});
    again.send(QPlcMessage::Initialized);
    pass(1s);
    QCOMPARE(alarms(), QStringList{"+ node Scripted"});
    again.send(QPlcMessage::RealTimeReady);
    QTRY_COMPARE(alarms(), (QStringList{"+ node Scripted", "- node Scripted"}));
    m_master->stop();
}

void tst_Events::aNodeThatWasJoiningHasReturnedWhenThePhaseEnds()
{
    ScriptedNode again;
    again.playsAlong = false;
    QVERIFY(loseNodeThatReturnsAs(again));
    m_master->stop();
    QTRY_COMPARE(alarms(), (QStringList{"+ node Scripted", "- node Scripted"}));
}

void tst_Events::aPhaseThatBeginsWithoutANodeEndsItsAlarm()
{
    ScriptedNode node;
    node.answerAll();
    QVERIFY(node.registerAt(m_master->serverPort()));
    QVERIFY(start());
    QVERIFY(node.waitForRequests(3));
    node.control.abort();
    QTRY_VERIFY(m_master->nodes().isEmpty());
    m_master->stop();
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    QCOMPARE(alarms(), QStringList{"+ node Scripted"});
    QVERIFY(start());
    QCOMPARE(alarms(), (QStringList{"+ node Scripted", "- node Scripted"}));
    m_master->stop();
}

void tst_Events::refusedNodeIsAWarning()
{
    ScriptedNode node;
    node.outputs = QStringList{"echo"};
    node.cyclic = "pigeon";
    QVERIFY(!node.registerAt(m_master->serverPort()));
    const QStringList texts = events("node");
    QCOMPARE(texts.size(), 1);
    QVERIFY2(texts.at(0).startsWith("warning Scripted: refused 127.0.0.1:") && texts.at(0).contains("pigeon"),
             qPrintable(texts.at(0)));
}

void tst_Events::lateAnswersAreReportedOncePerSecond()
{
    ScriptedNode mute;
    QVERIFY(m_master->setInterval(0.005));
    QVERIFY(mute.registerAt(m_master->serverPort()));
    QVERIFY(start());
    pass(402ms);
    m_master->stop();
    QCOMPARE(m_master->statistics().lateAnswers, quint64(80));  // each cycle
    const QString first = "warning Scripted: node Scripted was late in cycle 0";
    const QString last = "warning Scripted: node Scripted was late in cycle 79 (and 78 more since the last report)";
    pass(598ms);
    QCOMPARE(events("late"), QStringList{first});
    pass(10ms);  // the rest is told although nothing follows
    QCOMPARE(events("late"), (QStringList{first, last}));
}

void tst_Events::silentPolicyLeavesNoEvent_data()
{
    QTest::addColumn<QString>("policy");
    QTest::addColumn<bool>("isSilent");
    QTest::newRow("hold, silent") << "SilentZeroOrderHold" << true;
    QTest::newRow("hold, error") << "ErrorZeroOrderHold" << false;
    QTest::newRow("wait, silent") << "SilentWait" << true;
    QTest::newRow("wait, error") << "ErrorWait" << false;
}

/// In a simulation, as the thesis has it: a late node of a silent policy is counted, and that is
/// all. No event of any kind, and no signal.
void tst_Events::silentPolicyLeavesNoEvent()
{
    QFETCH(QString, policy);
    QFETCH(bool, isSilent);
    const QByteArray table = testTable().toIni().replace("hold = 1000", "");  // so that the profile decides
    QVERIFY(!table.contains("hold"));
    m_tool.reset();
    m_master.reset(new TestMaster(QPlcClock::realTime(), QPlcSignalTable::fromIni(table)));
    m_master->setProfile(QPlcProfile::Simulation);
    QVERIFY(m_master->listen());
    m_tool.reset(new ScriptedTool("Anna"));
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
    ScriptedNode mute;
    mute.policy = policy;
    QVERIFY(m_master->setInterval(0.002));
    QVERIFY(mute.registerAt(m_master->serverPort()));
    QSignalSpy violated(m_master.data(), &QPlcMasterNode::realTimeViolated);
    QVERIFY(start());
    pass(101ms);
    QCOMPARE(m_master->statistics().lateAnswers, policy.endsWith("Hold") ? quint64(50) : quint64(1));
    QStringList texts;
    for (const QJsonValue event : m_tool->ask(QPlcMessage::GetEvents).fields().value("events").toArray())
        texts << event["kind"].toString() + ": " + event["text"].toString();
    const int begin = texts.indexOf("state: state Real time");
    QVERIFY(begin >= 0);
    const QStringList after = texts.mid(begin + 1);
    QVERIFY2(after.isEmpty() == isSilent, qPrintable(after.join('\n')));
    QCOMPARE(violated.isEmpty(), isSilent);
    m_master->stop();
}

void tst_Events::faultsAreErrorsOfTheirNode()
{
    CounterNode counter;
    counter.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 3)
            throw std::runtime_error("sensor lost");
    };
    QVERIFY(m_master->addLocalNode(&counter));
    QVERIFY(m_master->startRealTime());
    QTRY_VERIFY(m_master->error() == QPlcMasterNode::NodeError);
    pass(20ms);
    m_tool->forgetMessages();
    const QStringList texts = events("fault");
    QCOMPARE(texts.size(), 1);
    QVERIFY2(texts.at(0).startsWith("error Counter: node 'Counter' in cycle 3: ")
                 && texts.at(0).contains("sensor lost"),
             qPrintable(texts.at(0)));
    QVERIFY(events("state").last().startsWith("info Master: state Off: node 'Counter'"));
}

void tst_Events::setSignalEventsNameAuthorAndBothValues()
{
    m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "1.5"}, {"vector", "1, 2, 3"}}}});
    QVERIFY(m_master->setSignalValue("setpoint", 2.0));
    QCOMPARE(events("set"),
             (QStringList{"info Master: 'Anna' has set setpoint: 0 -> 1.5",
                          "info Master: 'Anna' has set vector: 0, 0, 0 -> 1, 2, 3",
                          "info Master: 'Master' has set setpoint: 1.5 -> 2"}));
}

void tst_Events::repeatedSettingsAreCombinedIntoOneEvent()
{
    for (int i = 1; i <= 30; ++i)
        m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", QString::number(i / 10.0)}}}});
    QTRY_COMPARE(events("set").size(), 2);
    QCOMPARE(events("set"),
             (QStringList{"info Master: 'Anna' has set setpoint: 0 -> 0.1",
                          "info Master: 'Anna' has set setpoint: 0.1 -> 3 (and 28 more since the last report)"}));
}

void tst_Events::restoredValueIsReported()
{
    m_tool->ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{"setpoint", "4"}}}, {"duration", 20e6}});
    QTRY_COMPARE(events("set").size(), 2);
    QCOMPARE(events("set").last(), QString("info Master: former value restored: setpoint = 0"));
}

void tst_Events::leaseChangesAreReported()
{
    {
        ScriptedTool bert("Bert");
        QVERIFY(bert.greetAt(m_master->serverPort()));
        m_tool->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint", "free"}}, {"timeout", 1e12}});
        bert.ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"setpoint"}}, {"takeOver", true}, {"timeout", 1e12}});
    }
    QTRY_COMPARE(events("lease").size(), 3);
    m_tool->ask(QPlcMessage::ReleaseLease, {{"signals", QJsonArray{"setpoint", "free"}}});
    QCOMPARE(
        events("lease"),
        (QStringList{
            "info Master: 'Anna' has taken over setpoint, free",
            "info Master: 'Bert' has taken over setpoint from 'Anna'",
            "warning Master: 'Bert' has lost the connection: setpoint = 0, until somebody takes or releases the lease",
            "info Master: 'Anna' has released setpoint, free"}));
}

void tst_Events::skippedCyclesAreReported()
{
    CounterNode counter;
    counter.onStep = [](const QPlcCycle &cycle) {
        if (cycle.number() == 2)
            beBusyFor(60ms);
    };
    QVERIFY(m_master->setInterval(0.010));
    QVERIFY(m_master->addLocalNode(&counter));
    QVERIFY(start());
    QVERIFY(m_master->waitForCycles(5));
    m_master->stop();
    const QStringList texts = events("overrun");
    QCOMPARE(texts.size(), 1);
    QCOMPARE(texts.at(0),
             QString("warning Master: cycles that began a period or more late since the last report: 1; left out: 5"));
}

void tst_Events::nodesReportEventsAndAlarms_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("in the process of the master") << "local";
    QTest::newRow("over the network") << datagrams();
}

void tst_Events::nodesReportEventsAndAlarms()
{
    QFETCH(QString, kind);
    CounterNode node;
    QVERIFY(m_master->admit(node, kind));
    node.reportEvent(QPlcSlaveNode::InfoEvent, "the sensor was\ncalibrated");
    node.beginAlarm("oil", QPlcSlaveNode::WarningEvent, "the oil is hot");
    node.beginAlarm("oil", QPlcSlaveNode::ErrorEvent, "the oil is very hot");
    pass(1500ms);
    node.endAlarm("oil", "the oil is cold");
    node.endAlarm("water", "the water is cold");  // it was never hot
    QTRY_COMPARE(events("report"),
                 (QStringList{"info Counter: node Counter: the sensor was?calibrated",
                              "warning Counter: node Counter: the oil is hot",
                              "error Counter: node Counter: the oil is very hot",
                              "info Counter: node Counter: the oil is cold, after 1.5 s"}));
    QCOMPARE(alarms(), (QStringList{"+ Counter: oil", "+ Counter: oil", "- Counter: oil"}));
}

void tst_Events::anAlarmOfANodeLastsAsLongAsTheNodeIsThere()
{
    CounterNode node;
    node.beginAlarm("oil", QPlcSlaveNode::WarningEvent, "the oil is hot");  // no master is there yet
    node.beginAlarm("water", QPlcSlaveNode::WarningEvent, "the water is hot");
    node.endAlarm("water", "the water is cold");
    node.reportEvent(QPlcSlaveNode::InfoEvent, "nobody hears this");
    for (int i = 1; i <= 2; ++i) {
        QVERIFY(m_master->admit(node, datagrams()));
        QTRY_COMPARE(alarms().size(), 2 * i - 1);
        node.disconnectFromMaster();
        QTRY_COMPARE(alarms().size(), 2 * i);
    }
    QCOMPARE(alarms(), (QStringList{"+ Counter: oil", "- Counter: oil", "+ Counter: oil", "- Counter: oil"}));
    QCOMPARE(events("report").first(),
             QString("warning Counter: node Counter: the oil is hot (3 more events were left out before)"));
    QVERIFY(events("report").last().contains("Counter: oil: not known any more, the node has left, after"));
}

void tst_Events::anAlarmOfANodeOutlivesAPhase()
{
    CounterNode node;
    QVERIFY(m_master->addLocalNode(&node));
    node.beginAlarm("oil", QPlcSlaveNode::WarningEvent, "the oil is hot");
    QVERIFY(start());
    QCOMPARE(m_tool->ask(QPlcMessage::Stop).kind(), QPlcMessage::Done);
    QCOMPARE(alarms(), QStringList{"+ Counter: oil"});
}

/// Neither a node of ours, which sends less, nor one that floods its master.
void tst_Events::aNodeThatReportsTooMuchIsToldTogether()
{
    CounterNode node;
    QVERIFY(m_master->admit(node, datagrams()));
    for (int i = 0; i < 1000; ++i) {
        node.beginAlarm("contact", QPlcSlaveNode::WarningEvent, QString("bounce %1").arg(i));
        node.endAlarm("contact", "quiet");
    }
    node.beginAlarm("contact", QPlcSlaveNode::WarningEvent, "stuck");
    QTRY_COMPARE(events("report").size(), 16);
    pass(1s);
    QTRY_COMPARE(events("report").size(), 17);
    QVERIFY(events("report").last().startsWith("warning Counter: node Counter: stuck (19"));
    QCOMPARE(alarms().last(), QString("+ Counter: contact"));

    ScriptedNode hostile;
    QVERIFY(hostile.registerAt(m_master->serverPort()));
    for (int i = 0; i < 500; ++i)
        hostile.send(QPlcMessage::NodeEvent, {{"severity", "error"}, {"text", "x"}, {"alarm", QString::number(i)}});
    QTRY_VERIFY(events("report").last().contains("node Scripted reports too much"));
    QCOMPARE(alarms().filter("+ Scripted").size(), 32);
    QVERIFY(events("report").size() < 17 + 36);
}

void tst_Events::onlyRegisteredNodesReport()
{
    const QPlcMessage answer = m_tool->ask(QPlcMessage::NodeEvent, {{"text", "smoke"}});
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QCOMPARE(events("report"), QStringList());
}

void tst_Events::noteIsAnEventOfItsWriter()
{
    const QString text(200, QChar(0xe9));
    QCOMPARE(m_tool->ask(QPlcMessage::Note, {{"text", "gust from the north"}}).kind(), QPlcMessage::Done);
    QCOMPARE(m_tool->ask(QPlcMessage::Note, {{"text", text}, {"whoever", "bert@ground"}}).kind(), QPlcMessage::Done);
    QCOMPARE(events("note"), (QStringList{"info Anna: gust from the north", "info bert@ground: " + text}));
}

void tst_Events::noteThatIsNoOneLineIsRefused_data()
{
    QTest::addColumn<QJsonValue>("text");
    QTest::addColumn<QString>("reason");
    QTest::newRow("nothing") << QJsonValue(QJsonValue::Undefined) << "'text'";
    QTest::newRow("number") << QJsonValue(7) << "'text'";
    QTest::newRow("empty") << QJsonValue("") << "empty";
    QTest::newRow("blank") << QJsonValue(" \u2003 ") << "empty";
    QTest::newRow("too long") << QJsonValue(QString(201, 'x')) << "has 201 characters; write at most 200";
    QTest::newRow("two lines") << QJsonValue("one\ntwo") << "one?two";
    QTest::newRow("terminal") << QJsonValue("\x1b[2J") << "?[2J";
    QTest::newRow("turned around") << QJsonValue(QString("a") + QChar(0x202e) + "b") << "a?b";
}

void tst_Events::noteThatIsNoOneLineIsRefused()
{
    QFETCH(QJsonValue, text);
    QFETCH(QString, reason);
    const QPlcMessage answer = m_tool->ask(QPlcMessage::Note, {{"text", text}});
    QCOMPARE(answer.kind(), QPlcMessage::Failed);
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QVERIFY2(answer.text("text").contains(reason), qPrintable(answer.text("text")));
    QCOMPARE(events("note"), QStringList());
}

/// The log has room for 1000 events: notes must not push the others out.
void tst_Events::notesHaveALimit()
{
    for (int i = 1; i <= 20; ++i)
        QCOMPARE(m_tool->ask(QPlcMessage::Note, {{"text", QString::number(i)}}).kind(), QPlcMessage::Done);
    const QPlcMessage answer = m_tool->ask(QPlcMessage::Note, {{"text", "21"}});
    QCOMPARE(answer.text("error"), QString("TooMuch"));
    QCOMPARE(events("note").size(), 20);
    pass(1s);
    QCOMPARE(m_tool->ask(QPlcMessage::Note, {{"text", "21"}}).kind(), QPlcMessage::Done);
    QCOMPARE(events("note").last(), QString("info Anna: 21"));
}

void tst_Events::backlogIsAskedForInParts()
{
    for (int i = 0; i < 150; ++i) {
        m_tool->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"free"}}, {"timeout", 1e12}});
        m_tool->ask(QPlcMessage::ReleaseLease);
    }
    quint64 sequence = 0;
    int answers = 0;
    for (bool more = true; more; ++answers) {
        const QPlcMessage answer = m_tool->ask(QPlcMessage::GetEvents, {{"since", double(sequence)}});
        QVERIFY(answer.fields().value("more").isBool());
        more = answer.fields().value("more").toBool();
        for (const QJsonValue event : answer.fields().value("events").toArray())
            QCOMPARE(quint64(event["sequence"].toDouble()), ++sequence);
    }
    QVERIFY(sequence >= 300);
    QCOMPARE(answers, 2);
    QVERIFY(m_tool->ask(QPlcMessage::GetEvents, {{"since", double(sequence)}})
                .fields()
                .value("events")
                .toArray()
                .isEmpty());
    QCOMPARE(m_tool->ask(QPlcMessage::GetEvents, {{"since", 1e15}}).fields().value("more").toBool(), false);
}

void tst_Events::eventsArePushedToToolsWithTheFeature()
{
    ScriptedTool viewer("Viewer");
    m_tool->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"free"}}, {"timeout", 1e12}});  // before it came
    QVERIFY(viewer.connectTo(m_master->serverPort()));
    QJsonObject hello = viewer.helloFields();
    hello.insert("features", QJsonArray{"events"});
    viewer.send(QPlcMessage::Hello, hello);
    QCOMPARE(viewer.next().fields().value("features").toArray(), QJsonArray{"events"});
    m_tool->ask(QPlcMessage::ReleaseLease);
    const QPlcMessage pushed = viewer.next();
    QCOMPARE(pushed.kind(), QPlcMessage::Events);
    QVERIFY(!pushed.fields().contains("more"));
    const QJsonArray events = pushed.fields().value("events").toArray();
    QCOMPARE(events.size(), 1);
    QCOMPARE(events.at(0)["text"].toString(), QString("'Anna' has released free"));
    QCOMPARE(m_tool->messages.last().kind(), QPlcMessage::Done);  // without the feature: nothing
}

void tst_Events::logAndEventHaveTheSameText()
{
    LogCapture log;
    QVERIFY(!m_master->setInterval(100.0));
    const QStringList texts = events("state");
    QCOMPARE(texts, QStringList{"error Master: " + m_master->errorString()});
    QCOMPARE(log.matching(m_master->errorString()).size(), 1);
}

void tst_Events::invalidSinceIsRefused_data()
{
    QTest::addColumn<QJsonValue>("since");
    QTest::newRow("negative") << QJsonValue(-1);
    QTest::newRow("a fraction") << QJsonValue(0.5);
    QTest::newRow("too large") << QJsonValue(1e300);
    QTest::newRow("a text") << QJsonValue("1");
}

void tst_Events::invalidSinceIsRefused()
{
    QFETCH(QJsonValue, since);
    const QPlcMessage refused = m_tool->ask(QPlcMessage::GetEvents, {{"since", since}});
    QCOMPARE(refused.text("error"), QString("MalformedMessage"));
    QVERIFY(refused.text("text").contains("'since'"));
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Events)
#include "tst_Events.moc"
