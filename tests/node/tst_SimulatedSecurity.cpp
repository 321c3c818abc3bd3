// SPDX-License-Identifier: Apache-2.0
#include "SecurityFixtures.h"
#include "transport/ControlListener.h"

#include <QtPlcTest>

#include <QtTest/QtTest>

using namespace std::chrono_literals;

// A secured master on a simulated network: who gets in, what the others are told, and that the
// frames of a plant are sealed there, too.
class tst_SimulatedSecurity : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void framesOfASecuredPlantAreSealed();
    void theSameSeedGivesTheSameDigest();
    void nodeWithoutKeyGetsTheReason_data();
    void nodeWithoutKeyGetsTheReason();
    void securedNodeReportsAnUnsecuredMaster();
    void handshakeSucceedsAfterALinkOutage();
    void silentMasterIsGivenUp();

private:
    SecurityFiles m_files;
};

namespace {

/// A master with the keys of \a files, on a simulated computer. Null: it does not listen.
TestMaster *startMaster(QPlcSimulatedHost &host, const QPlcSecurity &security)
{
    auto *master = host.start<TestMaster>(QPlcClock::realTime());
    bool listens = false;
    host.call([&] {
        master->setInterval(10ms);
        master->setSecurity(security);
        listens = master->startServer(host.place());
    });
    return listens ? master : nullptr;
}

template<typename Node>
Node *startNode(QPlcSimulatedHost &host, const QPlcSimulatedHost &masterHost, const QPlcSecurity &security)
{
    auto *node = host.start<Node>();
    host.call([&] {
        node->setSecurity(security);
        node->setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
        node->connectToMaster(masterHost.place());
    });
    return node;
}

bool flies(QPlcSimulator &simulator, QPlcSimulatedHost &host, TestMaster *master)
{
    host.call([master] { master->initializeAllStates(); });
    if (!simulator.runUntil([master] { return master->state() == QPlcMasterNode::Ready; }, 5s))
        return false;
    host.call([master] { master->arm(); });
    host.call([master] { master->startRealTime(); });
    return simulator.runUntil([master] { return master->statistics().cycles > 1000; }, 20s);
}

}  // namespace

void tst_SimulatedSecurity::framesOfASecuredPlantAreSealed()
{
    QPlcSimulator::run(1, [this](QPlcSimulator &simulator) {
        QPlcSimulatedHost masterHost(simulator, "master"), counterHost(simulator, "counter"),
            echoHost(simulator, "echo");
        TestMaster *master = startMaster(masterHost, QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        QVERIFY(master);
        auto *counter = startNode<CounterNode>(counterHost, masterHost, m_files.counter());
        auto *echo = startNode<EchoNode>(echoHost, masterHost, m_files.echo());
        QVERIFY(simulator.runUntil([&] { return master->nodes().size() == 2; }, 5s));
        QVERIFY(counter->isSecured() && echo->isSecured());
        QVERIFY(flies(simulator, masterHost, master));
        QVERIFY(counter->counters().cycles >= 1000);
        QCOMPARE(counter->counters().forged + echo->counters().forged, quint64(0));
        masterHost.call([master] { master->stop(); });
    });
}

void tst_SimulatedSecurity::theSameSeedGivesTheSameDigest()
{
    const auto digestOf = [this](quint64 seed) {
        quint64 digest = 0;
        QPlcSimulator::run(seed, [&](QPlcSimulator &simulator) {
            QPlcSimulatedHost masterHost(simulator, "master"), counterHost(simulator, "counter");
            TestMaster *master = startMaster(masterHost, QPlcSecurity::preSharedKeys(m_files.masterKeys()));
            startNode<CounterNode>(counterHost, masterHost, m_files.counter());
            simulator.runUntil([&] { return master->nodes().size() == 1; }, 5s);
            if (flies(simulator, masterHost, master))
                digest = simulator.digest();
        });
        return digest;
    };
    const quint64 first = digestOf(7);
    QVERIFY(first != 0);
    QCOMPARE(digestOf(7), first);
    QVERIFY(digestOf(8) != first);
}

void tst_SimulatedSecurity::nodeWithoutKeyGetsTheReason_data()
{
    QTest::addColumn<QPlcSecurity>("security");
    QTest::addColumn<QString>("told");
    QTest::newRow("a wrong key") << m_files.of("Counter", 'f') << "the key of identity 'Counter' is not the one";
    QTest::newRow("an unknown identity") << m_files.of("Nobody", 'a') << "does not know identity 'Nobody'";
    QTest::newRow("no security") << QPlcSecurity() << "this master is secured";
    QTest::newRow("the name of another") << m_files.echo() << "identity";
}

void tst_SimulatedSecurity::nodeWithoutKeyGetsTheReason()
{
    QFETCH(QPlcSecurity, security);
    QFETCH(QString, told);
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        const LogCapture log;
        QPlcSimulatedHost masterHost(simulator, "master"), counterHost(simulator, "counter");
        TestMaster *master = startMaster(masterHost, QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        QVERIFY(master);
        auto *counter = startNode<CounterNode>(counterHost, masterHost, security);
        QVERIFY2(simulator.runUntil([&] { return counter->errorString().contains(told); }, 10s),
                 qPrintable(counter->errorString()));
        QVERIFY(master->nodes().isEmpty());
    });
}

void tst_SimulatedSecurity::securedNodeReportsAnUnsecuredMaster()
{
    QPlcSimulator::run(1, [this](QPlcSimulator &simulator) {
        const LogCapture log;
        QPlcSimulatedHost masterHost(simulator, "master"), counterHost(simulator, "counter");
        QVERIFY(startMaster(masterHost, QPlcSecurity()));
        auto *counter = startNode<CounterNode>(counterHost, masterHost, m_files.counter());
        QVERIFY2(simulator.runUntil([&] { return counter->errorString().contains("the master is not secured"); }, 10s),
                 qPrintable(counter->errorString()));
    });
}

/// A road that is cut in the middle of a handshake: the next attempt gets in.
void tst_SimulatedSecurity::handshakeSucceedsAfterALinkOutage()
{
    QPlcSimulator::run(1, [this](QPlcSimulator &simulator) {
        const LogCapture log;
        QPlcSimulatedHost masterHost(simulator, "master"), counterHost(simulator, "counter");
        TestMaster *master = startMaster(masterHost, QPlcSecurity::preSharedKeys(m_files.masterKeys()));
        QVERIFY(master);
        QPlcSimulatedRoad slow;
        slow.delay = 40ms;
        simulator.setRoads(slow);
        startNode<CounterNode>(counterHost, masterHost, m_files.counter());
        simulator.runFor(100ms);  // connected, and greeted
        QPlcSimulatedRoad cut;
        cut.isCut = true;
        simulator.setRoads(cut);
        simulator.runFor(20s);
        QVERIFY(master->nodes().isEmpty());
        simulator.resetRoads();
        simulator.setRoads({});
        QVERIFY(simulator.runUntil([&] { return master->nodes().size() == 1; }, 60s));
    });
}

void tst_SimulatedSecurity::silentMasterIsGivenUp()
{
    const auto connectToNobody = [this](const QPlcUnderlyingProtocol &place) {
        qplc::ControlListener dumb;
        QVERIFY(dumb.listen(place.address(), place.port()));
        dumb.setAttentive(false);  // what comes stays in the queue of the system
        QPlcMasterSocket socket;
        socket.setSecurity(m_files.counter());
        QSignalSpy errors(&socket, &QPlcAbstractSocket::errorOccurred);
        socket.connectToMaster(place);
        pass(4990ms);
        QVERIFY(errors.isEmpty());
        pass(20ms);
        QCOMPARE(errors.size(), 1);
        QCOMPARE(socket.error(), QPlcAbstractSocket::TimeoutError);
        QVERIFY(!socket.isConnected());
    };
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        const LogCapture log;
        QPlcSimulatedHost host(simulator, "machine");
        host.call([&] { connectToNobody(host.place()); });
    });
}

QTEST_GUILESS_MAIN(tst_SimulatedSecurity)
#include "tst_SimulatedSecurity.moc"
