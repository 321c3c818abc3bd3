// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedNode.h"
#include "SecurityFixtures.h"
#include "VirtualTime.h"
#include "node/api/QPlcMasterNodePrivate.h"

using namespace std::chrono_literals;

// Frames carry the lower 32 bits of the number of their cycle. A master that runs long enough, or
// in many phases, passes the end of these numbers while its cycles run, and nobody notices.
class tst_CycleWrap : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyTransportGivesTheSameBits_data();
    void everyTransportGivesTheSameBits();
    void nothingIsLateOrLost();
    void skippedCyclesAreNotLost();
    void copiesAndMixedOrderAreNeverAppliedTwiceOrBackwards();
    void nodesJoinAroundTheWrap();
    void listenerOfFewCyclesIsToldEachOfItsTurns();
    void framesOfThePhaseBeforeAreOld();
    void oldAndEarlyAnswersAreNotTaken();
};

namespace {

constexpr quint64 Wrap = Q_UINT64_C(1) << 32;

/// As runInVirtualTime(), with the table of the tests for lists of signals: each simulated program
/// has its own.
void runPlant(const std::function<void()> &code)
{
    runInVirtualTime([&code] {
        QPlcSignalIndexTable::setCurrent(testTable());
        code();
    });
}

/// The next phase of \a master, which has a table, begins \a cycles before the wrap.
void beginBefore(const TestMaster &master, quint64 cycles)
{
    QPlcMasterNodePrivate::of(master).parts->cycle.setCycleZero(Wrap - cycles);
}

QVector<quint64> cyclesUpTo(quint64 end)
{
    QVector<quint64> cycles;
    for (quint64 cycle = 0; cycle < end; ++cycle)
        cycles << cycle;
    return cycles;
}

bool isIncreasing(const QVector<quint64> &cycles)
{
    return std::adjacent_find(cycles.begin(), cycles.end(), std::greater_equal<>()) == cycles.end();
}

/// A counter in the process of its master; Echo and a listener outside of it.
struct Plant
{
    /// \param limit  of the cycles of its phases; 0: none
    explicit Plant(quint64 limit = 0)
    {
        master.setInterval(5ms);
        master.setCycleLimit(limit);
        echo.onStep = [this](const QPlcCycle &cycle) { cycles << cycle.number(); };
    }
    ~Plant()
    {
        echo.disconnectFromMaster();
        listener.disconnectFromMaster();
    }
    bool isThere() { return master.addLocalNode(&counter) && master.listen(); }
    bool start(const QString &kind, quint64 before)
    {
        if (!isThere() || !master.admit(echo, kind) || !master.admit(listener, kind))
            return false;
        beginBefore(master, before);
        return master.startRealTime();
    }
    bool isOver()
    {
        return master.waitForState(QPlcMasterNode::Off)
            && waitUntil([&] { return echo.state() == QPlcSlaveNode::Off && listener.state() == QPlcSlaveNode::Off; });
    }
    std::array<const QPlcSlaveNode *, 2> nodes() const { return {&echo, &listener}; }
    QPlcNodeInfo infoOfEcho() const { return master.nodes().at(1); }

    TestMaster master{QPlcClock::realTime()};
    CounterNode counter;
    EchoNode echo;
    CountListener listener;
    QVector<quint64> cycles;  // of Echo
};

/// \param kind  as for TestMaster::admit(), or "shared"
bool admit(TestMaster &master, QPlcSlaveNode &node, const QString &kind)
{
    return kind == QLatin1String("shared")
        ? node.connectToMasterAndWaitForConnected(QPlcUnderlyingProtocol::local(QString::number(master.serverPort())))
        : master.admit(node, kind);
}

quint64 digestWithoutWrap(quint64 cycles)
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    master.setCycleLimit(cycles);
    if (!master.addLocalNode(&counter) || !master.addLocalNode(&echo) || !master.startRealTime()
        || !master.waitForState(QPlcMasterNode::Off))
        return 0;
    return master.statistics().imageDigest;
}

}  // namespace

void tst_CycleWrap::everyTransportGivesTheSameBits_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<bool>("isSealed");
    QTest::newRow("in process") << "local" << false;
    QTest::newRow("tcp") << "tcp" << false;
    QTest::newRow("udp") << "udp" << false;
    QTest::newRow("multicast") << "udp-multicast" << false;
    QTest::newRow("shared memory") << "shared" << false;
    QTest::newRow("sealed tcp") << "tcp" << true;
    QTest::newRow("sealed udp") << "udp" << true;
}

void tst_CycleWrap::everyTransportGivesTheSameBits()
{
    QFETCH(QString, kind);
    QFETCH(bool, isSealed);
    constexpr quint64 cycles = 400;
    const SecurityFiles files;
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    if (isSealed) {
        master.setSecurity(QPlcSecurity::preSharedKeys(files.masterKeys()));
        counter.setSecurity(files.counter());
        echo.setSecurity(files.echo());
    }
    master.setCycleLimit(cycles);
    if (kind == "udp-multicast")
        master.setMulticastGroup(QHostAddress("239.255.76.69"));
    QVERIFY2(master.listen(), qPrintable(master.errorString()));
    for (QPlcSlaveNode *node : {static_cast<QPlcSlaveNode *>(&counter), static_cast<QPlcSlaveNode *>(&echo)})
        QVERIFY2(admit(master, *node, kind), qPrintable(node->errorString()));
    beginBefore(master, cycles / 2);
    QVERIFY2(isSealed ? master.startArmed() : master.startRealTime(), qPrintable(master.errorString()));
    QVERIFY(waitUntil([&] { return master.statistics().cycles == cycles; }));
    QVERIFY(master.waitForState(QPlcMasterNode::Off));
    QCOMPARE(master.statistics().imageDigest, digestWithoutWrap(cycles));
    for (const QPlcNodeInfo &node : master.nodes()) {
        QCOMPARE(node.rejected + node.forged, quint64(0));
        QCOMPARE(node.lateAnswers, quint64(0));
    }
    counter.disconnectFromMaster();
    echo.disconnectFromMaster();
}

void tst_CycleWrap::nothingIsLateOrLost()
{
    runPlant([] {
        constexpr quint64 cycles = 400;
        Plant plant(cycles);
        plant.echo.activateWatchdog(12ms);  // a wrap that costs two cycles would trip it
        QVERIFY(plant.start(datagrams(), cycles / 2) && plant.isOver());
        QCOMPARE(plant.cycles, cyclesUpTo(cycles));
        QCOMPARE(plant.listener.takeCycles(), cyclesUpTo(cycles));
        QCOMPARE(plant.master.statistics().cycles, cycles);
        QCOMPARE(plant.master.statistics().skippedCycles, quint64(0));
        QCOMPARE(plant.master.cycleStatistics().nodes.at(1).answers, cycles);
        QCOMPARE(plant.infoOfEcho().lateAnswers + plant.infoOfEcho().duplicates + plant.infoOfEcho().rejected,
                 quint64(0));
        for (const QPlcSlaveNode *node : plant.nodes()) {
            const QPlcSlaveNode::Counters counters = node->counters();
            QCOMPARE(counters.cycles, cycles);
            QCOMPARE(counters.missed + counters.skipped + counters.duplicated + counters.outdated + counters.rejected,
                     quint64(0));
            QCOMPARE(counters.watchdog, quint64(0));
        }
    });
}

void tst_CycleWrap::skippedCyclesAreNotLost()
{
    runPlant([] {
        constexpr quint64 cycles = 400;
        Plant plant(cycles);
        plant.counter.onStep = [](const QPlcCycle &cycle) {
            if (cycle.number() == cycles / 2 - 3)
                beBusyFor(32ms);  // the wrap is among the cycles that the master leaves out
        };
        QVERIFY(plant.start(datagrams(), cycles / 2) && plant.isOver());
        const quint64 skipped = plant.master.statistics().skippedCycles;
        QVERIFY(skipped > 3);
        QVERIFY(!plant.cycles.contains(cycles / 2) && isIncreasing(plant.cycles));
        QCOMPARE(plant.listener.takeCycles(), plant.cycles);
        for (const QPlcSlaveNode *node : plant.nodes()) {
            QCOMPARE(node->counters().cycles, cycles - skipped);
            QCOMPARE(node->counters().skipped, skipped);
            QCOMPARE(node->counters().missed, quint64(0));
        }
    });
}

void tst_CycleWrap::copiesAndMixedOrderAreNeverAppliedTwiceOrBackwards()
{
    runPlant([] {
        constexpr quint64 cycles = 600;
        Plant plant(cycles);
        QVERIFY(plant.echo.setFaultPlan("loss=10%,duplicate=30%,reorder=30%,jitter=4ms,seed=5"));
        double last = -1.0;
        bool isEchoInOrder = true;
        plant.counter.onStep = [&](const QPlcCycle &cycle) {
            const double echo = plant.counter.newestEcho();
            isEchoInOrder = isEchoInOrder && (echo >= last || cycle.number() == 1);  // 0: the initial echo
            last = echo;
        };
        QVERIFY(plant.start(datagrams(), cycles / 2) && plant.isOver());
        const QPlcSlaveNode::Counters counters = plant.echo.counters();
        QVERIFY(isIncreasing(plant.cycles) && isEchoInOrder);
        QVERIFY(plant.cycles.last() > cycles - 20 && last > double(cycles - 20));
        QVERIFY(counters.duplicated > 50 && counters.outdated > 20 && counters.missed > 50);
        QCOMPARE(counters.cycles + counters.missed, cycles);
        QCOMPARE(counters.skipped + counters.rejected, quint64(0));
        QVERIFY(plant.infoOfEcho().duplicates > 50);
        QCOMPARE(plant.infoOfEcho().rejected, quint64(0));
        QCOMPARE(plant.listener.takeCycles(), cyclesUpTo(cycles));  // its link has no faults
    });
}

/// A node is told the first cycle that may come, then some more pass until it is ready.
void tst_CycleWrap::nodesJoinAroundTheWrap()
{
    for (quint64 before = 1; before <= 20; ++before) {
        runPlant([before] {
            Plant plant;
            QVERIFY(plant.isThere());
            beginBefore(plant.master, 10 + before);
            QVERIFY(plant.master.startRealTime() && plant.master.waitForCycles(10));
            plant.listener.connectToMaster(plant.master.protocol(datagrams()));
            QVERIFY(plant.master.admit(plant.echo, datagrams()) && plant.master.waitForCycles(100));
            QVERIFY(plant.cycles.size() > 60);
            for (int i = 1; i < plant.cycles.size(); ++i)
                QCOMPARE(plant.cycles.at(i), plant.cycles.first() + quint64(i));
            const QVector<quint64> heard = plant.listener.takeCycles();
            QVERIFY(heard.size() > 60);
            QCOMPARE(heard.last() - heard.first() + 1, quint64(heard.size()));
            QCOMPARE(plant.echo.counters().missed + plant.listener.counters().missed, quint64(0));
            QCOMPARE(plant.infoOfEcho().lateAnswers, quint64(0));
            plant.master.stop();
            QVERIFY(plant.isOver());
        });
    }
}

/// What was not sent is counted modulo 2^16: that wraps, too.
void tst_CycleWrap::listenerOfFewCyclesIsToldEachOfItsTurns()
{
    runPlant([] {
        constexpr int interval = 1000;
        constexpr quint64 cycles = 140 * interval;
        TestMaster master(QPlcClock::realTime());
        CounterNode counter;
        CountListener listener(interval);
        master.setInterval(1ms);
        master.setCycleLimit(cycles);
        QVERIFY(master.addLocalNode(&counter) && master.listen() && master.admit(listener, datagrams()));
        beginBefore(master, cycles / 2 + 500);
        QVERIFY(master.startRealTime());
        QVERIFY(waitUntil([&] { return master.state() == QPlcMasterNode::Off; }, 200'000));
        QVERIFY(waitUntil([&] { return listener.state() == QPlcSlaveNode::Off; }));
        const QVector<quint64> heard = listener.takeCycles();
        QCOMPARE(heard.size(), 140);
        for (int i = 1; i < heard.size(); ++i)
            QCOMPARE(heard.at(i), quint64(i) * interval);
        QCOMPARE(listener.counters().missed + listener.counters().skipped, quint64(0));
        listener.disconnectFromMaster();
    });
}

void tst_CycleWrap::framesOfThePhaseBeforeAreOld()
{
    runPlant([] {
        constexpr quint64 cycles = 20;
        TestMaster master;
        ScriptedNode node;
        node.answerAll();
        master.setCycleLimit(cycles);
        QVERIFY(master.listen() && node.registerAt(master.serverPort()));
        beginBefore(master, cycles);
        QVERIFY(master.startRealTime() && master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(node.requests.last().cycle, Wrap - 1);
        node.onRequest = [&node](const ScriptedNode::Request &request) {
            node.answer(Wrap - 1, 9.0);  // of the phase before
            node.answer(request.cycle, 2.0);
        };
        QVERIFY(master.startRealTime() && master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(node.requests.at(int(cycles)).cycle, Wrap);  // cycle 0 of this one
        QCOMPARE(master.statistics().cycles, cycles);
        QCOMPARE(master.signalValue("echo").toReal(), 2.0);
        QCOMPARE(master.cycleStatistics().nodes.first().reordered, cycles);
    });
}

void tst_CycleWrap::oldAndEarlyAnswersAreNotTaken()
{
    runPlant([] {
        constexpr quint64 cycles = 20;
        TestMaster master;
        ScriptedNode node;
        node.onRequest = [&node](const ScriptedNode::Request &request) {
            node.answer(request.cycle + 1, 8.0);  // not asked for yet
            node.answer(request.cycle, double(request.cycle - Wrap + cycles / 2));
            node.answer(request.cycle, 8.0);
            node.answer(request.cycle - 1, 9.0);
        };
        QVERIFY(master.listen() && node.registerAt(master.serverPort()));
        master.setCycleLimit(cycles);
        beginBefore(master, cycles / 2);
        QVERIFY(master.startRealTime() && master.waitForState(QPlcMasterNode::Off));
        QCOMPARE(master.statistics().cycles, cycles);
        QCOMPARE(master.signalValue("echo").toReal(), double(cycles - 1));
        QVERIFY(master.nodes().first().rejected >= cycles - 1);
    });
}

QTEST_GUILESS_MAIN(tst_CycleWrap)
#include "tst_CycleWrap.moc"
