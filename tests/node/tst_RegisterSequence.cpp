// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "signals/Fnv1a.h"

// Figure 4.14 of the thesis: server start of the master, connection and registration of a slave.
class tst_RegisterSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void slaveReportsAClosedPort();  // first: no socket has registered the types of signals yet
    void masterAnswersANodeStepByStep();
    void masterAttachesATcpChannelByItsToken();
    void masterSendsItsTableOnlyWhenItDiffers();
    void slaveSpeaksStepByStep_data();
    void slaveSpeaksStepByStep();
    void slaveAdoptsTheTableOfTheMaster();
    void slaveRegistersOnlyWithEqualLayouts();
    void slaveRefusesAnotherProtocolVersion();
    void slaveReportsARejection();
    void slaveWaitsNoLongerThanItsTimeout();
    void slaveWithAWrongDeclarationDoesNotRegister();
    void slaveIgnoresMessagesOutOfTurn();
    void earlyRequestEndsWithItsConnection();
    void slaveSendsMessagesOfItsProgram();
    void namesAndWritersAreFreeAfterALeave();
    void returningNodeReplacesItsOldConnection();
};

void tst_RegisterSequence::masterAnswersANodeStepByStep()
{
    TestMaster master;
    QSignalSpy registered(&master, &QPlcMasterNode::nodeRegistered);
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    ScriptedNode node;
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    const QPlcMessage hello = node.next();
    QCOMPARE(hello.kind(), QPlcMessage::Hello);
    QCOMPARE(hello.fields().value("protocol").toInt(), 2);
    QCOMPARE(hello.text("name"), QString("Master"));
    QCOMPARE(hello.text("state"), QString("Off"));
    QVERIFY(!QUuid(hello.text("uuid")).isNull());
    QVERIFY(hello.hex64("session") != 0);
    QCOMPARE(hello.hex64("tableHash"), testTable().hash());
    QCOMPARE(hello.fields().value("period").toDouble(), 10e6);
    QCOMPARE(QPlcSignalTable::fromIni(hello.text("table").toUtf8()).hash(), testTable().hash());

    node.send(QPlcMessage::Register, node.registerFields());
    const QPlcMessage answer = node.next();
    QCOMPARE(answer.kind(), QPlcMessage::Registered);
    QVERIFY(answer.fields().value("node").toInt() > 0);
    QCOMPARE(answer.text("state"), QString("Off"));
    QCOMPARE(answer.hex64("inputsHash"), qplc::PayloadLayout(testTable(), indicesOf(testTable(), node.inputs)).hash());
    QCOMPARE(answer.hex64("outputsHash"),
             qplc::PayloadLayout(testTable(), indicesOf(testTable(), node.outputs)).hash());
    QCOMPARE(node.next().kind(), QPlcMessage::CyclicChannelAttached);
    QCOMPARE(node.messages.size(), 3);
    QCOMPARE(registered.size(), 1);
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(master.nodes().at(0).name, QString("Scripted"));
    QCOMPARE(master.nodes().at(0).transport, QString("udp"));
    QCOMPARE(master.nodes().at(0).policy, QString("ErrorZeroOrderHold"));
    QCOMPARE(master.writer("echo"), QString("Scripted"));
}

void tst_RegisterSequence::masterAttachesATcpChannelByItsToken()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.cyclic = "tcp";
    QVERIFY(node.connectTo(master.serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    node.session = node.next().hex64("session");
    node.send(QPlcMessage::Register, node.registerFields());
    QVERIFY(node.takeRegistered(node.next()));
    QVERIFY(master.nodes().isEmpty());  // its cyclic channel is not there yet
    QVERIFY(node.attach());
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(master.nodes().at(0).transport, QString("tcp"));
    QCOMPARE(node.messages.size(), 2);  // the answer came on the other connection
}

void tst_RegisterSequence::masterSendsItsTableOnlyWhenItDiffers()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    QVERIFY(node.connectTo(master.serverPort()));
    QJsonObject fields = node.helloFields();
    fields.insert("tableHash", QPlcMessage::fromHex64(testTable().hash()));
    node.send(QPlcMessage::Hello, fields);
    QVERIFY(!node.next().fields().contains("table"));
}

void tst_RegisterSequence::slaveSpeaksStepByStep_data()
{
    QTest::addColumn<bool>("udp");
    QTest::newRow("udp") << true;
    QTest::newRow("tcp") << false;
}

void tst_RegisterSequence::slaveSpeaksStepByStep()
{
    QFETCH(bool, udp);
    ScriptedMaster master;
    CounterNode node("Counter", QPlcSlaveNode::SilentWait);
    node.setSignalTable(testTable());
    QSignalSpy connected(&node, &QPlcSlaveNode::connectedToMaster);
    node.connectToMaster(udp ? master.udp() : master.tcp());
    QCOMPARE(node.state(), QPlcSlaveNode::Connecting);

    const QPlcMessage hello = master.next();
    QCOMPARE(hello.kind(), QPlcMessage::Hello);
    QCOMPARE(hello.text("name"), QString("Counter"));
    QCOMPARE(hello.text("role"), QString("node"));
    QCOMPARE(hello.hex64("tableHash"), testTable().hash());
    QVERIFY(!QUuid(hello.text("uuid")).isNull());
    master.send(QPlcMessage::Hello, master.helloFields());

    const QPlcMessage request = master.next();
    QCOMPARE(request.kind(), QPlcMessage::Register);
    QCOMPARE(request.text("policy"), QString("SilentWait"));
    QCOMPARE(request.text("cyclic"), QString(udp ? "udp" : "tcp"));
    QCOMPARE(request.fields().value("listener").toBool(true), false);
    const QJsonObject input = request.fields().value("inputs").toArray().at(0).toObject();
    const quint64 safety = qplc::fnv1a64(QByteArrayLiteral(":::1000:::\n"));
    QCOMPARE(
        input,
        (QJsonObject{{"name", "echo"}, {"type", "Real64"}, {"unit", ""}, {"safety", QPlcMessage::fromHex64(safety)}}));
    QCOMPARE(request.fields().value("outputs").toArray().size(), 2);
    QCOMPARE(request.fields().value("udpPort").toInt() > 0, udp);
    QCOMPARE(node.state(), QPlcSlaveNode::Registering);
    master.send(QPlcMessage::Registered, master.registeredFields(request));

    if (udp) {
        master.send(QPlcMessage::CyclicChannelAttached);
    } else {
        const QPlcMessage attach = master.next();
        QCOMPARE(attach.kind(), QPlcMessage::AttachCyclicChannel);
        QCOMPARE(attach.hex64("token"), ScriptedMaster::Token);
        QCOMPARE(attach.fields().value("node").toInt(), ScriptedMaster::Node);
    }
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    QCOMPARE(connected.size(), 1);
    QCOMPARE(node.error(), QPlcSlaveNode::NoError);
    QCOMPARE(master.next(0).kind(), QPlcMessage::Invalid);  // nothing else was said
}

void tst_RegisterSequence::slaveAdoptsTheTableOfTheMaster()
{
    QPlcSignalIndexTable::setCurrent({});
    ScriptedMaster master;
    CounterNode node;
    QVERIFY(master.admit(node, master.udp()));
    QVERIFY(!master.messages.at(0).fields().contains("tableHash"));
    QCOMPARE(node.signalTable().hash(), testTable().hash());
    QPlcSignalIndexTable::setCurrent({});
}

void tst_RegisterSequence::slaveRegistersOnlyWithEqualLayouts()
{
    ScriptedMaster master;
    CounterNode node;
    node.setSignalTable(testTable());
    node.connectToMaster(master.udp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Hello, master.helloFields());
    QJsonObject fields = master.registeredFields(master.next());
    fields.insert("outputsHash", QPlcMessage::fromHex64(1));
    master.send(QPlcMessage::Registered, fields);
    QTRY_COMPARE(node.error(), QPlcSlaveNode::ProtocolError);
    QVERIFY2(node.errorString().contains("layout"), qPrintable(node.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Rejected);
}

void tst_RegisterSequence::slaveRefusesAnotherProtocolVersion()
{
    ScriptedMaster master;
    CounterNode node;
    node.connectToMaster(master.tcp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    QJsonObject fields = master.helloFields();
    fields.insert("protocol", 3);
    master.send(QPlcMessage::Hello, fields);
    QTRY_COMPARE(node.error(), QPlcSlaveNode::ProtocolError);
    QVERIFY2(node.errorString().contains("version 3"), qPrintable(node.errorString()));
}

void tst_RegisterSequence::slaveReportsARejection()
{
    ScriptedMaster master;
    CounterNode node;
    QSignalSpy errors(&node, &QPlcSlaveNode::errorOccurred);
    node.connectToMaster(master.tcp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Rejected, {{"error", "TooManyNodes"}, {"text", "the house is full\x1b[2J"}});
    QTRY_COMPARE(node.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(node.errorString().contains("the house is full?[2J"), qPrintable(node.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Rejected);
    QCOMPARE(errors.size(), 1);
}

void tst_RegisterSequence::slaveReportsAClosedPort()
{
    quint16 port = 0;
    {
        QTcpServer server;
        QVERIFY(server.listen(QHostAddress::LocalHost, 0));
        port = server.serverPort();
    }
    CounterNode node;
    QSignalSpy errors(&node, &QPlcSlaveNode::errorWithMaster);
    QVERIFY(!node.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port)));
    QCOMPARE(node.error(), QPlcSlaveNode::ConnectionError);
    QVERIFY2(node.errorString().contains(QString::number(port)), qPrintable(node.errorString()));
    QCOMPARE(errors.size(), 1);
    QCOMPARE(errors.at(0).at(0).value<QPlcAbstractSocket::Error>(), QPlcAbstractSocket::ConnectionRefusedError);
    QVERIFY(!node.connectToMasterAndWaitForConnected({}));
    QCOMPARE(node.error(), QPlcSlaveNode::OptionError);
}

void tst_RegisterSequence::slaveWaitsNoLongerThanItsTimeout()
{
    ScriptedMaster mute;  // accepts, and says nothing
    CounterNode node;
    QVERIFY(!node.connectToMasterAndWaitForConnected(mute.tcp(), std::chrono::milliseconds(50)));
    QCOMPARE(node.state(), QPlcSlaveNode::Disconnected);
    QVERIFY2(node.errorString().contains("50 ms"), qPrintable(node.errorString()));
}

void tst_RegisterSequence::slaveWithAWrongDeclarationDoesNotRegister()
{
    class Wrong : public QPlcCompactSlaveNode
    {
    public:
        Wrong()
            : QPlcCompactSlaveNode("Wrong")
        {
        }
        QPlcInput<double> m_unknown{this, "ehco"};
        QPlcOutput<double> m_notReal{this, "count"};
    } node;
    ScriptedMaster master;
    node.connectToMaster(master.tcp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Hello, master.helloFields());
    QTRY_COMPARE(node.error(), QPlcSlaveNode::SignalError);
    QVERIFY2(node.errorString().contains("'echo'"), qPrintable(node.errorString()));   // the close name
    QVERIFY2(node.errorString().contains("'count'"), qPrintable(node.errorString()));  // and the second mismatch
    QCOMPARE(master.messages.size(), 1);
    QPlcSignalIndexTable::setCurrent({});
}

void tst_RegisterSequence::slaveSendsMessagesOfItsProgram()
{
    ScriptedMaster master;
    CounterNode node;
    node.sendMessageToMaster(QPlcMessage(QPlcMessage::GetStatistics));  // it has none
    QVERIFY(master.admit(node, master.udp()));
    node.sendMessageToMaster(QPlcMessage(QPlcMessage::GetSchedule));
    QCOMPARE(master.next().kind(), QPlcMessage::GetSchedule);
}

void tst_RegisterSequence::slaveIgnoresMessagesOutOfTurn()
{
    ScriptedMaster master;
    QPlcIOSlaveNode node("Early");
    node.setSignalTable(testTable());
    node.connectToMaster(master.udp());
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    LogCapture log;
    for (QPlcMessage::Kind kind :
         {QPlcMessage::Registered, QPlcMessage::CyclicChannelAttached, QPlcMessage::SendYourInitialOutputStates,
          QPlcMessage::InitializeWithValues, QPlcMessage::RealTimeStarted, QPlcMessage::RealTimeStopped})
        master.send(kind);
    master.send(QPlcMessage::Hello, master.helloFields());
    const QPlcMessage request = master.next();
    QCOMPARE(request.kind(), QPlcMessage::Register);
    QCOMPARE(log.matching("ignores").size(), 5);
    master.send(QPlcMessage::Registered, master.registeredFields(request));
    master.send(QPlcMessage::CyclicChannelAttached);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    QVERIFY(master.start());
    master.send(QPlcMessage::Hello, master.helloFields());  // must not bind the ports while cycles run
    master.send(QPlcMessage::SendYourInitialOutputStates);  // nor reset the node
    master.request(0);
    QVERIFY(master.waitForAnswers(1));
    QTRY_COMPARE(log.matching("ignores").size(), 7);
    QCOMPARE(node.state(), QPlcSlaveNode::RealTime);
}

/// The control connection is lost before the cyclic one is there.
void tst_RegisterSequence::earlyRequestEndsWithItsConnection()
{
    ScriptedMaster lost;
    CounterNode node;
    node.connectToMaster(lost.tcp());
    QCOMPARE(lost.next().kind(), QPlcMessage::Hello);
    lost.send(QPlcMessage::Hello, lost.helloFields());
    lost.send(QPlcMessage::Registered, lost.registeredFields(lost.next()));
    lost.send(QPlcMessage::SendYourInitialOutputStates);
    lost.control->abort();
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Disconnected);
    ScriptedMaster other;
    QVERIFY(other.admit(node, other.tcp()));
    QCOMPARE(other.next(0).kind(), QPlcMessage::Invalid);  // it did not ask for outputs
}

void tst_RegisterSequence::namesAndWritersAreFreeAfterALeave()
{
    TestMaster master;
    QVERIFY(master.listen());
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    for (int round = 0; round < 5; ++round) {
        EchoNode node;
        QVERIFY2(node.connectToMasterAndWaitForConnected(master.protocol(round % 2 ? "udp" : "tcp")),
                 qPrintable(node.errorString()));
        QCOMPARE(master.writer("echo"), QString("Echo"));
        node.disconnectFromMaster();
        QTRY_COMPARE(lost.size(), round + 1);
        QCOMPARE(master.writer("echo"), QString());
        QVERIFY(master.nodes().isEmpty());
    }
}

void tst_RegisterSequence::returningNodeReplacesItsOldConnection()
{
    TestMaster master;
    QVERIFY(master.listen());
    QSignalSpy lost(&master, &QPlcMasterNode::nodeLost);
    ScriptedNode before;
    QVERIFY(before.registerAt(master.serverPort()));
    ScriptedNode after;
    after.uuid = before.uuid;  // the same node on a new connection, while the old one looks alive
    QVERIFY(after.registerAt(master.serverPort()));
    QCOMPARE(lost.size(), 1);
    QTRY_VERIFY(!before.control.isConnected());
    QCOMPARE(master.nodes().size(), 1);
    QCOMPARE(master.writer("echo"), QString("Scripted"));
}

QTEST_GUILESS_MAIN(tst_RegisterSequence)
#include "tst_RegisterSequence.moc"
