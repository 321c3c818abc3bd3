// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "transport/ControlNetwork.h"
#include "transport/Tls.h"

#include <QtNetwork/QTcpServer>

// What a tool may ask, and set.
class tst_ControlChannel : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stateTellsWhenCycleZeroBegan();
    void init();
    void getStateTellsEverything();
    void getSignalsTellsAllOrSome();
    void getSignalsRefusesRepeatedNames();
    void getSignalsRefusesInvalidNameLists();
    void setSignalsAcceptsTheFormatOfGetSignals();
    void setSignalsSetsAllOrNone_data();
    void setSignalsSetsAllOrNone();
    void setSignalsDuringCyclesIsLimitedInSize();
    void anAnswerThatIsTooLongIsRefused();
    void answersComeInTheOrderOfTheRequests();
    void sequenceIsAnsweredAtItsEndAndOthersImmediately();
    void unknownFieldsAreIgnored();
    void aTlsSocketIsNotSecuredBeforeItsHandshake();
    void bytesThatAreNoMessageEndTheConnection();

private:
    bool start()
    {
        const bool started = m_master->startRealTime() && m_tool->waitForMessage(QPlcMessage::StatesInitialized);
        m_tool->forgetMessages();
        return started && m_master->waitForState(QPlcMasterNode::RealTime);
    }
    QPlcMessage set(const QJsonObject &values) { return m_tool->ask(QPlcMessage::SetSignals, {{"values", values}}); }
    QScopedPointer<TestMaster> m_master;
    QScopedPointer<CounterNode> m_counter;
    QScopedPointer<ScriptedTool> m_tool;
};

void tst_ControlChannel::init()
{
    m_tool.reset();
    m_master.reset(new TestMaster);
    m_counter.reset(new CounterNode);
    QVERIFY(m_master->addLocalNode(m_counter.data()));
    QVERIFY(m_master->setTimeSignal("time"));
    QVERIFY(m_master->listen());
    m_tool.reset(new ScriptedTool);
    QVERIFY(m_tool->greetAt(m_master->serverPort()));
}

void tst_ControlChannel::getStateTellsEverything()
{
    ScriptedNode node;
    node.listener = true;
    QVERIFY(node.registerAt(m_master->serverPort()));
    m_master->setCycleLimit(10);
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(10));
    QVERIFY(m_master->waitForState(QPlcMasterNode::Off));
    m_tool->forgetMessages();
    const QPlcMessage state = m_tool->ask(QPlcMessage::GetState);
    QCOMPARE(state.kind(), QPlcMessage::State);
    QCOMPARE(state.text("state"), QString("Off"));
    QCOMPARE(state.hex64("cycle"), quint64(9));
    QCOMPARE(state.text("clock"), QString("Lockstep"));
    QCOMPARE(state.fields().value("period").toDouble(), 10e6);
    QCOMPARE(state.hex64("session"), node.session);
    QCOMPARE(state.hex64("digest"), m_master->statistics().imageDigest);
    QCOMPARE(state.fields().value("counters").toObject().value("cycles").toInt(), 10);
    const QJsonArray nodes = state.fields().value("nodes").toArray();
    QCOMPARE(nodes.size(), 2);
    QCOMPARE(nodes.at(0).toObject().value("transport").toString(), QString("inprocess"));
    QCOMPARE(nodes.at(0).toObject().value("outputs").toInt(), 2);
    const QJsonObject remote = nodes.at(1).toObject();
    QCOMPARE(remote.value("name").toString(), QString("Scripted"));
    QCOMPARE(remote.value("transport").toString(), QString("udp"));
    QCOMPARE(remote.value("listener").toBool(), true);
    QCOMPARE(remote.value("policy").toString(), QString("ErrorZeroOrderHold"));
    QCOMPARE(remote.value("id").toInt(), node.registered.fields().value("node").toInt());
}

void tst_ControlChannel::getSignalsTellsAllOrSome()
{
    const QJsonArray all = m_tool->ask(QPlcMessage::GetSignals).fields().value("signals").toArray();
    QCOMPARE(all.size(), testTable().size());
    QCOMPARE(all.at(0).toObject().value("name").toString(), QString("time"));
    QCOMPARE(all.at(0).toObject().value("writer").toString(), QString("Master"));
    const QJsonArray some = m_tool->ask(QPlcMessage::GetSignals, {{"names", QJsonArray{"sum", "count"}}})
                                .fields()
                                .value("signals")
                                .toArray();
    QCOMPARE(some.size(), 2);
    QCOMPARE(some.at(0).toObject(),
             (QJsonObject{{"name", "sum"},
                          {"type", "Real64"},
                          {"unit", "m"},
                          {"description", ""},
                          {"value", "0"},
                          {"writer", "Counter"},
                          {"quality", QPlcQuality(QPlcQuality::Invalid).toByte()}}));
    QCOMPARE(some.at(1).toObject().value("value").toString(), QString("7"));
    const QPlcMessage failed = m_tool->ask(QPlcMessage::GetSignals, {{"names", QJsonArray{"sum", "setpiont"}}});
    QCOMPARE(failed.text("error"), QString("UnknownSignal"));
    QVERIFY2(failed.text("text").contains("'setpoint'"), qPrintable(failed.text("text")));
}

/// A short question has no endless answer.
void tst_ControlChannel::getSignalsRefusesRepeatedNames()
{
    const QPlcMessage twice = m_tool->ask(QPlcMessage::GetSignals, {{"names", QJsonArray{"sum", "count", "sum"}}});
    QCOMPARE(twice.text("error"), QString("MalformedMessage"));
    QCOMPARE(twice.text("text"), QString("'sum' is named twice; name each signal once"));
    QJsonArray names;
    for (int i = 0; i <= testTable().size(); ++i)
        names << QString("unknown%1").arg(i);
    const QPlcMessage tooMany = m_tool->ask(QPlcMessage::GetSignals, {{"names", names}});
    QCOMPARE(tooMany.text("error"), QString("MalformedMessage"));
    QVERIFY2(tooMany.text("text").contains("the table has 10 signals"), qPrintable(tooMany.text("text")));
    names.removeLast();
    QCOMPARE(m_tool->ask(QPlcMessage::GetSignals, {{"names", names}}).text("error"), QString("UnknownSignal"));
}

/// What cannot be read is no wish for all signals.
void tst_ControlChannel::getSignalsRefusesInvalidNameLists()
{
    for (const QJsonValue &names : {QJsonValue(3), QJsonValue("sum"), QJsonValue(QJsonArray{"sum", 3})}) {
        const QPlcMessage failed = m_tool->ask(QPlcMessage::GetSignals, {{"names", names}});
        QCOMPARE(failed.text("error"), QString("MalformedMessage"));
        QCOMPARE(failed.text("text"), QString("field 'names' is missing or not of type array"));
    }
}

void tst_ControlChannel::setSignalsAcceptsTheFormatOfGetSignals()
{
    for (bool running : {false, true}) {
        QVERIFY(!running || start());
        QCOMPARE(set({{"setpoint", running ? "-0.1" : "1e-3"}, {"vector", "1, 2, 3.5"}, {"free", "0.1"}}).kind(),
                 QPlcMessage::Done);
        QTRY_COMPARE(m_master->signalValue("setpoint").toString(), QString(running ? "-0.1" : "0.001"));
        QCOMPARE(m_master->signalValue("vector").toString(), QString("1, 2, 3.5"));
        QCOMPARE(m_master->signalValue("free").toString(), QString("0.1"));
    }
    m_master->stop();
}

void tst_ControlChannel::setSignalsSetsAllOrNone_data()
{
    QTest::addColumn<QJsonValue>("values");
    QTest::addColumn<QString>("error");
    QTest::addColumn<QString>("word");
    const auto with = [](const char *name, const QJsonValue &value) {
        return QJsonValue(QJsonObject{{"free", "5"}, {name, value}});
    };
    QTest::newRow("unknown") << with("zzz", "1") << "UnknownSignal"
                             << "'zzz'";
    QTest::newRow("written by a node") << with("sum", "1") << "SignalHasWriter"
                                       << "'Counter'";
    QTest::newRow("written by the master") << with("time", "2026-01-01T00:00:00Z") << "SignalHasWriter"
                                           << "'Master'";
    QTest::newRow("above the maximum") << with("setpoint", "10.5") << "InvalidValue"
                                       << "-10 ... 10 m/s";
    QTest::newRow("below the minimum") << with("setpoint", "-11") << "InvalidValue"
                                       << "'setpoint'";
    QTest::newRow("no number") << with("setpoint", "fast") << "InvalidValue"
                               << "'setpoint'";
    QTest::newRow("not a number") << with("setpoint", "nan") << "InvalidValue"
                                  << "'setpoint'";
    QTest::newRow("a number instead of a text") << with("setpoint", 1.0) << "MalformedMessage"
                                                << "'values'";
    QTest::newRow("too many elements") << with("vector", "1, 2, 3, 4") << "InvalidValue"
                                       << "'vector'";
    QTest::newRow("no object") << QJsonValue("free") << "MalformedMessage"
                               << "'values'";
    QTest::newRow("nothing") << QJsonValue() << "MalformedMessage"
                             << "'values'";
}

void tst_ControlChannel::setSignalsSetsAllOrNone()
{
    QFETCH(QJsonValue, values);
    QFETCH(QString, error);
    QFETCH(QString, word);
    QSignalSpy errors(m_master.data(), &QPlcMasterNode::errorOccurred);
    for (bool running : {false, true}) {
        QVERIFY(!running || start());
        const QPlcMessage failed = m_tool->ask(QPlcMessage::SetSignals, {{"values", values}});
        QCOMPARE(failed.kind(), QPlcMessage::Failed);
        QCOMPARE(failed.text("error"), error);
        QVERIFY2(failed.text("text").contains(word), qPrintable(failed.text("text")));
        const quint64 cycles = m_master->statistics().cycles;
        QVERIFY(!running || m_master->waitForCycles(cycles + 2));
        QCOMPARE(m_master->signalValue("free").toReal(), 0.0);
    }
    QCOMPARE(errors.size(), 0);  // a tool's mistake is no error of the plant
    m_master->stop();
}

void tst_ControlChannel::setSignalsDuringCyclesIsLimitedInSize()
{
    QByteArray ini = "[gate]\ntype = Int32\n";
    QJsonObject many;
    for (int i = 0; i < 300; ++i) {
        ini += "[s" + QByteArray::number(i) + "]\ntype = Int32\n";
        many.insert(QString("s%1").arg(i), "1");
    }
    TestMaster master(QPlcClock::realTime(), QPlcSignalTable::fromIni(ini));
    master.setInterval(0.001);
    QVERIFY(master.listen());
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::SetSignals, {{"values", many}}).kind(),
             QPlcMessage::Done);  // while off there is no limit
    QVERIFY(master.startRealTime());
    QCOMPARE(tool.next().kind(), QPlcMessage::StatesInitialized);
    for (const QString &name : many.keys())
        many.insert(name, "2");
    const QPlcMessage failed = tool.ask(QPlcMessage::SetSignals, {{"values", many}});
    QCOMPARE(failed.text("error"), QString("WrongState"));
    QVERIFY2(failed.text("text").contains("300"), qPrintable(failed.text("text")));
    QVERIFY(master.waitForCycles(3));
    QCOMPARE(master.signalValue("s0").toInt(), 1);
    for (int i = 200; i < 300; ++i)
        many.remove(QString("s%1").arg(i));
    for (int round = 0; round < 5; ++round) {  // as often as one likes, when the cycles can follow
        QVERIFY(master.waitForCycles(master.statistics().cycles + 2));
        QCOMPARE(tool.ask(QPlcMessage::SetSignals, {{"values", many}}).kind(), QPlcMessage::Done);
    }
    QTRY_COMPARE(master.signalValue("s199").toInt(), 2);
    QCOMPARE(master.signalValue("s200").toInt(), 1);
    master.stop();
}

void tst_ControlChannel::anAnswerThatIsTooLongIsRefused()
{
    QByteArray ini;
    for (int i = 0; i < 400; ++i)
        ini += "[s" + QByteArray::number(i) + "]\ntype = Real64[180]\n";
    TestMaster master(QPlcClock::lockstep(), QPlcSignalTable::fromIni(ini));
    QVERIFY(master.listen());
    for (int i = 0; i < 400; ++i)
        QVERIFY(master.setSignalValue(QString("s%1").arg(i), 0.123456789012345678));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QCOMPARE(tool.ask(QPlcMessage::GetSignals).text("error"), QString("TooLong"));
    QCOMPARE(tool.ask(QPlcMessage::GetSignals, {{"names", QJsonArray{"s399"}}}).kind(), QPlcMessage::Signals);
}

void tst_ControlChannel::answersComeInTheOrderOfTheRequests()
{
    for (int i = 0; i < 50; ++i) {
        m_tool->send(QPlcMessage::GetState);
        m_tool->send(QPlcMessage::GetSignals, {{"names", QJsonArray{"free"}}});
        m_tool->send(QPlcMessage::SetSignals, {{"values", QJsonObject{{"free", QString::number(i)}}}});
    }
    for (int i = 0; i < 50; ++i) {
        QCOMPARE(m_tool->next().kind(), QPlcMessage::State);
        const QPlcMessage values = m_tool->next();
        QCOMPARE(values.fields().value("signals").toArray().at(0).toObject().value("value").toString(),
                 QString::number(i == 0 ? 0 : i - 1));
        QCOMPARE(m_tool->next().kind(), QPlcMessage::Done);
    }
}

void tst_ControlChannel::sequenceIsAnsweredAtItsEndAndOthersImmediately()
{
    ScriptedNode slow;
    slow.playsAlong = false;
    QVERIFY(slow.registerAt(m_master->serverPort()));
    m_tool->forgetMessages();
    m_tool->send(QPlcMessage::InitializeAllStates);
    QCOMPARE(m_tool->ask(QPlcMessage::GetState).text("state"), QString("Initializing"));
    QCOMPARE(m_tool->ask(QPlcMessage::GetSchedule).kind(), QPlcMessage::Schedule);
    slow.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(slow.initialValues)}});
    slow.send(QPlcMessage::Initialized);
    QVERIFY(m_tool->waitForMessage(QPlcMessage::Done));
    QCOMPARE(m_master->state(), QPlcMasterNode::Ready);
}

void tst_ControlChannel::unknownFieldsAreIgnored()
{
    QCOMPARE(m_tool->ask(QPlcMessage::GetState, {{"colour", "blue"}, {"nested", QJsonObject{{"a", QJsonArray{1, 2}}}}})
                 .kind(),
             QPlcMessage::State);
}

/// The cyclic connection of a node comes to a secured master without TLS.
void tst_ControlChannel::aTlsSocketIsNotSecuredBeforeItsHandshake()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    QTcpSocket *plain = qplc::ControlNetwork::current().makeTls(nullptr)->socket();
    plain->connectToHost(QHostAddress(QHostAddress::LocalHost), server.serverPort());
    QVERIFY(plain->waitForConnected());
    const QPlcSlaveSocket socket(plain);
    QVERIFY(socket.isConnected());
    QVERIFY(!socket.isSecured());
}

/// Of a socket that a program reads itself.
void tst_ControlChannel::bytesThatAreNoMessageEndTheConnection()
{
    QTcpServer server;
    QVERIFY(server.listen(QHostAddress::LocalHost));
    QPlcMasterSocket socket;
    socket.setSecurity(QPlcSecurity());
    QSignalSpy failed(&socket, &QPlcAbstractSocket::errorOccurred);
    socket.connectToMaster(
        QPlcUnderlyingProtocol::fromString(QStringLiteral("tcp://127.0.0.1:%1").arg(server.serverPort())));
    QVERIFY(server.waitForNewConnection(5000));
    QTRY_VERIFY(socket.isConnected());
    server.nextPendingConnection()->write(QByteArray(64, '\xff'));
    QTRY_COMPARE(failed.size(), 1);
    QCOMPARE(socket.error(), QPlcAbstractSocket::ProtocolError);
    QVERIFY(!socket.isConnected());
}

void tst_ControlChannel::stateTellsWhenCycleZeroBegan()
{
    for (const QPlcClock &clock : {QPlcClock::realTime(), QPlcClock::lockstep()}) {
        TestMaster master(clock);
        QVERIFY(master.setTimeSignal("time"));
        QVERIFY(master.listen());
        ScriptedTool tool;
        QVERIFY(tool.greetAt(master.serverPort()));
        QVERIFY(!tool.ask(QPlcMessage::GetState).fields().contains("cycleZeroTime"));  // no phase yet
        master.setCycleLimit(3);
        QVERIFY(master.startRealTime());
        QVERIFY(master.waitForCycles(3) && master.waitForState(QPlcMasterNode::Off));
        const QPlcMessage state = tool.answerTo(QPlcMessage::GetState);
        QCOMPARE(state.fields().contains("cycleZeroTime"), !clock.isLockstep());
        if (!clock.isLockstep())
            QCOMPARE(qint64(state.hex64("cycleZeroTime")) + 2 * 10'000'000, master.signalValue("time").toInt64());
    }
}

QTEST_GUILESS_MAIN(tst_ControlChannel)
#include "tst_ControlChannel.moc"
