// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "SameCycleFixtures.h"
#include "VirtualTime.h"

using namespace std::chrono_literals;

// Persons who take signals over by leases, at the control channel of a real master.
class tst_TakeOver : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void holderSetsASignalThatANodeWrites();
    void signalKeepsItsPresentValueUntilTheHolderSetsIt();
    void releasedSignalFollowsItsWriterAgain();
    void signalWithoutAWriterCanBeLeasedToo();
    void onlyTheHolderSetsTheSignal();
    void takingOverIsExplicit();
    void twoHoldersHaveTwoSignals();
    void signalIsNeutralWhenTheHolderDisconnects();
    void signalIsNeutralWhenTheHolderIsSilent();
    void anyMessageOfTheHolderRenewsTheLease();
    void lostLeaseCanBeReleasedOrReplacedByAnyone();
    void lostLeaseSurvivesStopAndStart();
    void temporaryValuesAreNotRestoredDuringALease();
    void aLeasedSignalComesBackToTheValueOfItsWriter();
    void aThousandSignalsAreTakenAtMost();
    void invalidRequestsCreateNoLease_data();
    void invalidRequestsCreateNoLease();
    void releaseOfAnotherHoldersLeaseIsRefused();
    void masterSignalsCannotBeLeased();
    void laterWriterDoesNotEndTheLease();
    void everyReaderSeesTheHeldValueInEveryCycle_data();
    void everyReaderSeesTheHeldValueInEveryCycle();
    void listenerReceivesOnlyTheLeasedValue();
    void releasedLeaseLeavesResultsIdentical();
    void leaseChangesArePushedToToolsWithTheFeature();

private:
    QPlcMessage take(ScriptedTool &tool, const QStringList &names, QJsonObject fields = {})
    {
        fields.insert("signals", QJsonArray::fromStringList(names));
        if (!fields.contains("timeout"))
            fields.insert("timeout", 3.6e12);
        return tool.ask(QPlcMessage::TakeLease, fields);
    }
    QPlcMessage set(ScriptedTool &tool, const QString &name, const QString &value)
    {
        return tool.ask(QPlcMessage::SetSignals, {{"values", QJsonObject{{name, value}}}});
    }
    QPlcMessage release(ScriptedTool &tool, const QStringList &names)
    {
        return tool.ask(QPlcMessage::ReleaseLease, {{"signals", QJsonArray::fromStringList(names)}});
    }
    QString value(const QString &name) const { return m_master->signalValue(name).toString(); }
    QJsonObject row(const QString &name)
    {
        const QPlcMessage answer = m_bert->ask(QPlcMessage::GetSignals, {{"names", QJsonArray{name}}});
        return answer.fields().value("signals").toArray().at(0).toObject();
    }
    bool startWithNodes();
    bool waitForSomeCycles() { return m_master->waitForCycles(m_master->statistics().cycles + 5); }

    QScopedPointer<TestMaster> m_master;
    QScopedPointer<CounterNode> m_counter;
    QScopedPointer<EchoNode> m_echo;
    QScopedPointer<ScriptedTool> m_anna, m_bert;
};

void tst_TakeOver::init()
{
    m_anna.reset();
    m_bert.reset();
    m_master.reset(new TestMaster(QPlcClock::realTime()));
    m_counter.reset(new CounterNode);
    m_echo.reset(new EchoNode);
    m_master->setInterval(0.002);
    QVERIFY(m_master->listen());
    m_anna.reset(new ScriptedTool("Anna"));
    m_bert.reset(new ScriptedTool("Bert"));
    QVERIFY(m_anna->greetAt(m_master->serverPort()));
    QVERIFY(m_bert->greetAt(m_master->serverPort()));
}

bool tst_TakeOver::startWithNodes()
{
    const bool isStarted = m_master->addLocalNode(m_counter.data()) && m_master->addLocalNode(m_echo.data())
        && m_master->startRealTime() && m_anna->waitForMessage(QPlcMessage::StatesInitialized)
        && m_bert->waitForMessage(QPlcMessage::StatesInitialized) && m_master->waitForCycles(3);
    m_anna->forgetMessages();
    m_bert->forgetMessages();
    return isStarted;
}

void tst_TakeOver::holderSetsASignalThatANodeWrites()
{
    QVERIFY(startWithNodes());
    QCOMPARE(set(*m_anna, "echo", "-1").text("error"), QString("SignalHasWriter"));
    QCOMPARE(take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1.5"}}}}).kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("echo"), QString("-1.5"));
    QCOMPARE(set(*m_anna, "echo", "-2.5").kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("echo"), QString("-2.5"));
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("echo"), QString("-2.5"));
    QCOMPARE(row("echo").value("writer").toString(), QString("Echo"));
    QCOMPARE(row("echo").value("holder").toString(), QString("Anna"));
    QCOMPARE(row("echo").value("lease").toString(), QString("held"));
    QVERIFY(!row("sum").contains("holder") && !row("sum").contains("lease"));
    QCOMPARE(m_master->leases().size(), 1);
    QCOMPARE(m_master->leases().at(0).holder, QString("Anna"));
    m_master->stop();
}

void tst_TakeOver::signalKeepsItsPresentValueUntilTheHolderSetsIt()
{
    QVERIFY(startWithNodes());
    QCOMPARE(take(*m_anna, {"count"}, {{"whoever", "Anna at desk 3"}}).kind(), QPlcMessage::Done);
    QVERIFY(waitForSomeCycles());
    const QString held = value("count");
    QVERIFY(held.toInt() >= 3);
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("count"), held);
    QCOMPARE(row("count").value("holder").toString(), QString("Anna at desk 3"));
    m_master->stop();
}

void tst_TakeOver::releasedSignalFollowsItsWriterAgain()
{
    QVERIFY(startWithNodes());
    QSignalSpy changed(m_master.data(), &QPlcMasterNode::leaseChanged);
    take(*m_anna, {"count"}, {{"values", QJsonObject{{"count", "-5"}}}});
    QTRY_COMPARE(value("count"), QString("-5"));
    QCOMPARE(release(*m_anna, {"count"}).kind(), QPlcMessage::Done);
    QTRY_VERIFY(value("count").toInt() > 0);
    QCOMPARE(set(*m_anna, "count", "1").text("error"), QString("SignalHasWriter"));
    QVERIFY(!row("count").contains("holder"));
    QCOMPARE(release(*m_anna, {"count"}).kind(), QPlcMessage::Done);  // may be said twice
    QCOMPARE(changed.size(), 2);
    take(*m_anna, {"count", "setpoint"});
    QCOMPARE(m_anna->ask(QPlcMessage::ReleaseLease).kind(), QPlcMessage::Done);  // all that she has
    QVERIFY(m_master->leases().isEmpty());
    m_master->stop();
}

void tst_TakeOver::signalWithoutAWriterCanBeLeasedToo()
{
    QVERIFY(startWithNodes());
    take(*m_anna, {"setpoint"});
    QCOMPARE(set(*m_anna, "setpoint", "4").kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("setpoint"), QString("4"));
    QCOMPARE(release(*m_anna, {"setpoint"}).kind(), QPlcMessage::Done);
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("setpoint"), QString("4"));
    QCOMPARE(set(*m_bert, "setpoint", "5").kind(), QPlcMessage::Done);
    m_master->stop();
}

void tst_TakeOver::onlyTheHolderSetsTheSignal()
{
    take(*m_anna, {"setpoint"}, {{"values", QJsonObject{{"setpoint", "4"}}}});
    const QPlcMessage refused = set(*m_bert, "setpoint", "5");
    QCOMPARE(refused.text("error"), QString("LeaseHeld"));
    QVERIFY2(refused.text("text").contains("'setpoint'") && refused.text("text").contains("'Anna'"),
             qPrintable(refused.text("text")));
    QVERIFY(!m_master->setSignalValue("setpoint", 5.0));
    QVERIFY2(m_master->errorString().contains("'Anna'"), qPrintable(m_master->errorString()));
    QCOMPARE(value("setpoint"), QString("4"));
}

void tst_TakeOver::takingOverIsExplicit()
{
    take(*m_anna, {"setpoint"}, {{"values", QJsonObject{{"setpoint", "4"}}}});
    const QPlcMessage refused = take(*m_bert, {"free", "setpoint"});
    QCOMPARE(refused.text("error"), QString("LeaseHeld"));
    QVERIFY(refused.text("text").contains("'Anna'"));
    QCOMPARE(m_master->leases().size(), 1);  // all or none
    QCOMPARE(take(*m_bert, {"setpoint"}, {{"takeOver", true}}).kind(), QPlcMessage::Done);
    QCOMPARE(value("setpoint"), QString("4"));
    QCOMPARE(set(*m_anna, "setpoint", "6").text("error"), QString("LeaseHeld"));
    QCOMPARE(set(*m_bert, "setpoint", "7").kind(), QPlcMessage::Done);
    m_anna->control.abort();  // what is no longer hers does not go with her
    pass(20ms);
    QCOMPARE(value("setpoint"), QString("7"));
    QCOMPARE(m_master->leases().at(0).isLost, false);
}

void tst_TakeOver::twoHoldersHaveTwoSignals()
{
    QVERIFY(startWithNodes());
    QCOMPARE(take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1"}}}}).kind(), QPlcMessage::Done);
    QCOMPARE(take(*m_bert, {"sum"}, {{"values", QJsonObject{{"sum", "-2"}}}}).kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("echo"), QString("-1"));
    QTRY_COMPARE(value("sum"), QString("-2"));
    m_anna->control.abort();
    QTRY_COMPARE(value("echo"), QString("0"));
    QCOMPARE(value("sum"), QString("-2"));
    QCOMPARE(set(*m_bert, "sum", "-3").kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("sum"), QString("-3"));
    m_master->stop();
}

void tst_TakeOver::signalIsNeutralWhenTheHolderDisconnects()
{
    QVERIFY(startWithNodes());
    take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1"}}}});
    QTRY_COMPARE(value("echo"), QString("-1"));
    m_anna->control.abort();
    QTRY_COMPARE(value("echo"), QString("0"));
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("echo"), QString("0"));  // and its writer does not move it
    QCOMPARE(row("echo").value("lease").toString(), QString("lost"));
    QCOMPARE(row("echo").value("holder").toString(), QString("Anna"));
    QCOMPARE(set(*m_bert, "echo", "1").text("error"), QString("LeaseHeld"));
    m_master->stop();
}

void tst_TakeOver::signalIsNeutralWhenTheHolderIsSilent()
{
    QVERIFY(startWithNodes());
    take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1"}}}, {"timeout", 100e6}});
    QTRY_COMPARE(value("echo"), QString("-1"));
    pass(90ms);
    QCOMPARE(value("echo"), QString("-1"));
    pass(20ms);
    QCOMPARE(value("echo"), QString("0"));
    QCOMPARE(row("echo").value("lease").toString(), QString("lost"));
    QCOMPARE(set(*m_anna, "echo", "1").text("error"), QString("LeaseHeld"));  // she has to take it again
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("echo"), QString("0"));
    m_master->stop();
}

void tst_TakeOver::anyMessageOfTheHolderRenewsTheLease()
{
    take(*m_anna, {"setpoint"}, {{"values", QJsonObject{{"setpoint", "4"}}}, {"timeout", 1e9}});
    for (int i = 0; i < 30; ++i) {
        QCOMPARE(m_anna->ask(QPlcMessage::GetState).kind(), QPlcMessage::State);
        pass(50ms);
    }
    QCOMPARE(value("setpoint"), QString("4"));
    QVERIFY(!m_master->leases().at(0).isLost);
    pass(940ms);  // the last message was 50 ms ago
    QCOMPARE(value("setpoint"), QString("4"));
    pass(20ms);
    QCOMPARE(value("setpoint"), QString("0"));
}

void tst_TakeOver::lostLeaseCanBeReleasedOrReplacedByAnyone()
{
    QVERIFY(startWithNodes());
    take(*m_anna, {"count", "echo"}, {{"values", QJsonObject{{"count", "-1"}, {"echo", "-1"}}}});
    m_anna->control.abort();
    QTRY_COMPARE(value("count"), QString("0"));
    QCOMPARE(take(*m_bert, {"echo"}).kind(), QPlcMessage::Done);  // nobody has it: no takeOver needed
    QVERIFY(waitForSomeCycles());
    QCOMPARE(value("echo"), QString("0"));
    QCOMPARE(release(*m_bert, {"count"}).kind(), QPlcMessage::Done);
    QTRY_VERIFY(value("count").toInt() > 0);
    m_master->stop();
}

void tst_TakeOver::lostLeaseSurvivesStopAndStart()
{
    QVERIFY(startWithNodes());
    take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1"}}}});
    m_master->stop();
    QCOMPARE(value("echo"), QString("-1"));
    QVERIFY(m_master->startRealTime());  // the initial output of the echo is 0.5
    QVERIFY(m_master->waitForCycles(3));
    QCOMPARE(value("echo"), QString("-1"));
    m_anna->control.abort();
    QTRY_COMPARE(value("echo"), QString("0"));
    m_master->stop();
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(3));
    QCOMPARE(value("echo"), QString("0"));
    m_master->stop();
}

void tst_TakeOver::temporaryValuesAreNotRestoredDuringALease()
{
    const QJsonObject values{{"setpoint", "5"}};
    m_bert->ask(QPlcMessage::SetSignals, {{"values", values}, {"duration", 100e6}});
    take(*m_anna, {"setpoint"});
    set(*m_anna, "setpoint", "6");
    pass(150ms);
    QCOMPARE(value("setpoint"), QString("6"));
    // Nor over the neutral value.
    m_anna->ask(QPlcMessage::SetSignals, {{"values", values}, {"duration", 1e15}});
    QCOMPARE(value("setpoint"), QString("5"));
    m_anna->control.abort();
    QTRY_COMPARE(value("setpoint"), QString("0"));
    pass(20ms);
    QCOMPARE(value("setpoint"), QString("0"));
}

/// And not to one that was set before the signal had a writer.
void tst_TakeOver::aLeasedSignalComesBackToTheValueOfItsWriter()
{
    QCOMPARE(set(*m_anna, "count", "-9").kind(), QPlcMessage::Done);
    QVERIFY(startWithNodes());
    QCOMPARE(take(*m_anna, {"count"}).kind(), QPlcMessage::Done);
    QVERIFY(waitForSomeCycles());
    const QString kept = value("count");
    QVERIFY(kept.toInt() > 0);
    const QJsonObject values{{"count", "-1"}};
    QCOMPARE(m_anna->ask(QPlcMessage::SetSignals, {{"values", values}, {"duration", 20e6}}).kind(), QPlcMessage::Done);
    QTRY_COMPARE(value("count"), QString("-1"));
    QTRY_COMPARE(value("count"), kept);
    m_master->stop();
}

void tst_TakeOver::aThousandSignalsAreTakenAtMost()
{
    constexpr int most = 1000;
    QByteArray ini;
    QStringList names;
    for (int i = 0; i <= most; ++i) {
        names << QStringLiteral("s%1").arg(i);
        ini += "[" + names.last().toLatin1() + "]\ntype = Bool\n";
    }
    TestMaster master(QPlcClock::realTime(), QPlcSignalTable::fromIni(ini));
    QVERIFY(master.listen());
    ScriptedTool tool("Carl");
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(take(tool, names).text("error"), QString("WrongState"));
    QVERIFY(master.leases().isEmpty());
    const QString last = names.takeLast();
    QCOMPARE(take(tool, names).kind(), QPlcMessage::Done);
    QCOMPARE(master.leases().size(), most);
    QCOMPARE(take(tool, {last}).text("error"), QString("WrongState"));
    QCOMPARE(take(tool, {names.first()}).kind(), QPlcMessage::Done);  // again
}

void tst_TakeOver::invalidRequestsCreateNoLease_data()
{
    QTest::addColumn<QJsonObject>("fields");
    QTest::addColumn<QString>("error");
    const auto with = [](const char *field, const QJsonValue &value) {
        QJsonObject fields{{"signals", QJsonArray{"free", "setpoint"}}};
        fields.insert(field, value);
        return fields;
    };
    const auto manyTimes = [](const char *name, int count) {
        QJsonArray names;
        for (int i = 0; i < count; ++i)
            names << name;
        return names;
    };
    QTest::newRow("no signals") << QJsonObject() << "MalformedMessage";
    QTest::newRow("an empty list") << with("signals", QJsonArray()) << "MalformedMessage";
    QTest::newRow("a text") << with("signals", "setpoint") << "MalformedMessage";
    QTest::newRow("numbers") << with("signals", QJsonArray{1, 2}) << "MalformedMessage";
    QTest::newRow("more names than signals") << with("signals", manyTimes("free", 100)) << "MalformedMessage";
    QTest::newRow("an unknown one") << with("signals", QJsonArray{"free", "setpiont"}) << "UnknownSignal";
    QTest::newRow("beyond its maximum") << with("values", QJsonObject{{"setpoint", "10.5"}}) << "InvalidValue";
    QTest::newRow("below its minimum") << with("values", QJsonObject{{"setpoint", "-11"}}) << "InvalidValue";
    QTest::newRow("no number") << with("values", QJsonObject{{"setpoint", "x"}}) << "InvalidValue";
    QTest::newRow("not finite") << with("values", QJsonObject{{"free", "nan"}}) << "InvalidValue";
    QTest::newRow("value of another one") << with("values", QJsonObject{{"count", "1"}}) << "MalformedMessage";
    QTest::newRow("value of an unknown one") << with("values", QJsonObject{{"x", "1"}}) << "MalformedMessage";
    QTest::newRow("values are a list") << with("values", QJsonArray{"1"}) << "MalformedMessage";
    QTest::newRow("no time") << with("timeout", 0) << "MalformedMessage";
    QTest::newRow("too short a time") << with("timeout", 9.9e6) << "MalformedMessage";
    QTest::newRow("too long a time") << with("timeout", 3.7e12) << "MalformedMessage";
    QTest::newRow("half a nanosecond") << with("timeout", 1e7 + 0.5) << "MalformedMessage";
    QTest::newRow("time as a text") << with("timeout", "1 s") << "MalformedMessage";
    QTest::newRow("a long name") << with("whoever", QString(65, 'x')) << "MalformedMessage";
    QTest::newRow("a number as name") << with("whoever", 3) << "MalformedMessage";
}

void tst_TakeOver::invalidRequestsCreateNoLease()
{
    QFETCH(QJsonObject, fields);
    QFETCH(QString, error);
    const QPlcMessage refused = m_anna->ask(QPlcMessage::TakeLease, fields);
    QCOMPARE(refused.kind(), QPlcMessage::Failed);
    QCOMPARE(refused.text("error"), error);
    QVERIFY(!refused.text("text").isEmpty());
    QVERIFY(m_master->leases().isEmpty());
    QCOMPARE(value("setpoint"), QString("0"));
    QCOMPARE(take(*m_anna, {"setpoint"}, {{"values", QJsonObject{{"setpoint", "10"}}}}).kind(), QPlcMessage::Done);
    QCOMPARE(set(*m_anna, "setpoint", "10.5").text("error"), QString("InvalidValue"));
}

void tst_TakeOver::releaseOfAnotherHoldersLeaseIsRefused()
{
    take(*m_anna, {"setpoint"});
    take(*m_bert, {"free"});
    const QPlcMessage refused = release(*m_bert, {"free", "setpoint"});
    QCOMPARE(refused.text("error"), QString("LeaseHeld"));
    QCOMPARE(m_master->leases().size(), 2);  // all or none
    QCOMPARE(release(*m_bert, {"nonsense"}).text("error"), QString("UnknownSignal"));
}

void tst_TakeOver::masterSignalsCannotBeLeased()
{
    QVERIFY(m_master->activateJitterMeasurement("jitter"));
    const QPlcMessage refused = take(*m_anna, {"jitter"});
    QCOMPARE(refused.text("error"), QString("SignalHasWriter"));
    take(*m_anna, {"workload"});
    QVERIFY(!m_master->activateWorkloadMeasurement("workload"));
    QVERIFY2(m_master->errorString().contains("'Anna'"), qPrintable(m_master->errorString()));
}

void tst_TakeOver::laterWriterDoesNotEndTheLease()
{
    QVERIFY(m_master->addLocalNode(m_counter.data()));
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(3));
    m_anna->forgetMessages();
    pass(20ms);
    m_anna->forgetMessages();
    take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-1"}}}});
    ScriptedNode late;
    late.initialValues = QPlcValue(9.0).toBytes();
    late.answerAll();
    QVERIFY(late.registerAt(m_master->serverPort()));
    QVERIFY(late.waitForRequests(5));
    QTRY_COMPARE(value("echo"), QString("-1"));
    QVERIFY(late.waitForRequests(late.requests.size() + 5));
    QCOMPARE(value("echo"), QString("-1"));
    m_anna->send(QPlcMessage::ReleaseLease);
    QTRY_COMPARE(value("echo"), QString("9"));
    m_master->stop();
}

void tst_TakeOver::everyReaderSeesTheHeldValueInEveryCycle_data()
{
    QTest::addColumn<QString>("writer");
    QTest::addColumn<QString>("signal");
    QTest::newRow("local") << "local"
                           << "echo";
    QTest::newRow("remote") << "remote"
                            << "echo";
    QTest::newRow("two-phase") << "two-phase"
                               << "sum";
}

void tst_TakeOver::everyReaderSeesTheHeldValueInEveryCycle()
{
    QFETCH(QString, writer);
    QFETCH(QString, signal);
    TestMaster master;  // lockstep: every cycle has all answers
    QVERIFY(master.listen());
    master.setCycleLimit(50);
    Adder local("Writer", "setpoint", "echo", QPlcInputTiming::LastCycle);
    Integrator twoPhase;
    ScriptedNode remote("Writer");
    remote.inputs = QStringList{"setpoint"};
    remote.initialValues = QPlcValue(9.0).toBytes();
    remote.answerAll();
    const QByteArray name = signal.toLatin1();
    Adder sameCycle("Same", name.constData(), "masterWorkload", QPlcInputTiming::SameCycle);
    Adder lastCycle("Last", name.constData(), "setpoint", QPlcInputTiming::LastCycle);
    QVector<double> seen;
    sameCycle.onStep = lastCycle.onStep = [&seen](const QPlcCycle &, double in) { seen << in; };
    if (writer == "remote")
        QVERIFY(remote.registerAt(master.serverPort()));
    else
        QVERIFY(master.addLocalNode(writer == "local" ? static_cast<QPlcSlaveNode *>(&local) : &twoPhase));
    QVERIFY(master.addLocalNode(&sameCycle) && master.addLocalNode(&lastCycle));
    ScriptedTool anna("Anna");
    QVERIFY(anna.greetAt(master.serverPort()));
    QCOMPARE(take(anna, {signal}, {{"values", QJsonObject{{signal, "-3"}}}}).kind(), QPlcMessage::Done);
    QVERIFY(master.startRealTime());
    QVERIFY(master.waitForState(QPlcMasterNode::Off) && master.statistics().cycles == 50);
    QCOMPARE(seen, QVector<double>(100, -3.0));
    QCOMPARE(master.signalValue("masterWorkload").toReal(), -2.0);
}

void tst_TakeOver::listenerReceivesOnlyTheLeasedValue()
{
    QVERIFY(m_master->addLocalNode(m_counter.data()) && m_master->addLocalNode(m_echo.data()));
    ScriptedNode listener("Listener");
    listener.onlyListen();
    listener.inputs = QStringList{"echo"};
    QVERIFY(listener.registerAt(m_master->serverPort()));
    QVERIFY(m_master->startRealTime());
    QVERIFY(listener.waitForRequests(5));
    m_anna->forgetMessages();
    take(*m_anna, {"echo"}, {{"values", QJsonObject{{"echo", "-3"}}}});
    QTRY_COMPARE(value("echo"), QString("-3"));
    QVERIFY(listener.waitForRequests(listener.requests.size() + 20));
    m_master->stop();
    QVector<double> heard;
    for (const ScriptedNode::Request &request : listener.requests)
        heard << QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), request.payload.constData()).toReal();
    const int begin = heard.indexOf(-3.0);
    QVERIFY(begin > 0);
    QVERIFY(heard.at(begin - 1) > 0.0);
    QCOMPARE(heard.mid(begin), QVector<double>(heard.size() - begin, -3.0));
}

void tst_TakeOver::releasedLeaseLeavesResultsIdentical()
{
    quint64 digests[2];
    for (const bool isTaken : {false, true}) {
        TestMaster master;
        CounterNode counter;
        EchoNode echo;
        QVERIFY(master.listen());
        QVERIFY(master.addLocalNode(&counter) && master.addLocalNode(&echo));
        ScriptedTool anna("Anna");
        QVERIFY(anna.greetAt(master.serverPort()));
        if (isTaken) {
            QCOMPARE(take(anna, {"count", "echo"}).kind(), QPlcMessage::Done);
            QCOMPARE(release(anna, {"count", "echo"}).kind(), QPlcMessage::Done);
        }
        master.setCycleLimit(1000);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForState(QPlcMasterNode::Off));
        digests[isTaken] = master.statistics().imageDigest;
    }
    QCOMPARE(digests[0], digests[1]);
}

void tst_TakeOver::leaseChangesArePushedToToolsWithTheFeature()
{
    ScriptedTool viewer("Viewer");
    QVERIFY(viewer.connectTo(m_master->serverPort()));
    QJsonObject hello = viewer.helloFields();
    hello.insert("features", QJsonArray{"leases", "nonsense"});
    viewer.send(QPlcMessage::Hello, hello);
    QCOMPARE(viewer.next().fields().value("features").toArray(), QJsonArray{"leases"});
    take(*m_anna, {"setpoint"});
    QPlcMessage shown = viewer.next();
    QCOMPARE(shown.kind(), QPlcMessage::LeasesChanged);
    const QJsonObject lease{{"signal", "setpoint"}, {"holder", "Anna"}, {"lease", "held"}, {"timeout", 3.6e12}};
    QCOMPARE(shown.fields().value("leases").toArray(), QJsonArray{lease});
    QCOMPARE(m_bert->ask(QPlcMessage::GetLeases), QPlcMessage(QPlcMessage::Leases, shown.fields()));
    for (int i = 0; i < 20; ++i) {  // together: at most one picture of all in a while
        m_bert->ask(QPlcMessage::TakeLease, {{"signals", QJsonArray{"free"}}});
        m_bert->ask(QPlcMessage::ReleaseLease);
    }
    m_anna->control.abort();
    QTRY_COMPARE(viewer.messages.last().fields().value("leases").toArray().at(0).toObject().value("lease").toString(),
                 QString("lost"));
    QCOMPARE(viewer.messages.size(), 3);
    QVERIFY(m_bert->messages.last().kind() == QPlcMessage::Done);  // without the feature: nothing
}

QTPLC_VIRTUAL_TIME_MAIN(tst_TakeOver)
#include "tst_TakeOver.moc"
