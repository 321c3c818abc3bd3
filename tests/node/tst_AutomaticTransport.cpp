// SPDX-License-Identifier: Apache-2.0
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "SecurityFixtures.h"

#include <QtPlcTest>

#include <QtNetwork/QNetworkDatagram>
#include <QtNetwork/QUdpSocket>
#include <QtTest/QtTest>

using namespace std::chrono_literals;

// A node that does not say how its frames travel: over UDP if datagrams get through in both
// directions, else over TCP. On a simulated network the two are "sim" and "sim-stream".
class tst_AutomaticTransport : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void datagramsAreUsedWhenTheyGetThrough_data();
    void datagramsAreUsedWhenTheyGetThrough();
    void streamIsUsedWhenDatagramsAreBlocked_data();
    void streamIsUsedWhenDatagramsAreBlocked();
    void eachRegistrationProbesAgain();
    void nodeWhoseDatagramsStopIsLostAndReturnsOverTheStream();
    void fallbackThatTheManifestForbidsIsRefused();
    void manifestWithoutDatagramsNeedsNoProbe();
    void nodeOfTheMachineUsesUdp_data();
    void nodeOfTheMachineUsesUdp();
    void silentMasterMakesTheNodeUseTcp();
    void answerIsNoLongerThanTheQuestion();
    void onlyTheNodeIsAnswered();
    void wrongQuestionsAreNotAnswered();
    void answersAreLimited();
    void attachedNodeIsNotAnswered();
    void channelThatWasNotOfferedIsRefused_data();
    void channelThatWasNotOfferedIsRefused();

private:
    SecurityFiles m_files;
};

namespace {

const QString datagramKind = QStringLiteral("sim");
const QString streamKind = QStringLiteral("sim-stream");

/// A master and a node, each on a host of a simulator.
struct Plant
{
    /// \param allowed  the one transport of the manifest; empty: there is no manifest
    explicit Plant(QPlcSimulator &of, const QString &allowed = QString())
        : simulator(of)
    {
        masterHost.call([&] {
            master->setInterval(10ms);
            QPlcManifest manifest;
            if (!allowed.isEmpty())
                manifest.nodes = {{"Echo", QPlcManifest::Required, {allowed}, 0ns, {}}};
            master->setManifest(manifest);
            master->startServer(masterHost.place());
        });
    }
    void startNode()
    {
        echo = echoHost.start<EchoNode>();
        echoHost.call([this] {
            echo->setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
            const QString place = masterHost.place().toString();
            echo->connectToMaster(QPlcUnderlyingProtocol::fromString("sim-auto" + place.mid(place.indexOf(':'))));
        });
    }
    void block(bool fromNode, bool toNode)
    {
        QPlcSimulatedRoad road;
        road.dropsDatagrams = fromNode;
        simulator.setRoad(echoHost, masterHost, road);
        road.dropsDatagrams = toNode;
        simulator.setRoad(masterHost, echoHost, road);
    }
    bool isThere()
    {
        return simulator.runUntil([this] { return master->nodes().size() == 1; }, 20s);
    }
    QPlcNodeInfo info() const { return master->nodes().first(); }
    /// Whether the node computes cycles.
    bool flies()
    {
        masterHost.call([this] { master->startRealTime(); });
        const quint64 before = echo->counters().cycles;
        return simulator.runUntil([&] { return echo->counters().cycles > before + 100; }, 20s);
    }

    QPlcSimulator &simulator;
    QPlcSimulatedHost masterHost{simulator, "master"};
    QPlcSimulatedHost echoHost{simulator, "echo"};
    TestMaster *master = masterHost.start<TestMaster>(QPlcClock::realTime());
    EchoNode *echo = nullptr;
};

/// A node of the machine that has registered with the port of a socket of the test.
struct Prober
{
    /// \return whether the master wants to be asked
    bool registerAt(const TestMaster &master)
    {
        port = master.serverPort();
        socket.bind(QHostAddress::LocalHost, 0);
        if (!node.connectTo(port))
            return false;
        node.send(QPlcMessage::Hello, node.helloFields());
        node.session = node.next().hex64("session");
        QJsonObject fields = node.registerFields();
        fields["cyclic"] = "auto";
        fields["udpPort"] = socket.localPort();
        node.send(QPlcMessage::Register, fields);
        if (!node.takeRegistered(node.next()))
            return false;
        const auto registered = qplc::messages::readAs<qplc::messages::Registered>(node.registered);
        if (registered && registered->probe)
            numbers = *registered->probe;
        return registered && registered->probe;
    }
    static QByteArray datagram(quint64 number, int size = 12)
    {
        QByteArray bytes("QPLP");
        bytes.resize(12);
        qToLittleEndian<quint64>(number, bytes.data() + 4);
        return bytes.leftJustified(size, '\0');
    }
    void ask(QUdpSocket &from, const QByteArray &question) const
    {
        from.writeDatagram(question, QHostAddress::LocalHost, port);
    }
    /// What arrives until \a count datagrams are there, or nothing came for a while.
    static QVector<QNetworkDatagram> answersTo(QUdpSocket &of, int count)
    {
        QVector<QNetworkDatagram> arrived;
        while (arrived.size() < count && waitUntil([&] { return of.hasPendingDatagrams(); }, 300))
            arrived << of.receiveDatagram();
        return arrived;
    }
    void attachOverUdp()
    {
        node.send(
            QPlcMessage::AttachCyclicChannel,
            {{"node", node.registered.fields()["node"]}, {"token", node.registered.text("token")}, {"cyclic", "udp"}});
    }

    ScriptedNode node;
    QUdpSocket socket;
    quint16 port = 0;
    qplc::messages::Probe numbers;
};

}  // namespace

void tst_AutomaticTransport::initTestCase()
{
    QPlcSimulator::run(1, [](QPlcSimulator &) {});  // from now on there are transports of a simulator
}

// ---- a simulated network ----

void tst_AutomaticTransport::datagramsAreUsedWhenTheyGetThrough_data()
{
    QTest::addColumn<double>("loss");
    QTest::newRow("all") << 0.0;
    QTest::newRow("90 % in each direction") << 0.1;
}

void tst_AutomaticTransport::datagramsAreUsedWhenTheyGetThrough()
{
    QFETCH(double, loss);
    for (quint64 seed = 1; seed <= 20; ++seed) {
        QPlcSimulator::run(seed, [&](QPlcSimulator &simulator) {
            QPlcSimulatedRoad road;
            road.loss = loss;
            simulator.setRoads(road);
            Plant plant(simulator);
            plant.startNode();
            QVERIFY(plant.isThere());
            QCOMPARE(plant.info().transport, datagramKind);
            QVERIFY(!plant.info().fallback);
            QVERIFY(plant.flies());
            QCOMPARE(plant.echo->counters().rejected, quint64(0));
            QCOMPARE(plant.info().rejected, quint64(0));
        });
    }
}

void tst_AutomaticTransport::streamIsUsedWhenDatagramsAreBlocked_data()
{
    QTest::addColumn<bool>("fromNode");
    QTest::addColumn<bool>("toNode");
    QTest::addColumn<int>("arrived");
    QTest::newRow("to the master") << true << false << 0;
    QTest::newRow("to the node") << false << true << 20;
    QTest::newRow("both ways") << true << true << 0;
}

void tst_AutomaticTransport::streamIsUsedWhenDatagramsAreBlocked()
{
    QFETCH(bool, fromNode);
    QFETCH(bool, toNode);
    QFETCH(int, arrived);
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        const LogCapture log;
        Plant plant(simulator);
        plant.block(fromNode, toNode);
        const auto begin = simulator.now();
        plant.startNode();
        QVERIFY(plant.isThere());
        const auto duration = simulator.now() - begin;
        QVERIFY2(duration > 500ms && duration < 520ms, qPrintable(QString::number(duration.count())));
        QCOMPARE(plant.info().transport, streamKind);
        QVERIFY(plant.info().fallback);
        QCOMPARE(log.matching(QString("node Echo: SIM does not get through (datagrams of the node that reached the "
                                      "master: %1): frames use SIM-STREAM")
                                  .arg(arrived))
                     .size(),
                 1);
        QCOMPARE(log.matching("node 'Echo': SIM does not get through (no answer within 500 ms to 20 datagrams): "
                              "frames use SIM-STREAM")
                     .size(),
                 1);
        QVERIFY(plant.flies());
        QCOMPARE(plant.info().lateAnswers, quint64(0));
    });
}

void tst_AutomaticTransport::eachRegistrationProbesAgain()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        const LogCapture log;
        Plant plant(simulator);
        plant.block(true, true);
        plant.startNode();
        QVERIFY(plant.isThere());
        QCOMPARE(plant.info().transport, streamKind);
        plant.block(false, false);
        plant.echoHost.call([&] {
            const QPlcUnderlyingProtocol master = plant.echo->masterProtocol();
            plant.echo->disconnectFromMaster();
            plant.echo->connectToMaster(master);
        });
        QVERIFY(simulator.runUntil([&] { return plant.master->nodes().isEmpty(); }, 5s));
        QVERIFY(plant.isThere());
        QCOMPARE(plant.info().transport, datagramKind);
        QVERIFY(!plant.info().fallback);
    });
}

void tst_AutomaticTransport::nodeWhoseDatagramsStopIsLostAndReturnsOverTheStream()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        const LogCapture log;
        Plant plant(simulator);
        plant.startNode();
        QVERIFY(plant.isThere());
        plant.echoHost.call([&] { plant.echo->activateWatchdog(1.0); });
        QVERIFY(plant.flies());
        QCOMPARE(plant.info().transport, datagramKind);
        plant.block(false, true);
        QVERIFY(simulator.runUntil([&] { return plant.echo->state() == QPlcSlaveNode::SafeStop; }, 2s));
        const auto isBack = [&] { return !plant.master->nodes().isEmpty() && plant.info().transport == streamKind; };
        QVERIFY(simulator.runUntil(isBack, 20s));
    });
}

void tst_AutomaticTransport::fallbackThatTheManifestForbidsIsRefused()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        const LogCapture log;
        Plant plant(simulator, datagramKind);
        plant.block(true, true);
        plant.startNode();
        QVERIFY(simulator.runUntil([&] { return plant.echo->state() == QPlcSlaveNode::Rejected; }, 5s));
        const QString text = plant.echo->errorString();
        QVERIFY2(text.contains("the manifest says transport = sim; use it; SIM does not get through"),
                 qPrintable(text));
        QVERIFY(plant.master->nodes().isEmpty());
        QVERIFY2(plant.master->missingNodes().contains("Echo"), qPrintable(plant.master->missingNodes()));
        plant.block(false, false);
        QVERIFY(plant.isThere());
    });
}

void tst_AutomaticTransport::manifestWithoutDatagramsNeedsNoProbe()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        Plant plant(simulator, streamKind);
        plant.startNode();
        QVERIFY(plant.isThere());
        QCOMPARE(plant.info().transport, streamKind);
        QVERIFY(!plant.info().fallback);  // nothing has failed
    });
}

// ---- the machine ----

void tst_AutomaticTransport::nodeOfTheMachineUsesUdp_data()
{
    QTest::addColumn<QString>("address");
    QTest::addColumn<bool>("isSecured");
    QTest::newRow("IPv4") << "127.0.0.1" << false;
    QTest::newRow("IPv6") << "::1" << false;
    QTest::newRow("IPv4 at a master of all addresses") << "0.0.0.0" << false;
    QTest::newRow("secured") << "127.0.0.1" << true;
}

void tst_AutomaticTransport::nodeOfTheMachineUsesUdp()
{
    QFETCH(QString, address);
    QFETCH(bool, isSecured);
    TestMaster master;
    EchoNode echo;
    if (isSecured) {
        master.setSecurity(QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        echo.setSecurity(m_files.echo());
    }
    const QHostAddress listening = address == "0.0.0.0" ? QHostAddress(QHostAddress::Any) : QHostAddress(address);
    QVERIFY2(master.startServer(QPlcUnderlyingProtocol::tcp(listening, 0)), qPrintable(master.errorString()));
    const QHostAddress there(address == "0.0.0.0" ? "127.0.0.1" : address);
    QVERIFY(echo.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::automatic(there, master.serverPort())));
    QCOMPARE(master.nodes().at(0).transport, QString("udp"));
    QVERIFY(!master.nodes().at(0).fallback);
    QVERIFY(master.startArmed());
    QTRY_VERIFY(echo.counters().cycles > 10);
    QCOMPARE(echo.counters().rejected + echo.counters().forged, quint64(0));
    master.stop();
}

void tst_AutomaticTransport::silentMasterMakesTheNodeUseTcp()
{
    const LogCapture log;
    ScriptedMaster master;
    EchoNode echo;
    echo.setSignalTable(testTable());
    echo.connectToMaster(master.over("auto"));
    QCOMPARE(master.next().kind(), QPlcMessage::Hello);
    master.send(QPlcMessage::Hello, master.helloFields());
    QJsonObject request = master.next().fields();
    QCOMPARE(request["cyclic"].toString(), QString("auto"));
    QVERIFY(request["udpPort"].toInt() > 0);
    QJsonObject fields = master.registeredFields(QPlcMessage(QPlcMessage::Register, request));
    fields["probe"] = QJsonObject{{"question", QPlcMessage::fromHex64(1)}, {"answer", QPlcMessage::fromHex64(2)}};
    master.send(QPlcMessage::Registered, fields);
    const QPlcMessage attach = master.next();
    QCOMPARE(attach.kind(), QPlcMessage::AttachCyclicChannel);
    QCOMPARE(attach.text("cyclic"), QString("tcp"));
    QTRY_COMPARE(echo.state(), QPlcSlaveNode::Off);
    QCOMPARE(log.matching("frames use TCP").size(), 1);
}

void tst_AutomaticTransport::answerIsNoLongerThanTheQuestion()
{
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    for (const int size : {12, 100, 1472}) {
        prober.ask(prober.socket, Prober::datagram(prober.numbers.question, size));
        const auto answers = Prober::answersTo(prober.socket, 1);
        QCOMPARE(answers.size(), 1);
        QCOMPARE(answers.first().data(), Prober::datagram(prober.numbers.answer, size));
        QCOMPARE(answers.first().senderPort(), int(master.serverPort()));
    }
}

/// Another port of the same computer is a stranger, even if it has seen the question.
void tst_AutomaticTransport::onlyTheNodeIsAnswered()
{
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    QUdpSocket stranger;
    stranger.bind(QHostAddress::LocalHost, 0);
    prober.ask(stranger, Prober::datagram(prober.numbers.question));
    QCOMPARE(Prober::answersTo(stranger, 1).size(), 0);
    QCOMPARE(Prober::answersTo(prober.socket, 1).size(), 0);
    QCOMPARE(master.statistics().strangers, quint64(1));
}

void tst_AutomaticTransport::wrongQuestionsAreNotAnswered()
{
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    const QByteArray right = Prober::datagram(prober.numbers.question);
    for (const QByteArray &wrong : {Prober::datagram(prober.numbers.question + 1),
                                    Prober::datagram(prober.numbers.answer), right.left(11), "X" + right.mid(1)})
        prober.ask(prober.socket, wrong);
    QCOMPARE(Prober::answersTo(prober.socket, 1).size(), 0);
    prober.ask(prober.socket, right);
    QCOMPARE(Prober::answersTo(prober.socket, 1).size(), 1);
}

void tst_AutomaticTransport::answersAreLimited()
{
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    int answers = 0;
    for (int i = 0; i < 100; ++i) {
        prober.ask(prober.socket, Prober::datagram(prober.numbers.question));
        if (i % 10 == 9)
            answers += Prober::answersTo(prober.socket, 10).size();
    }
    QCOMPARE(answers, 40);
}

void tst_AutomaticTransport::attachedNodeIsNotAnswered()
{
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    QVERIFY(master.nodes().isEmpty());
    prober.attachOverUdp();
    QCOMPARE(prober.node.next().kind(), QPlcMessage::CyclicChannelAttached);
    QCOMPARE(master.nodes().at(0).transport, QString("udp"));
    prober.ask(prober.socket, Prober::datagram(prober.numbers.question));
    QCOMPARE(Prober::answersTo(prober.socket, 1).size(), 0);
}

void tst_AutomaticTransport::channelThatWasNotOfferedIsRefused_data()
{
    QTest::addColumn<QString>("cyclic");
    QTest::addColumn<bool>("hasToken");
    QTest::newRow("another transport") << "udp-multicast" << true;
    QTest::newRow("no transport") << "" << true;
    QTest::newRow("a choice") << "auto" << true;
    QTest::newRow("tcp, on the control connection") << "tcp" << true;
    QTest::newRow("a wrong token") << "udp" << false;
}

void tst_AutomaticTransport::channelThatWasNotOfferedIsRefused()
{
    QFETCH(QString, cyclic);
    QFETCH(bool, hasToken);
    const LogCapture log;
    TestMaster master;
    QVERIFY(master.listen());
    Prober prober;
    QVERIFY(prober.registerAt(master));
    const QString token = hasToken ? prober.node.registered.text("token") : QString(16, '1');
    prober.node.send(QPlcMessage::AttachCyclicChannel,
                     {{"node", prober.node.registered.fields()["node"]}, {"token", token}, {"cyclic", cyclic}});
    QCOMPARE(prober.node.next().kind(), QPlcMessage::Rejected);
    QVERIFY(master.nodes().isEmpty());
}

QTEST_GUILESS_MAIN(tst_AutomaticTransport)
#include "tst_AutomaticTransport.moc"
