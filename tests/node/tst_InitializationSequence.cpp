// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"

// Figure 4.16 of the thesis: the initial outputs of all nodes become the initial inputs of all
// nodes.
class tst_InitializationSequence : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void masterCollectsAllOutputsBeforeItSendsInputs();
    void everyNodeGetsTheInitialOutputsOfTheOthers_data();
    void everyNodeGetsTheInitialOutputsOfTheOthers();
    void slaveAnswersStepByStep();
    void aSilentNodeEndsTheInitialization();
    void aNodeThatLeavesEndsTheInitialization();
    void outputsOfAWrongSizeEndTheInitialization();
    void outputsThatCannotBeReadEndTheInitialization();
    void initialOutputsThatAreNotFiniteEndTheInitialization_data();
    void initialOutputsThatAreNotFiniteEndTheInitialization();
    void codeThatThrowsEndsTheInitialization_data();
    void codeThatThrowsEndsTheInitialization();
    void unrequestedAnswersAreIgnored();
    void repeatedAndEarlyAnswersAreIgnored();
    void initializationIsAllowedOnlyInStateOff();
    void initializationWithoutNodesSucceedsImmediately();
    void aMasterWithoutSignalsRefusesEveryCommand();

private:
    double decoded(const QPlcMessage &message)
    {
        return QPlcValue::fromBytes(QPlcSignalType(QPlcSignalType::Real64), message.bytes("values")).toReal();
    }
};

void tst_InitializationSequence::init()
{
    QPlcSignalIndexTable::setCurrent({});
}

void tst_InitializationSequence::masterCollectsAllOutputsBeforeItSendsInputs()
{
    TestMaster master;
    QVERIFY(master.listen());
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    ScriptedNode a("A");
    ScriptedNode b("B");
    ScriptedTool tool;
    a.playsAlong = b.playsAlong = false;
    b.inputs = QStringList{"echo"};
    b.outputs = QStringList{"count"};
    QVERIFY(a.registerAt(master.serverPort()));
    QVERIFY(b.registerAt(master.serverPort()));
    QVERIFY(tool.greetAt(master.serverPort()));

    tool.send(QPlcMessage::InitializeAllStates);
    QCOMPARE(a.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(b.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    a.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(QPlcValue(2.5).toBytes())}});
    QCOMPARE(a.next(50).kind(), QPlcMessage::Invalid);  // B has not answered
    b.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", QPlcMessage::fromBytes(QPlcValue(42).toBytes())}});

    const QPlcMessage forA = a.next();
    const QPlcMessage forB = b.next();
    QCOMPARE(forA.kind(), QPlcMessage::InitializeWithValues);
    QCOMPARE(forA.bytes("values"), QPlcValue(42).toBytes());
    QCOMPARE(forB.kind(), QPlcMessage::InitializeWithValues);
    QCOMPARE(decoded(forB), 2.5);
    b.send(QPlcMessage::Initialized);
    QCOMPARE(tool.next(50).kind(), QPlcMessage::Invalid);  // A has not
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    a.send(QPlcMessage::Initialized);
    for (ScriptedNode *node : {&a, &b, static_cast<ScriptedNode *>(&tool)}) {
        const QPlcMessage end = node->next();
        QCOMPARE(end.kind(), QPlcMessage::StatesInitialized);
        QVERIFY(end.fields().value("ok").toBool());
    }
    QCOMPARE(tool.next().kind(), QPlcMessage::Done);
    QCOMPARE(states.size(), 2);
    QCOMPARE(states.at(0).at(0).value<QPlcMasterNode::State>(), QPlcMasterNode::Initializing);
    QCOMPARE(states.at(1).at(0).value<QPlcMasterNode::State>(), QPlcMasterNode::Ready);
}

void tst_InitializationSequence::everyNodeGetsTheInitialOutputsOfTheOthers_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("udp") << "udp";
    QTest::newRow("in process") << "local";
}

void tst_InitializationSequence::everyNodeGetsTheInitialOutputsOfTheOthers()
{
    QFETCH(QString, kind);
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    if (kind == "local") {
        QVERIFY(master.addLocalNode(&counter));
        QVERIFY(master.addLocalNode(&echo));
    } else {
        QVERIFY(master.listen());
        QVERIFY(counter.connectToMasterAndWaitForConnected(master.protocol(kind)));
        QVERIFY(echo.connectToMasterAndWaitForConnected(master.protocol(kind)));
    }
    QSignalSpy initialized(&counter, &QPlcSlaveNode::hasInitialized);
    QSignalSpy all(&master, &QPlcMasterNode::statesInitialized);
    QVERIFY(master.initializeAllStates());
    QTRY_COMPARE(all.size(), 1);
    QCOMPARE(counter.initialEcho, 0.5);  // what EchoNode::reset() has set
    QCOMPARE(counter.initializations, 1);
    QCOMPARE(counter.resets, 1);
    QCOMPARE(initialized.size(), 1);
    QCOMPARE(initialized.at(0).at(0).value<QPlcSignalList>().value(testTable().indexOf("echo")).toReal(), 0.5);
    QCOMPARE(counter.state(), QPlcSlaveNode::Ready);
    QCOMPARE(master.signalValue("echo").toReal(), 0.5);
    QCOMPARE(master.signalValue("count").toInt(), 0);  // the node's word is newer than the initial value 7 of the table
    counter.disconnectFromMaster();
    echo.disconnectFromMaster();
}

void tst_InitializationSequence::slaveAnswersStepByStep()
{
    ScriptedMaster master;
    EchoNode node;
    QVERIFY(master.admit(node, master.udp()));
    master.send(QPlcMessage::SendYourInitialOutputStates);
    const QPlcMessage outputs = master.next();
    QCOMPARE(outputs.kind(), QPlcMessage::ReceiveMyInitialOutputStates);
    QCOMPARE(decoded(outputs), 0.5);
    QCOMPARE(node.state(), QPlcSlaveNode::Initializing);
    master.send(QPlcMessage::InitializeWithValues, {{"values", QPlcMessage::fromBytes(QPlcValue(1).toBytes())}});
    QCOMPARE(master.next().kind(), QPlcMessage::Initialized);
    QCOMPARE(node.state(), QPlcSlaveNode::Ready);

    master.send(QPlcMessage::SendYourInitialOutputStates);
    QCOMPARE(master.next().kind(), QPlcMessage::ReceiveMyInitialOutputStates);
    master.send(QPlcMessage::StatesInitialized, {{"ok", false}, {"text", "another node failed"}});
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);  // it does not wait for ever

    master.send(QPlcMessage::InitializeWithValues, {{"values", QPlcMessage::fromBytes("abc")}});
    QTRY_COMPARE(node.error(), QPlcSlaveNode::ProtocolError);
    QVERIFY2(node.errorString().contains("3 bytes instead of 4"), qPrintable(node.errorString()));
}

void tst_InitializationSequence::aSilentNodeEndsTheInitialization()
{
    TestMaster master;
    master.setInitializationTimeout(std::chrono::milliseconds(50));
    QVERIFY(master.listen());
    ScriptedNode silent("Silent");
    silent.playsAlong = false;
    ScriptedTool tool;
    CounterNode other;
    QVERIFY(master.addLocalNode(&other));
    QVERIFY(silent.registerAt(master.serverPort()));
    QVERIFY(tool.greetAt(master.serverPort()));
    tool.send(QPlcMessage::InitializeAllStates);
    const QPlcMessage end = tool.next();
    QCOMPARE(end.kind(), QPlcMessage::StatesInitialized);  // to all
    QVERIFY(!end.fields().value("ok").toBool(true));
    QVERIFY2(end.text("text").contains("'Silent'"), qPrintable(end.text("text")));
    const QPlcMessage failed = tool.next();
    QCOMPARE(failed.kind(), QPlcMessage::Failed);
    QVERIFY(failed.text("text").contains("'Silent'"));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(master.error(), QPlcMasterNode::InitializationError);
    QCOMPARE(other.state(), QPlcSlaveNode::Off);
    silent.playsAlong = true;  // and the next attempt begins at the top
    QVERIFY(master.initializeAllStates());
    QTRY_COMPARE(other.initializations, 1);
}

void tst_InitializationSequence::aNodeThatLeavesEndsTheInitialization()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode leaver("Leaver");
    leaver.playsAlong = false;
    QVERIFY(leaver.registerAt(master.serverPort()));
    QSignalSpy errors(&master, &QPlcMasterNode::errorOccurred);
    QVERIFY(master.startRealTime());
    QCOMPARE(leaver.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    leaver.control.abort();
    QTRY_COMPARE(errors.size(), 1);
    QCOMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains("'Leaver'"), qPrintable(master.errorString()));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

/// Nobody waits for the answer of a node that has sent one that cannot be read.
void tst_InitializationSequence::outputsThatCannotBeReadEndTheInitialization()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.playsAlong = false;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(node.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    node.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", 8}});
    QTRY_COMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains("field 'values'"), qPrintable(master.errorString()));
    QTRY_VERIFY(!node.control.isConnected());
}

void tst_InitializationSequence::outputsOfAWrongSizeEndTheInitialization()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    node.initialValues = "abc";
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QTRY_COMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains("3 bytes of initial outputs instead of 8"),
             qPrintable(master.errorString()));
    QTRY_VERIFY(!node.control.isConnected());
    QCOMPARE(master.state(), QPlcMasterNode::Off);
}

void tst_InitializationSequence::initialOutputsThatAreNotFiniteEndTheInitialization_data()
{
    QTest::addColumn<bool>("local");
    QTest::newRow("over the network") << false;
    QTest::newRow("in process") << true;
}

void tst_InitializationSequence::initialOutputsThatAreNotFiniteEndTheInitialization()
{
    class Broken : public QPlcCompactSlaveNode
    {
    public:
        Broken()
            : QPlcCompactSlaveNode("Broken")
        {
        }
        QPlcOutput<std::array<double, 3>> m_vector{this, "vector"};
        void reset() override { m_vector = std::array<double, 3>{0.0, qQNaN(), 0.0}; }
    } node;
    QFETCH(bool, local);
    TestMaster master;
    QVERIFY(master.listen());
    if (local)
        QVERIFY(master.addLocalNode(&node));
    else
        QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("udp")));
    QSignalSpy started(&master, &QPlcMasterNode::realTimeHasStarted);
    master.startRealTime();
    QTRY_COMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains("'Broken'") && master.errorString().contains("'vector'"),
             qPrintable(master.errorString()));
    QCOMPARE(master.state(), QPlcMasterNode::Off);
    QCOMPARE(started.size(), 0);
    QTRY_COMPARE(node.state(), QPlcSlaveNode::Off);
    node.disconnectFromMaster();
}

void tst_InitializationSequence::codeThatThrowsEndsTheInitialization_data()
{
    QTest::addColumn<bool>("local");
    QTest::addColumn<bool>("inReset");
    QTest::newRow("reset over the network") << false << true;
    QTest::newRow("initialized over the network") << false << false;
    QTest::newRow("reset in process") << true << true;
    QTest::newRow("initialized in process") << true << false;
}

void tst_InitializationSequence::codeThatThrowsEndsTheInitialization()
{
    class Thrower : public QPlcCompactSlaveNode
    {
    public:
        Thrower()
            : QPlcCompactSlaveNode("Thrower")
        {
        }
        bool inReset = false;
        void reset() override
        {
            if (inReset)
                throw std::runtime_error("no parameters");
        }
        void initialized() override
        {
            if (!inReset)
                throw 5;
        }
        QPlcInput<double> m_echo{this, "echo"};
    } node;
    QFETCH(bool, local);
    QFETCH(bool, inReset);
    node.inReset = inReset;
    TestMaster master;
    QVERIFY(master.listen());
    if (local)
        QVERIFY(master.addLocalNode(&node));
    else
        QVERIFY(node.connectToMasterAndWaitForConnected(master.protocol("tcp")));
    master.initializeAllStates();
    QTRY_COMPARE(master.error(), QPlcMasterNode::InitializationError);
    QVERIFY2(master.errorString().contains("'Thrower'"), qPrintable(master.errorString()));
    QVERIFY2(master.errorString().contains(inReset ? "no parameters" : "not derived from std::exception"),
             qPrintable(master.errorString()));
    QCOMPARE(node.state(), QPlcSlaveNode::Fault);
    if (!local)
        QCOMPARE(node.error(), QPlcSlaveNode::UserCodeError);
    node.disconnectFromMaster();
}

void tst_InitializationSequence::unrequestedAnswersAreIgnored()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    ScriptedTool tool;
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(tool.greetAt(master.serverPort()));
    QSignalSpy errors(&master, &QPlcMasterNode::errorOccurred);
    const QJsonObject notANumber{{"values", QPlcMessage::fromBytes(QPlcValue(qQNaN()).toBytes())}};
    for (QPlcMessage::Kind kind :
         {QPlcMessage::ReceiveMyInitialOutputStates, QPlcMessage::Initialized, QPlcMessage::RealTimeReady}) {
        node.send(kind, notANumber);
        const QPlcMessage failed = node.next();
        QCOMPARE(failed.kind(), QPlcMessage::Failed);
        QCOMPARE(failed.text("error"), QString("WrongState"));
        QCOMPARE(tool.ask(kind, notANumber).text("error"), QString("MalformedMessage"));
    }
    QCOMPARE(tool.ask(QPlcMessage::NodeFault, {{"text", "me too"}}).text("error"), QString("MalformedMessage"));
    QCOMPARE(errors.size(), 0);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);
    QCOMPARE(master.nodes().size(), 1);
}

void tst_InitializationSequence::repeatedAndEarlyAnswersAreIgnored()
{
    TestMaster master;
    QVERIFY(master.listen());
    ScriptedNode node;
    ScriptedNode silent("Silent");
    node.playsAlong = silent.playsAlong = false;
    silent.inputs.clear();
    silent.outputs.clear();
    QVERIFY(node.registerAt(master.serverPort()));
    QVERIFY(silent.registerAt(master.serverPort()));
    QVERIFY(master.initializeAllStates());
    QCOMPARE(node.next().kind(), QPlcMessage::SendYourInitialOutputStates);
    node.send(QPlcMessage::ReceiveMyInitialOutputStates,
              {{"values", QPlcMessage::fromBytes(QPlcValue(1.0).toBytes())}});
    node.send(QPlcMessage::ReceiveMyInitialOutputStates,
              {{"values", QPlcMessage::fromBytes(QPlcValue(2.0).toBytes())}});
    QCOMPARE(node.next().text("error"), QString("WrongState"));
    silent.send(QPlcMessage::ReceiveMyInitialOutputStates, {{"values", ""}});
    QCOMPARE(node.next().kind(), QPlcMessage::InitializeWithValues);
    QCOMPARE(master.signalValue("echo").toReal(), 1.0);
    silent.send(QPlcMessage::Initialized);
    node.send(QPlcMessage::RealTimeReady);  // not the answer that is owed
    QCOMPARE(node.next().text("error"), QString("WrongState"));
    QCOMPARE(master.state(), QPlcMasterNode::Initializing);
    node.send(QPlcMessage::Initialized);
    QVERIFY(master.waitForState(QPlcMasterNode::Ready));
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
}

void tst_InitializationSequence::initializationIsAllowedOnlyInStateOff()
{
    TestMaster master;
    QVERIFY(master.startRealTime());
    QVERIFY(!master.initializeAllStates());
    QCOMPARE(master.error(), QPlcMasterNode::StateError);
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
    CounterNode node;
    QVERIFY(!master.addLocalNode(&node));
    QCOMPARE(master.error(), QPlcMasterNode::StateError);
    QVERIFY(!master.listen());
    master.stop();
}

void tst_InitializationSequence::initializationWithoutNodesSucceedsImmediately()
{
    TestMaster master;
    QSignalSpy all(&master, &QPlcMasterNode::statesInitialized);
    QVERIFY(master.initializeAllStates());
    QCOMPARE(all.size(), 1);
    QCOMPARE(master.state(), QPlcMasterNode::Ready);
    QCOMPARE(master.signalValue("count").toInt(), 7);
}

void tst_InitializationSequence::aMasterWithoutSignalsRefusesEveryCommand()
{
    QPlcMasterNode empty;
    QVERIFY(!empty.initializeAllStates());
    QCOMPARE(empty.error(), QPlcMasterNode::SignalError);
    QVERIFY(!empty.startRealTime());
    QCOMPARE(empty.state(), QPlcMasterNode::Off);
    QVERIFY(!empty.arm());
    QVERIFY(!empty.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
}

QTEST_GUILESS_MAIN(tst_InitializationSequence)
#include "tst_InitializationSequence.moc"
