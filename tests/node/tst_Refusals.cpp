// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"

// What a master refuses, and that none of it disturbs those who run.
class tst_Refusals : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void cleanup();
    void aWrongRegistrationIsRejected_data();
    void aWrongRegistrationIsRejected();
    void aRegistrationThatDoesNotFitItsGreetingIsRejected_data();
    void aRegistrationThatDoesNotFitItsGreetingIsRejected();
    void aGoodRegistrationIsNotRejected();
    void bothWritersOfASignalAreNamed();
    void aNameInUseIsRefusedUnlessItIsTheSameNode();
    void theFirstMessageIsHello();
    void secondHelloIsRejected();
    void secondRegisterIsRejected();
    void anotherVersionIsNamed();
    void garbageOnTheControlPortClosesTheConnection_data();
    void garbageOnTheControlPortClosesTheConnection();
    void messagesOfOtherRolesFail();
    void aWrongTokenAttachesNothing();
    void masterSignalsAreChecked();
    void limitsOfAMasterHaveRanges();
    void aFunctionThatSucceedsSetsTheErrorBack();
    void aWatchdogTimeHasARange();
    void secondsThatDoNotFitAreRefused_data();
    void secondsThatDoNotFitAreRefused();

private:
    static QPlcMessage answerTo(ScriptedNode &node, const QJsonObject &changes);

    QScopedPointer<TestMaster> m_master;
    QScopedPointer<CounterNode> m_counter;
};

// Every test happens beside a plant that runs, and ends with a look whether it still does.
void tst_Refusals::init()
{
    m_master.reset(new TestMaster(QPlcClock::realTime()));
    m_master->setInterval(std::chrono::milliseconds(2));
    m_counter.reset(new CounterNode);
    QVERIFY(m_master->addLocalNode(m_counter.data()));
    QVERIFY(m_master->listen());
    QVERIFY(m_master->startRealTime());
    QVERIFY(m_master->waitForCycles(1));
}

void tst_Refusals::cleanup()
{
    QCOMPARE(m_master->state(), QPlcMasterNode::RealTime);
    QCOMPARE(m_master->error(), QPlcMasterNode::NoError);
    QCOMPARE(m_counter->resets, 1);
    QVERIFY(m_master->waitForCycles(m_master->statistics().cycles + 3));
    QVERIFY(m_master->nodes().size() <= 2);
    m_master->stop();
    m_master.reset();
}

void tst_Refusals::aWrongRegistrationIsRejected_data()
{
    QTest::addColumn<QJsonObject>("changes");
    QTest::addColumn<QString>("error");
    QTest::addColumn<QStringList>("words");
    const auto one = [](const char *name, const char *type, const char *unit) {
        return QJsonArray{QJsonObject{{"name", name}, {"type", type}, {"unit", unit}}};
    };
    const QJsonArray twice{QJsonObject{{"name", "vector"}, {"type", "Real64[3]"}, {"unit", ""}},
                           QJsonObject{{"name", "vector"}, {"type", "Real64[3]"}, {"unit", ""}}};
    QTest::newRow("unknown signal") << QJsonObject{{"inputs", one("setpiont", "Real64", "m/s")}} << "UnknownSignal"
                                    << QStringList{"'Scripted'", "'setpiont'", "'setpoint'"};
    QTest::newRow("type") << QJsonObject{{"inputs", one("setpoint", "Real32", "m/s")}} << "TypeMismatch"
                          << QStringList{"'setpoint'", "Real64", "Real32", "'Scripted'"};
    QTest::newRow("alias of the type") << QJsonObject{{"inputs", one("free", "Real", "")}} << "TypeMismatch"
                                       << QStringList{"Real32"};
    QTest::newRow("unit") << QJsonObject{{"inputs", one("setpoint", "Real64", "km/h")}} << "UnitMismatch"
                          << QStringList{"'m/s'", "'km/h'"};
    QTest::newRow("missing unit") << QJsonObject{{"inputs", one("setpoint", "Real64", "")}} << "UnitMismatch"
                                  << QStringList{"'m/s'", "''"};
    QTest::newRow("signal twice") << QJsonObject{{"outputs", twice}} << "MalformedMessage"
                                  << QStringList{"'vector'", "twice"};
    QTest::newRow("no name") << QJsonObject{{"name", ""}} << "MalformedMessage" << QStringList{"name"};
    QTest::newRow("long name") << QJsonObject{{"name", QString(65, 'x')}} << "MalformedMessage" << QStringList{"64"};
    QTest::newRow("name with an escape sequence")
        << QJsonObject{{"name", "x\x1b[31m\n"}} << "MalformedMessage" << QStringList{"'x?[31m?'"};
    QTest::newRow("name of the master") << QJsonObject{{"name", "Master"}} << "NameInUse" << QStringList{"'Master'"};
    QTest::newRow("policy") << QJsonObject{{"policy", "Patience"}} << "MalformedMessage" << QStringList{"'Patience'"};
    QTest::newRow("no signals") << QJsonObject{{"inputs", QJsonValue()}} << "MalformedMessage"
                                << QStringList{"'inputs'"};
    QTest::newRow("signals as texts") << QJsonObject{{"inputs", QJsonArray{"count"}}} << "MalformedMessage"
                                      << QStringList{"'inputs'"};
    // A node that means to be critical must not become one that nobody misses.
    QTest::newRow("critical as a number")
        << QJsonObject{{"critical", 1}} << "MalformedMessage" << QStringList{"'critical'", "bool"};
    QTest::newRow("critical as a text") << QJsonObject{{"critical", "true"}} << "MalformedMessage"
                                        << QStringList{"'critical'", "bool"};
    QTest::newRow("two phases as a number")
        << QJsonObject{{"twoPhase", 1}} << "MalformedMessage" << QStringList{"'twoPhase'", "bool"};
    QTest::newRow("qualities as a number")
        << QJsonObject{{"quality", 1}} << "MalformedMessage" << QStringList{"'quality'", "bool"};
    QTest::newRow("qualities of outputs as a number")
        << QJsonObject{{"outputQuality", 1}} << "MalformedMessage" << QStringList{"'outputQuality'", "bool"};
    QTest::newRow("cyclic channel") << QJsonObject{{"cyclic", "pigeon"}} << "MalformedMessage"
                                    << QStringList{"'pigeon'"};
    QTest::newRow("port 0") << QJsonObject{{"udpPort", 0}} << "MalformedMessage" << QStringList{"65535"};
    QTest::newRow("port 65536") << QJsonObject{{"udpPort", 65536}} << "MalformedMessage" << QStringList{"65536"};
}

/// What the master says to a registration with other fields; of kind Invalid if it does not greet.
QPlcMessage tst_Refusals::answerTo(ScriptedNode &node, const QJsonObject &changes)
{
    node.send(QPlcMessage::Hello, node.helloFields());
    if (node.next().kind() != QPlcMessage::Hello)
        return {};
    QJsonObject fields = node.registerFields();
    for (auto it = changes.begin(); it != changes.end(); ++it)
        fields.insert(it.key(), it.value());
    node.send(QPlcMessage::Register, fields);
    return node.next();
}

void tst_Refusals::aWrongRegistrationIsRejected()
{
    QFETCH(QJsonObject, changes);
    QFETCH(QString, error);
    QFETCH(QStringList, words);
    QSignalSpy refused(m_master.data(), &QPlcMasterNode::nodeRefused);
    ScriptedNode node;
    if (changes.contains("name"))
        node.name = changes.value("name").toString();
    QVERIFY(node.connectTo(m_master->serverPort()));
    const QPlcMessage answer = answerTo(node, changes);
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("error"), error);
    for (const QString &word : words)
        QVERIFY2(answer.text("text").contains(word), qPrintable(answer.text("text")));
    QTRY_VERIFY(!node.control.isConnected());
    QCOMPARE(refused.size(), 1);
    QCOMPARE(refused.at(0).at(1).toString(), answer.text("text"));
    QCOMPARE(m_master->writer("echo"), QString());
}

void tst_Refusals::aRegistrationThatDoesNotFitItsGreetingIsRejected_data()
{
    QTest::addColumn<QJsonObject>("changes");
    QTest::addColumn<QString>("offered");
    QTest::addColumn<QString>("words");
    const QJsonObject input{{"name", "setpoint"}, {"type", "Real64"}, {"unit", "m/s"}, {"sameCycle", true}};
    QTest::newRow("name") << QJsonObject{{"name", "Other"}} << "quality"
                          << "'Scripted' registers as 'Other'";
    QTest::newRow("uuid") << QJsonObject{{"uuid", "another"}} << "quality"
                          << "uuid";
    QTest::newRow("two phases") << QJsonObject{{"twoPhase", true}} << "quality"
                                << "'sameCycle'";
    QTest::newRow("same cycle") << QJsonObject{{"inputs", QJsonArray{input}}} << "quality"
                                << "'sameCycle'";
    QTest::newRow("quality") << QJsonObject{{"quality", true}} << "outputQuality"
                             << "'quality'";
    QTest::newRow("quality of outputs") << QJsonObject{{"outputQuality", true}} << "quality"
                                        << "'outputQuality'";
}

void tst_Refusals::aRegistrationThatDoesNotFitItsGreetingIsRejected()
{
    QFETCH(QJsonObject, changes);
    QFETCH(QString, offered);
    QFETCH(QString, words);
    ScriptedNode node;
    node.features = QStringList{offered};
    QVERIFY(node.connectTo(m_master->serverPort()));
    const QPlcMessage answer = answerTo(node, changes);
    QCOMPARE(answer.kind(), QPlcMessage::Rejected);
    QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    QVERIFY2(answer.text("text").contains(words), qPrintable(answer.text("text")));
    QCOMPARE(m_master->nodes().size(), 1);
}

void tst_Refusals::aGoodRegistrationIsNotRejected()
{
    ScriptedNode node;
    node.inputs << "setpoint"
                << "sum";
    QVERIFY(node.registerAt(m_master->serverPort()));
    QCOMPARE(m_master->nodes().size(), 2);
}

void tst_Refusals::bothWritersOfASignalAreNamed()
{
    CounterNode second("Second");
    QVERIFY(!second.connectToMasterAndWaitForConnected(m_master->protocol("udp")));
    QCOMPARE(second.error(), QPlcSlaveNode::RegistrationError);
    QVERIFY2(second.errorString().contains("'Second'") && second.errorString().contains("'Counter'")
                 && second.errorString().contains("'count'"),
             qPrintable(second.errorString()));
    QCOMPARE(m_master->writer("count"), QString("Counter"));
}

void tst_Refusals::aNameInUseIsRefusedUnlessItIsTheSameNode()
{
    EchoNode twin("Counter");
    QVERIFY(!twin.connectToMasterAndWaitForConnected(m_master->protocol("tcp")));
    QVERIFY2(twin.errorString().contains("'Counter' already"), qPrintable(twin.errorString()));
    EchoNode first("Twin");
    EchoNode second("Twin");
    QVERIFY(first.connectToMasterAndWaitForConnected(m_master->protocol("tcp")));
    QVERIFY(!second.connectToMasterAndWaitForConnected(m_master->protocol("tcp")));
    QVERIFY(first.state() != QPlcSlaveNode::Disconnected);
    first.disconnectFromMaster();
}

void tst_Refusals::theFirstMessageIsHello()
{
    for (QPlcMessage::Kind kind : {QPlcMessage::Register, QPlcMessage::GetState, QPlcMessage::Stop,
                                   QPlcMessage::StartRealTime, QPlcMessage::Kind(77)}) {
        ScriptedNode node;
        QVERIFY(node.connectTo(m_master->serverPort()));
        node.send(kind, node.registerFields());
        const QPlcMessage answer = node.next();
        QCOMPARE(answer.kind(), QPlcMessage::Rejected);
        QCOMPARE(answer.text("error"), QString("WrongState"));
        QVERIFY2(answer.text("text").contains("Hello"), qPrintable(answer.text("text")));
        QTRY_VERIFY(!node.control.isConnected());
    }
}

void tst_Refusals::secondHelloIsRejected()
{
    ScriptedNode node;
    QVERIFY(node.registerAt(m_master->serverPort()));
    QSignalSpy lost(m_master.data(), &QPlcMasterNode::nodeLost);
    node.forgetMessages();
    node.send(QPlcMessage::Hello, node.helloFields());
    QVERIFY(node.waitForMessage(QPlcMessage::Rejected));
    QTRY_COMPARE(lost.size(), 1);
    QTRY_VERIFY(!node.control.isConnected());
}

void tst_Refusals::secondRegisterIsRejected()
{
    ScriptedNode node;
    QVERIFY(node.registerAt(m_master->serverPort()));
    QSignalSpy lost(m_master.data(), &QPlcMasterNode::nodeLost);
    node.send(QPlcMessage::Register, node.registerFields());
    QVERIFY(node.waitForMessage(QPlcMessage::Rejected));
    QTRY_COMPARE(lost.size(), 1);
    QCOMPARE(m_master->writer("echo"), QString());
}

void tst_Refusals::anotherVersionIsNamed()
{
    for (const QJsonValue &version : {QJsonValue(1), QJsonValue(3), QJsonValue("2"), QJsonValue()}) {
        ScriptedNode node;
        QVERIFY(node.connectTo(m_master->serverPort()));
        QJsonObject fields = node.helloFields();
        fields.insert("protocol", version);
        node.send(QPlcMessage::Hello, fields);
        const QPlcMessage answer = node.next();
        QCOMPARE(answer.kind(), QPlcMessage::Rejected);
        QCOMPARE(answer.text("error"), QString("VersionMismatch"));
        QVERIFY2(answer.text("text").contains("version 2"), qPrintable(answer.text("text")));
    }
}

void tst_Refusals::garbageOnTheControlPortClosesTheConnection_data()
{
    QTest::addColumn<QByteArray>("bytes");
    const auto frame = [](const QByteArray &content) {
        const quint32 size = quint32(content.size());
        return QByteArray(reinterpret_cast<const char *>(&size), 4) + content;
    };
    QTest::newRow("http") << QByteArray("GET / HTTP/1.1\r\nHost: plant\r\n\r\n");
    QTest::newRow("zeros") << QByteArray(64, '\0');
    QTest::newRow("too long") << QByteArray("\x01\x00\x00\x04", 4);
    QTest::newRow("four gigabytes") << QByteArray("\xff\xff\xff\xff", 4);
    QTest::newRow("no JSON") << frame("\x1e{nonsense}");
    QTest::newRow("no object") << frame("\x1e[1,2]");
    QTest::newRow("no UTF-8") << frame("\x1e{\"a\":\"\xff\xfe\"}");
    QTest::newRow("too deep") << frame(QByteArray("\x1e{\"a\":") + QByteArray(17, '[') + QByteArray(17, ']') + "}");
}

void tst_Refusals::garbageOnTheControlPortClosesTheConnection()
{
    QFETCH(QByteArray, bytes);
    for (bool greeted : {false, true}) {
        QTcpSocket socket;
        socket.connectToHost(QHostAddress::LocalHost, m_master->serverPort());
        QTRY_COMPARE(socket.state(), QAbstractSocket::ConnectedState);
        if (greeted)
            socket.write(qplc::encodeControlFrame(QPlcMessage(QPlcMessage::Hello, ScriptedNode().helloFields())));
        socket.write(bytes);
        QTRY_COMPARE(socket.state(), QAbstractSocket::UnconnectedState);
        qplc::ControlFrameReader reader;
        reader.append(socket.readAll());
        QPlcMessage answer;
        QVERIFY(!greeted || reader.next(&answer));
        QVERIFY(reader.next(&answer));
        QCOMPARE(answer.kind(), QPlcMessage::Rejected);
        QCOMPARE(answer.text("error"), QString("MalformedMessage"));
        QVERIFY(!reader.next(&answer));
    }
}

void tst_Refusals::messagesOfOtherRolesFail()
{
    ScriptedTool tool;
    QVERIFY(tool.greetAt(m_master->serverPort()));
    for (int kind : {3, 4, 6, 7, 11, 13, 15, 21, 24, 31, 33, 35, 36, 0, 8, 77, 255}) {
        const QPlcMessage answer = tool.ask(QPlcMessage::Kind(kind));
        QCOMPARE(answer.kind(), QPlcMessage::Failed);
        QCOMPARE(answer.text("error"), QString("MalformedMessage"));
    }
    QCOMPARE(tool.ask(QPlcMessage::GetState).kind(), QPlcMessage::State);  // it has stayed
}

void tst_Refusals::aWrongTokenAttachesNothing()
{
    ScriptedNode node;
    node.cyclic = "tcp";
    QVERIFY(node.connectTo(m_master->serverPort()));
    node.send(QPlcMessage::Hello, node.helloFields());
    node.session = node.next().hex64("session");
    node.send(QPlcMessage::Register, node.registerFields());
    QVERIFY(node.takeRegistered(node.next()));
    QVERIFY(!node.attach(node.registered.hex64("token") ^ 1));
    QCOMPARE(node.attachAnswer().kind(), QPlcMessage::Rejected);
    QTRY_COMPARE(node.stream.state(), QAbstractSocket::UnconnectedState);
    QCOMPARE(m_master->nodes().size(), 1);
    QVERIFY(node.control.isConnected());
}

void tst_Refusals::masterSignalsAreChecked()
{
    TestMaster master;
    CounterNode counter;
    QVERIFY(master.addLocalNode(&counter));
    QVERIFY(!master.setTimeSignal("tmie"));
    QVERIFY2(master.errorString().contains("'time'"), qPrintable(master.errorString()));
    QVERIFY(!master.setTimeSignal("echo"));
    QVERIFY2(master.errorString().contains("DateTime"), qPrintable(master.errorString()));
    QVERIFY(!master.activateJitterMeasurement("vector"));
    QVERIFY(!master.activateWorkloadMeasurement("count"));
    QVERIFY(!master.activateWorkloadMeasurement("sum"));
    QVERIFY2(master.errorString().contains("'Counter'"), qPrintable(master.errorString()));
    QCOMPARE(master.error(), QPlcMasterNode::SignalError);
    QVERIFY(master.activateJitterMeasurement("jitter"));
    QCOMPARE(master.writer("jitter"), QString("Master"));
    QVERIFY(master.activateJitterMeasurement("free"));  // the other one is free again
    QCOMPARE(master.writer("jitter"), QString());
    QVERIFY(!master.setSignalTable(testTable()));
    QVERIFY(master.setInterval(std::chrono::microseconds(10)));
    QVERIFY(!master.setInterval(std::chrono::nanoseconds(9'999)));
    QVERIFY2(master.errorString().contains("use 0.00001 ... 10 s"), qPrintable(master.errorString()));
    QCOMPARE(master.interval(), std::chrono::nanoseconds(10'000));
    QVERIFY(!master.setInterval(10.1));
    QCOMPARE(master.error(), QPlcMasterNode::IntervalError);
    QVERIFY(master.setInterval(0.010));
    QVERIFY(!master.setClock(QPlcClock::scaled(0.0)));
    QVERIFY(!master.setClock(QPlcClock::scaled(1001.0)));
}

void tst_Refusals::limitsOfAMasterHaveRanges()
{
    using namespace std::chrono_literals;
    TestMaster master;
    const auto isRefused = [&](bool isSet, const char *text) {
        const bool isIt
            = !isSet && master.error() == QPlcMasterNode::IntervalError && master.errorString() == QLatin1String(text);
        if (!isIt)
            qInfo("%s", qPrintable(master.errorString()));
        return isIt;
    };
    QVERIFY(isRefused(master.setInitializationTimeout(0ms),
                      "an initialization timeout of 0 s is out of range; use 0.001 ... 86400 s"));
    QVERIFY(isRefused(master.setInitializationTimeout(24h + 1ms),
                      "an initialization timeout of 86400 s is out of range; use 0.001 ... 86400 s"));
    QVERIFY(isRefused(master.setLongestWait(-1ms), "a longest wait of -0.001 s is out of range; use 0 ... 86400 s"));
    QVERIFY(isRefused(master.setGapLimit(25h), "a gap limit of 90000 s is out of range; use 0 ... 86400 s"));
    QVERIFY(isRefused(master.setOverrunLimit(-1), "a limit of -1 overruns is out of range; use 0 ... 1000000"));
    QVERIFY(
        isRefused(master.setOverrunLimit(1'000'001), "a limit of 1000001 overruns is out of range; use 0 ... 1000000"));
    QVERIFY(isRefused(master.setMaximumConnections(0), "a limit of 0 connections is out of range; use 1 ... 65535"));
    QVERIFY(isRefused(master.setMaximumConnections(65'536),
                      "a limit of 65536 connections is out of range; use 1 ... 65535"));
    QVERIFY(master.setInitializationTimeout(1ms));
    QVERIFY(master.setInitializationTimeout(24h));
    QVERIFY(master.setLongestWait(0ns));
    QVERIFY(master.setLongestWait(24h));
    QVERIFY(master.setGapLimit(0ns));
    QVERIFY(master.setOverrunLimit(0));
    QVERIFY(master.setOverrunLimit(1'000'000));
    QVERIFY(master.setMaximumConnections(1));
    QVERIFY(master.setMaximumConnections(65'535));
}

void tst_Refusals::aFunctionThatSucceedsSetsTheErrorBack()
{
    TestMaster master;
    CounterNode node;
    const QVector<std::function<bool()>> functions{
        [&] { return master.setSignalTable(testTable()); },
        [&] { return master.setInterval(0.010); },
        [&] { return master.setClock(QPlcClock::lockstep()); },
        [&] { return master.setOverrunPolicy(QPlcOverrunPolicy::skipToGrid()); },
        [&] { return master.setOverrunLimit(3); },
        [&] { return master.setFaultPlan(QString()); },
        [&] { return master.activateJitterMeasurement("jitter"); },
        [&] { return master.setSignalValue("setpoint", QPlcValue(1.0)); },
        [&] { return master.addLocalNode(&node); },
        [&] { return master.listen(); },
        [&] { return master.initializeAllStates(); },
        [&] { return master.arm(); },
        [&] { return master.startRealTime(); },
        [&] { return master.reset(); },
    };
    for (int i = 0; i < functions.size(); ++i) {
        QVERIFY(!master.setInterval(0.0));
        if (i == functions.size() - 1)
            master.safeStop();
        QVERIFY2(functions.at(i)(), qPrintable(QStringLiteral("%1: %2").arg(i).arg(master.errorString())));
        QVERIFY2(master.error() == QPlcMasterNode::NoError && master.errorString().isEmpty(),
                 qPrintable(QStringLiteral("%1: %2").arg(i).arg(master.errorString())));
    }
}

void tst_Refusals::aWatchdogTimeHasARange()
{
    using namespace std::chrono_literals;
    CounterNode node;
    QVERIFY(node.activateWatchdog(24h));
    QTest::ignoreMessage(QtWarningMsg,
                         "node 'Counter': a watchdog time of -0.5 s is out of range; use 0 (none) ... 86400 s");
    QVERIFY(!node.activateWatchdog(-0.5));
    QCOMPARE(node.error(), QPlcSlaveNode::OptionError);
    QVERIFY(!node.activateWatchdog(24h + 1s));
    QCOMPARE(node.watchdog(), std::chrono::nanoseconds(24h));
    QVERIFY(node.activateWatchdog(0s));
}

void tst_Refusals::secondsThatDoNotFitAreRefused_data()
{
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("text");
    QTest::newRow("not a number") << qQNaN() << "nan";
    QTest::newRow("infinity") << qInf() << "inf";
    QTest::newRow("minus infinity") << -qInf() << "-inf";
    QTest::newRow("more than 64 bits") << 1e10 << "1e+10";
    QTest::newRow("more than a duration") << 1e300 << "1e+300";
    QTest::newRow("less than 64 bits") << -1e300 << "-1e+300";
}

void tst_Refusals::secondsThatDoNotFitAreRefused()
{
    using namespace std::chrono_literals;
    QFETCH(double, seconds);
    QFETCH(QString, text);
    TestMaster master;
    QVERIFY(master.setInterval(0.010));
    QVERIFY(!master.setInterval(seconds));
    QCOMPARE(master.error(), QPlcMasterNode::IntervalError);
    QCOMPARE(master.errorString(), "a period of " + text + " s is out of range; use 0.00001 ... 10 s");
    QVERIFY(master.interval() == 10ms);

    CounterNode node;
    QVERIFY(node.activateWatchdog(0.5));
    const QString report
        = "node 'Counter': a watchdog time of " + text + " s is out of range; use 0 (none) ... 86400 s";
    QTest::ignoreMessage(QtWarningMsg, qPrintable(report));
    QVERIFY(!node.activateWatchdog(seconds));
    QCOMPARE(node.error(), QPlcSlaveNode::OptionError);
    QCOMPARE(node.errorString(), report);
    QVERIFY(node.watchdog() == 500ms);
}

QTEST_GUILESS_MAIN(tst_Refusals)
#include "tst_Refusals.moc"
