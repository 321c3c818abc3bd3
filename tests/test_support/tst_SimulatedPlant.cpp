// SPDX-License-Identifier: Apache-2.0
#include "test_support/FrameWire.h"
#include "test_support/SimulatedHost.h"
#include "test_support/SimulatedTransport.h"

#include <QtPlcCore>

#include <QtCore/QProcess>
#include <QtTest/QTest>

using namespace qplc;

namespace {

constexpr std::int64_t Second = 1'000'000'000;  // [ns]
constexpr quint16 MasterPort = 50000;

QPlcSignalTable winchTable()
{
    QVector<QPlcParseError> errors;
    return QPlcSignalTable::fromIni(R"(
[tetherSpeed]
type = Real64
[tetherLength]
type = Real64
)",
                                    &errors);
}

class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
        setSignalTable(winchTable());
    }
    ~Winch() override { disconnectFromMaster(); }

private:
    void reset() override { m_length = 300.0; }
    void step(const QPlcCycle &cycle) override { m_length = m_length + m_speed * cycle.dt(); }

    QPlcInput<double> m_speed{this, "tetherSpeed"};
    QPlcOutput<double> m_length{this, "tetherLength"};
};

class Autopilot : public QPlcCompactSlaveNode
{
public:
    Autopilot()
        : QPlcCompactSlaveNode(QStringLiteral("Autopilot"))
    {
        setSignalTable(winchTable());
    }
    ~Autopilot() override { disconnectFromMaster(); }

private:
    void reset() override { m_speed = 0.0; }
    void step(const QPlcCycle &) override { m_speed = m_length < 400.0 ? 1.0 : -1.0; }

    QPlcInput<double> m_length{this, "tetherLength"};
    QPlcOutput<double> m_speed{this, "tetherSpeed"};
};

/// Notes of which cycles it hears.
class Screen : public QPlcCompactSlaveNode
{
public:
    Screen()
        : QPlcCompactSlaveNode(QStringLiteral("Screen"))
    {
        setSignalTable(winchTable());
        setListener(true);
    }
    ~Screen() override { disconnectFromMaster(); }

    QVector<quint64> heard;  // cycles
    quint64 missed = 0;      // of them it was told

private:
    void step(const QPlcCycle &cycle) override
    {
        heard << cycle.number();
        missed += cycle.missedCycles();
    }

    QPlcInput<double> m_length{this, "tetherLength"};
};

QHostAddress address(int number)
{
    return QHostAddress(QStringLiteral("127.0.1.%1").arg(number));
}

QPlcUnderlyingProtocol masterPlace()
{
    return QPlcUnderlyingProtocol::fromString(QStringLiteral("sim://127.0.1.1:%1").arg(MasterPort));
}

template<typename Node>
std::shared_ptr<Node> connectedNode()
{
    auto node = std::make_shared<Node>();
    node->setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);
    node->connectToMaster(masterPlace());
    return node;
}

/// A master with two nodes.
class Plant
{
public:
    explicit Plant(Simulator &simulator)
        : m_simulator(simulator)
        , masterHost(simulator, QStringLiteral("master"), address(1))
        , winch(simulator, QStringLiteral("winch"), address(2))
        , autopilot(simulator, QStringLiteral("autopilot"), address(3))
    {
        masterHost.start([this] {
            auto made = std::make_shared<QPlcMasterNode>();
            master = made.get();
            master->setSignalTable(winchTable());
            master->setInterval(std::chrono::milliseconds(10));
            master->startServer(QPlcUnderlyingProtocol::tcp(address(1), MasterPort));
            return made;
        });
        startWinch();
        autopilot.start(&connectedNode<Autopilot>);
    }
    void startWinch()
    {
        winch.start([this] {
            auto node = connectedNode<Winch>();
            winchNode = node.get();
            return node;
        });
    }
    quint64 winchCycles() const { return winchNode->counters().cycles; }
    bool isComplete() const { return master->nodes().size() == 2; }
    bool becomesComplete()
    {
        return m_simulator.runUntil([this] { return isComplete(); }, 10 * Second);
    }
    bool starts()
    {
        masterHost.call([this] { master->initializeAllStates(); });
        if (!reaches(QPlcMasterNode::Ready))
            return false;
        masterHost.call([this] { master->startRealTime(); });
        return reaches(QPlcMasterNode::RealTime);
    }
    bool reaches(QPlcMasterNode::State state)
    {
        return m_simulator.runUntil([this, state] { return master->state() == state; }, 10 * Second);
    }
    void stop()
    {
        masterHost.call([this] { master->stop(); });
    }

private:
    Simulator &m_simulator;

public:
    SimulatedHost masterHost;
    SimulatedHost winch;
    SimulatedHost autopilot;
    QPlcMasterNode *master = nullptr;
    QPlcSlaveNode *winchNode = nullptr;  // the last one
};

/// A minute with a node that is killed and comes back. \return what travelled on the network
quint64 digestOfMinute(quint64 seed)
{
    quint64 digest = 0;
    Simulator::run(seed, [&digest](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(20 * Second);
        plant.winch.kill();
        simulator.runFor(5 * Second);
        plant.startWinch();
        simulator.runFor(35 * Second);
        digest = simulator.digest();
        plant.stop();
    });
    return digest;
}

}  // namespace

class tst_SimulatedPlant : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { SimulatedTransport::install(); }
    void nodesRegisterAtTheirMaster();
    void cyclesKeepTheirPeriodInVirtualTime();
    void killedNodeIsLostAndReconnects();
    void sameSeedGivesSameTraffic();
    void otherSeedGivesOtherTraffic();
    void programsHaveTablesOfTheirOwn();
    void aProgramThatStartsAgainHasNoTable();
    void sameSeedGivesSameTrafficInOtherProcess();
    void halfOpenConnectionIsClosed();
    void stoppedProgramResumes();
    void stoppedListenerKnowsOfEveryCycle();
    void lostAndDuplicateFramesAreTolerated();
    void echoReachesTheNextOwnerOfAPort();
    void cyclesResumeAfterALinkOutage();
    void driftingClockIsTolerated();
    void cycleBodyRunsBeforeAnImmediateStop();
};

void tst_SimulatedPlant::nodesRegisterAtTheirMaster()
{
    bool areComplete = false;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        areComplete = plant.becomesComplete();
    });
    QVERIFY(areComplete);
}

void tst_SimulatedPlant::cyclesKeepTheirPeriodInVirtualTime()
{
    quint64 cycles = 0;
    quint64 late = 0;
    double length = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(60 * Second);
        plant.masterHost.call([&] {
            cycles = plant.master->statistics().cycles;
            late = plant.master->statistics().overruns;
            length = plant.master->signalValue(QStringLiteral("tetherLength")).toReal();
        });
        plant.stop();
    });
    QVERIFY2(cycles >= 5999 && cycles <= 6002, qPrintable(QString::number(cycles)));
    QCOMPARE(late, quint64(0));
    QVERIFY2(length > 359 && length < 361, qPrintable(QString::number(length)));  // 1 m/s from 300 m on
}

void tst_SimulatedPlant::killedNodeIsLostAndReconnects()
{
    bool wasMissed = false;
    bool isBack = false;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(Second);
        plant.winch.kill();
        wasMissed = simulator.runUntil([&] { return !plant.isComplete(); }, 10 * Second);
        plant.startWinch();
        isBack = plant.becomesComplete();
        plant.stop();
    });
    QVERIFY(wasMissed);
    QVERIFY(isBack);
}

void tst_SimulatedPlant::sameSeedGivesSameTraffic()
{
    const quint64 digest = digestOfMinute(7);
    QVERIFY(digest != 0);
    QCOMPARE(digestOfMinute(7), digest);
}

void tst_SimulatedPlant::otherSeedGivesOtherTraffic()
{
    QVERIFY(digestOfMinute(7) != digestOfMinute(8));
}

void tst_SimulatedPlant::programsHaveTablesOfTheirOwn()
{
    const QPlcSignalTable ofProcess = QPlcSignalIndexTable::current();
    Simulator::run(1, [&](Simulator &simulator) {
        SimulatedHost winch(simulator, QStringLiteral("winch"), address(2));
        SimulatedHost screen(simulator, QStringLiteral("screen"), address(3));
        const auto nothing = [] { return std::make_shared<int>(0); };
        winch.start(nothing);
        screen.start(nothing);
        winch.call([] { QPlcSignalIndexTable::setCurrent(winchTable()); });
        winch.call([] { QCOMPARE(QPlcSignalIndexTable::current().size(), 2); });
        screen.call([] { QVERIFY(QPlcSignalIndexTable::current().isEmpty()); });
    });
    QCOMPARE(QPlcSignalIndexTable::current().toIni(), ofProcess.toIni());
}

void tst_SimulatedPlant::aProgramThatStartsAgainHasNoTable()
{
    Simulator::run(1, [&](Simulator &simulator) {
        SimulatedHost winch(simulator, QStringLiteral("winch"), address(2));
        winch.start([] {
            QPlcSignalIndexTable::setCurrent(winchTable());
            return std::make_shared<int>(0);
        });
        winch.kill();
        winch.start([] { return std::make_shared<int>(0); });
        winch.call([] { QVERIFY(QPlcSignalIndexTable::current().isEmpty()); });
    });
}

void tst_SimulatedPlant::sameSeedGivesSameTrafficInOtherProcess()
{
    if (qEnvironmentVariableIsSet("SIMULATED_PLANT_DIGEST")) {
        QFile file(qEnvironmentVariable("SIMULATED_PLANT_DIGEST"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(QByteArray::number(digestOfMinute(7)));
        return;
    }
    QTemporaryDir folder;
    QProcess other;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("SIMULATED_PLANT_DIGEST"), folder.filePath(QStringLiteral("digest")));
    environment.insert(QStringLiteral("QT_HASH_SEED"), QStringLiteral("4711"));
    other.setProcessEnvironment(environment);
    other.start(QCoreApplication::applicationFilePath(), {QStringLiteral("sameSeedGivesSameTrafficInOtherProcess")});
    QVERIFY(other.waitForFinished(120'000));
    QFile file(folder.filePath(QStringLiteral("digest")));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll(), QByteArray::number(digestOfMinute(7)));
}

void tst_SimulatedPlant::halfOpenConnectionIsClosed()
{
    bool wasMissed = false;
    std::int64_t noticed = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        const std::int64_t begin = simulator.now();
        plant.winch.kill(SimulatedHost::End::Power);
        wasMissed = simulator.runUntil([&] { return !plant.isComplete(); }, 60 * Second);
        noticed = simulator.now() - begin;
        plant.stop();
    });
    QVERIFY(wasMissed);
    QVERIFY2(noticed > Second, "the kernel of a computer without power tells nobody");
}

void tst_SimulatedPlant::stoppedProgramResumes()
{
    quint64 duringStop = 0;
    quint64 behindIt = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(Second);
        plant.winch.setStopped(true);
        const quint64 before = plant.winchCycles();
        simulator.runFor(Second / 2);
        duringStop = plant.winchCycles() - before;
        plant.winch.setStopped(false);
        simulator.runFor(Second);
        behindIt = plant.winchCycles() - before;
        plant.stop();
    });
    QCOMPARE(duringStop, quint64(0));
    QVERIFY2(behindIt >= 95, qPrintable(QString::number(behindIt)));
}

void tst_SimulatedPlant::stoppedListenerKnowsOfEveryCycle()
{
    QVector<quint64> heard;
    quint64 missed = 0;
    QPlcSlaveNode::Counters counters;
    quint64 end = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        SimulatedHost host(simulator, QStringLiteral("screen"), address(4));
        Screen *screen = nullptr;
        host.start([&screen] {
            auto node = connectedNode<Screen>();
            screen = node.get();
            return node;
        });
        const auto areThere = [&plant] { return plant.master->nodes().size() == 3; };
        if (!simulator.runUntil(areThere, 10 * Second) || !plant.starts())
            return;
        simulator.network().usual.loss = 0.1;
        simulator.runFor(20 * Second);
        host.setStopped(true);
        simulator.runFor(5 * Second);
        host.setStopped(false);
        simulator.runFor(20 * Second);
        host.setStopped(true);  // the end comes, and it does not hear it yet
        simulator.runFor(Second);
        plant.stop();
        end = plant.master->statistics().cycles;
        simulator.runFor(Second);
        host.setStopped(false);
        (void)simulator.runUntil([&] { return screen->state() == QPlcSlaveNode::Off; }, 10 * Second);
        heard = screen->heard;
        missed = screen->missed;
        counters = screen->counters();
    });
    QVERIFY2(end > 4500, qPrintable(QString::number(end)));
    QCOMPARE(quint64(heard.size()), counters.cycles);
    QVERIFY(counters.cycles > 3000);
    QVERIFY(counters.missed > 300);
    QCOMPARE(counters.cycles + counters.missed + counters.skipped, end);
    QCOMPARE(heard.last() + 1, counters.cycles + missed);
}

void tst_SimulatedPlant::lostAndDuplicateFramesAreTolerated()
{
    QPlcSlaveNode::Counters counters;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.network().usual.loss = 0.1;
        simulator.network().usual.duplication = 0.1;
        simulator.runFor(10 * Second);
        counters = plant.winchNode->counters();
        plant.stop();
    });
    QVERIFY(counters.cycles > 800);
    QVERIFY(counters.duplicated > 10);
}

void tst_SimulatedPlant::echoReachesTheNextOwnerOfAPort()
{
    Simulator::run(1, [](Simulator &simulator) {
        simulator.network().usual.echo = 1.0;
        simulator.network().usual.echoTime = Second;
        SimulatedHost here(simulator, QStringLiteral("Here"), QHostAddress(0x7F000101));
        SimulatedHost there(simulator, QStringLiteral("There"), QHostAddress(0x7F000102));
        FrameEnd sender(here, MasterPort);
        auto former = std::make_unique<FrameEnd>(there, MasterPort);
        sender.send(former->key(), "old", 3);
        simulator.runFor(1'000'000);
        QVERIFY(former->take());
        QVERIFY(!former->take());
        former.reset();
        FrameEnd next(there, MasterPort);
        simulator.runFor(Second);
        const SimulatedFrame *echo = next.take();
        QVERIFY(echo);
        QCOMPARE(QByteArray(echo->bytes.data(), int(echo->bytes.size())), QByteArray("old"));
    });
}

void tst_SimulatedPlant::cyclesResumeAfterALinkOutage()
{
    bool isComplete = false;
    quint64 during = 0;
    quint64 behind = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(Second);
        SimulatedRoad cut;
        cut.isCut = true;
        simulator.network().setRoad(plant.masterHost, plant.winch, cut);
        simulator.network().setRoad(plant.winch, plant.masterHost, cut);
        simulator.runFor(Second / 10);  // what was under way has arrived
        const quint64 before = plant.winchCycles();
        simulator.runFor(Second);
        during = plant.winchCycles() - before;
        simulator.network().resetRoads();
        simulator.runFor(2 * Second);
        behind = plant.winchCycles() - before;
        isComplete = plant.isComplete();
        plant.stop();
    });
    QCOMPARE(during, quint64(0));
    QVERIFY2(behind > 150, qPrintable(QString::number(behind)));
    QVERIFY(isComplete);
}

void tst_SimulatedPlant::driftingClockIsTolerated()
{
    quint64 cycles = 0;
    std::int64_t ahead = 0;
    Simulator::run(1, [&](Simulator &simulator) {
        Plant plant(simulator);
        SimulatedHost::Clocks fast;
        fast.offset = 5 * Second;
        fast.drift = 200'000;  // [ns/s]
        plant.winch.setClocks(fast);
        if (!plant.becomesComplete() || !plant.starts())
            return;
        simulator.runFor(60 * Second);
        ahead = plant.winch.now() - simulator.now() - fast.offset;
        cycles = plant.winchCycles();
        plant.stop();
    });
    QVERIFY(ahead >= 12'000'000 && ahead < 13'000'000);
    QVERIFY2(cycles >= 5999 && cycles <= 6002, qPrintable(QString::number(cycles)));
}

/// As SlaveCycle::stop(), which interrupts until the body has ended.
void tst_SimulatedPlant::cycleBodyRunsBeforeAnImmediateStop()
{
    bool hasRun = false;
    Simulator::run(1, [&](Simulator &simulator) {
        SimulatedHost host(simulator, QStringLiteral("winch"), address(1));
        const std::unique_ptr<Strand> strand = host.makeStrand();
        strand->start(QStringLiteral("cycles"), [&] { hasRun = true; });
        strand->interrupt();
        QVERIFY(hasRun);
        strand->join();
    });
    QVERIFY(hasRun);
}

QTEST_GUILESS_MAIN(tst_SimulatedPlant)
#include "tst_SimulatedPlant.moc"
