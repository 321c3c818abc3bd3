// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ScriptedMaster.h"
#include "ScriptedNode.h"
#include "VirtualPlant.h"
#include "VirtualTime.h"
#include "signals/Fnv1a.h"
#include "transport/FaultInjector.h"

#include <QtCore/QScopeGuard>

#include <atomic>
#include <thread>

using namespace std::chrono_literals;

// A whole plant on a network that loses, doubles, delays, mixes and corrupts frames, by a seed.
class tst_BadNetwork : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void wrongPlansAreRefused();
    void faultPlansAreReportedToAllParticipants();
    void nothingIsReportedWithoutAFaultPlan();
    void lockstepGivesTheSameBitsOnABadNetwork_data();
    void lockstepGivesTheSameBitsOnABadNetwork();
    void tenPercentLossMissesTheExpectedShareOfCycles();
    void plantKeepsRunningWithTenPercentLoss();
    void copiesAndMixedOrderAreNeverAppliedTwiceOrBackwards();
    void cyclesResumeAfterALinkOutage_data();
    void cyclesResumeAfterALinkOutage();
    void watchdogDetectsHalfOpenLinkWithoutDelayingOthers();
    void aFloodOfStrangersChangesNoResult();
    void aFloodOfBadFramesOfANodeChangesNoResult();
    void cyclesRunOnOver32Bits();
};

namespace {

constexpr double Loss = 0.1;

/// The stream of a node, in its own direction and in that of its master, as FaultLink numbers them.
qplc::FaultInjector injector(const qplc::FaultPlan::Direction &plan, std::uint64_t seed, bool isReceived)
{
    return {plan, seed, 2 * qplc::fnv1a64("Echo") + (isReceived ? 1 : 0)};
}

struct Misses
{
    int missed = 0;
    int longestRun = 0;
};

/// What becomes of \a cycles cycles: those without an answer, as the request or the answer was
/// lost.
Misses missesOf(std::uint64_t seed, int cycles)
{
    qplc::FaultPlan::Direction plan;
    plan.loss = Loss;
    qplc::FaultInjector requests = injector(plan, seed, true);
    qplc::FaultInjector answers = injector(plan, seed, false);
    Misses misses;
    int run = 0;
    for (int i = 0; i < cycles; ++i) {
        const bool isAnswered = requests.decide(0).passes && answers.decide(0).passes;
        misses.missed += isAnswered ? 0 : 1;
        run = isAnswered ? 0 : run + 1;
        misses.longestRun = std::max(misses.longestRun, run);
    }
    return misses;
}

quint64 digestAfter(TestMaster &master, quint64 cycles)
{
    master.setCycleLimit(cycles);
    if (!master.startRealTime() || !waitUntil([&] { return master.statistics().cycles == cycles; }, 60000)
        || !master.waitForState(QPlcMasterNode::Off))
        return 0;
    return master.statistics().imageDigest;
}

quint64 cleanDigest(quint64 cycles)
{
    TestMaster master;
    CounterNode counter;
    EchoNode echo;
    return master.addLocalNode(&echo) && master.addLocalNode(&counter) ? digestAfter(master, cycles) : 0;
}

/// A master, with its counter and Echo outside of its process, as a network has them.
struct DistantPlant
{
    ~DistantPlant()
    {
        counter.disconnectFromMaster();
        echo.disconnectFromMaster();
    }
    bool connect(const QPlcUnderlyingProtocol &address)
    {
        return echo.connectToMasterAndWaitForConnected(address) && counter.connectToMasterAndWaitForConnected(address);
    }

    TestMaster master;
    CounterNode counter;
    EchoNode echo;
};

}  // namespace

void tst_BadNetwork::wrongPlansAreRefused()
{
    TestMaster master;
    QVERIFY(!master.setFaultPlan("lose=1%"));
    QCOMPARE(master.error(), QPlcMasterNode::StateError);
    QVERIFY2(master.errorString().contains("'lose=1%': use loss"), qPrintable(master.errorString()));
    QVERIFY(master.faultPlan().isEmpty());
    QVERIFY(master.listen());
    QVERIFY(!master.setFaultPlan("loss=1%"));
    QVERIFY2(master.errorString().contains("stop it first"), qPrintable(master.errorString()));
    QVERIFY(master.faultPlan().isEmpty());
    EchoNode echo;
    QVERIFY(!echo.setFaultPlan("loss=a lot"));
    QCOMPARE(echo.error(), QPlcSlaveNode::OptionError);
    QVERIFY2(echo.errorString().contains("'Echo': fault plan: 'loss=a lot'"), qPrintable(echo.errorString()));
    QVERIFY(echo.faultPlan().isEmpty());
}

void tst_BadNetwork::faultPlansAreReportedToAllParticipants()
{
    const LogCapture log;
    TestMaster master;
    QVERIFY(master.setFaultPlan("delay=1ms,seed=3"));
    EchoNode echo;
    QVERIFY(echo.setFaultPlan("loss=5%"));
    QVERIFY(master.listen());
    QVERIFY(master.admit(echo, "udp"));
    QCOMPARE(master.nodes().at(0).faultPlan, QString("loss=5%"));
    QCOMPARE(log.matching("the master injects faults on purpose: delay=1ms,seed=3").size(), 1);
    QCOMPARE(log.matching("node Echo injects faults on purpose: loss=5%").size(), 2);  // by itself, and by its master
    QCOMPARE(log.matching("injects faults on purpose: delay=1ms,seed=3").size(), 2);   // the node tells it, too

    ScriptedTool tool;
    QVERIFY(tool.connectTo(master.serverPort()));
    QJsonObject fields = tool.helloFields();
    fields.insert("role", "tool");
    tool.send(QPlcMessage::Hello, fields);
    QCOMPARE(tool.next().text("faults"), QString("delay=1ms,seed=3"));
    const QPlcMessage state = tool.ask(QPlcMessage::GetState);
    QCOMPARE(state.text("faults"), QString("delay=1ms,seed=3"));
    QCOMPARE(state.fields().value("nodes")[0]["faults"].toString(), QString("loss=5%"));
    const QString events = QString::fromUtf8(QJsonDocument(tool.ask(QPlcMessage::GetEvents).fields()).toJson());
    QVERIFY2(events.contains("node Echo injects faults on purpose: loss=5%"), qPrintable(events));
    QVERIFY2(events.contains("the master injects faults on purpose: delay=1ms,seed=3"), qPrintable(events));
}

void tst_BadNetwork::nothingIsReportedWithoutAFaultPlan()
{
    TestMaster master;
    EchoNode echo;
    QVERIFY(master.setFaultPlan("loss=5%"));
    QVERIFY(master.setFaultPlan({}));
    QVERIFY(master.listen());
    QVERIFY(master.admit(echo, "udp"));
    ScriptedTool tool;
    QVERIFY(tool.greetAt(master.serverPort()));
    QVERIFY(!tool.messages.at(0).fields().contains("faults"));
    const QPlcMessage state = tool.ask(QPlcMessage::GetState);
    QVERIFY(!state.fields().contains("faults"));
    QVERIFY(!state.fields().value("nodes")[0].toObject().contains("faults"));
}

void tst_BadNetwork::lockstepGivesTheSameBitsOnABadNetwork_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("ofMaster");
    QTest::addColumn<QString>("ofNode");
    const char *everything = "loss=5%,duplicate=5%,reorder=5%,corrupt=5%,delay=100us,jitter=300us,seed=4";
    const char *slow = "duplicate=20%,delay=100us,jitter=300us,seed=4";  // what a stream can do to frames
    QTest::newRow("datagrams, master") << "sim" << everything << "";
    QTest::newRow("datagrams, node") << "sim"
                                     << "" << everything;
    QTest::newRow("datagrams, both") << "sim" << everything << everything;
    QTest::newRow("udp, both") << "udp" << everything << everything;
    QTest::newRow("tcp, both") << "tcp" << slow << slow;
    QTest::newRow("local, both") << "local" << slow << slow;
}

void tst_BadNetwork::lockstepGivesTheSameBitsOnABadNetwork()
{
    QFETCH(QString, kind);
    QFETCH(QString, ofMaster);
    QFETCH(QString, ofNode);
    const quint64 cycles = kind == "sim" ? 2000 : 50;
    const auto fly = [&] {
        DistantPlant plant;
        QVERIFY(plant.master.setFaultPlan(ofMaster));
        QVERIFY(plant.counter.setFaultPlan(ofNode) && plant.echo.setFaultPlan(ofNode));
        QVERIFY(plant.master.listen());
        const QPlcUnderlyingProtocol address = kind == "local"
            ? QPlcUnderlyingProtocol::fromString(QStringLiteral("local://%1").arg(plant.master.serverPort()))
            : plant.master.protocol(kind);
        QVERIFY(plant.connect(address));
        QCOMPARE(digestAfter(plant.master, cycles), cleanDigest(cycles));
        QCOMPARE(plant.echo.counters().cycles, cycles);
        QCOMPARE(plant.counter.counters().cycles, cycles);
        if (kind == "udp" || kind == "sim")
            QVERIFY(plant.master.nodes().at(0).resent > 0);  // else this test has shown nothing
    };
    if (kind == "sim")
        runInVirtualTime(fly);
    else
        fly();
}

void tst_BadNetwork::tenPercentLossMissesTheExpectedShareOfCycles()
{
    constexpr int cycles = 10'000;
    const double theory = 1.0 - (1.0 - Loss) * (1.0 - Loss);
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Misses misses = missesOf(seed, cycles);
        const double share = double(misses.missed) / cycles;
        QVERIFY2(share <= theory + 0.02 && share >= theory - 0.02, qPrintable(QString::number(share)));
        QVERIFY2(misses.longestRun <= 12, qPrintable(QString::number(misses.longestRun)));
    }
}

/// The losses are those that the seed says, cycle by cycle.
void tst_BadNetwork::plantKeepsRunningWithTenPercentLoss()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        constexpr int cycles = 10'000;
        VirtualPlant plant(simulator, "loss=10%,seed=7", 5ms);
        plant.master->setCycleLimit(cycles);
        QVERIFY(plant.start());
        QVERIFY(plant.waitFor([&] { return plant.master->state() == QPlcMasterNode::Off; }));
        QCOMPARE(plant.master->statistics().cycles, quint64(cycles));
        QCOMPARE(plant.info().lateAnswers, quint64(missesOf(7, cycles).missed));
        QCOMPARE(plant.steps, quint64(cycles));  // the other node never waited
        QVERIFY(plant.isInOrder);
        QVERIFY(plant.echoSteps > quint64(cycles) * 8 / 10);
    });
}

void tst_BadNetwork::copiesAndMixedOrderAreNeverAppliedTwiceOrBackwards()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        VirtualPlant plant(simulator, "duplicate=30%,reorder=30%,jitter=12ms,seed=5", 5ms);
        double newest = 0.5;  // the initial output
        int backwards = 0;
        QVERIFY(plant.start());
        QVERIFY(plant.waitFor([&] {
            const double echo = plant.master->signalValue("echo").toReal();
            backwards += newest >= 1.0 && echo < newest ? 1 : 0;
            newest = echo;
            return plant.echoSteps > 5000;
        }));
        plant.stop();
        QCOMPARE(backwards, 0);
        QVERIFY(plant.isInOrder);
        QVERIFY(plant.echo->counters().duplicated > 0 && plant.echo->counters().outdated > 0);
        QVERIFY(plant.info().duplicates > 0);
    });
}

void tst_BadNetwork::cyclesResumeAfterALinkOutage_data()
{
    QTest::addColumn<QString>("plan");
    QTest::addColumn<bool>("barks");
    QTest::newRow("50 ms") << "cut=200ms+50ms" << true;
    QTest::newRow("500 ms") << "cut=200ms+500ms" << true;
    QTest::newRow("500 ms, nothing arrives") << "cut-received=200ms+500ms" << true;
    QTest::newRow("500 ms, nothing leaves") << "cut-sent=200ms+500ms" << false;
}

void tst_BadNetwork::cyclesResumeAfterALinkOutage()
{
    QFETCH(QString, plan);
    QFETCH(bool, barks);
    QPlcSimulator::run(1, [&](QPlcSimulator &simulator) {
        VirtualPlant plant(simulator, plan.toLatin1().constData(), 5ms);
        plant.echo->activateWatchdog(25ms);
        QSignalSpy barked(plant.echo, &QPlcSlaveNode::watchdogTimedOut);
        QVERIFY(plant.start());
        // Late in a row: the cut; then punctual again.
        QVERIFY(plant.waitFor([&] { return plant.info().lateAnswers >= 8 || barked.size() > 0; }));
        const quint64 during = plant.echoSteps;
        const auto answers = [&] { return plant.master->cycleStatistics().nodes.last().answers; };
        QVERIFY(plant.waitFor([&] { return plant.echoSteps > during + 150; }));
        QCOMPARE(barked.size() > 0, barks);
        const quint64 before = answers();
        QVERIFY(plant.waitFor([&] { return answers() > before + 20; }));
        QCOMPARE(plant.master->state(), QPlcMasterNode::RealTime);
        plant.stop();
        QVERIFY(plant.isInOrder);
        QCOMPARE(plant.steps, plant.master->statistics().cycles);
    });
}

/// The control connection never tells: only the cycles do.
void tst_BadNetwork::watchdogDetectsHalfOpenLinkWithoutDelayingOthers()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        VirtualPlant plant(simulator, "cut-received=100ms", 5ms);
        plant.echo->activateWatchdog(25ms);
        QSignalSpy barked(plant.echo, &QPlcSlaveNode::watchdogTimedOut);
        QSignalSpy safe(plant.echo, &QPlcSlaveNode::safeStateEntered);
        QVERIFY(plant.start());
        QVERIFY(plant.waitFor([&] { return barked.size() > 0; }));
        QVERIFY(plant.waitFor([&] { return safe.size() > 0; }));  // without a word of the master
        const quint64 steps = plant.steps;
        QVERIFY(plant.waitFor([&] { return plant.steps > steps + 50; }));
        QCOMPARE(plant.master->state(), QPlcMasterNode::RealTime);
        plant.stop();
        QCOMPARE(plant.steps, plant.master->statistics().cycles);
    });
}

void tst_BadNetwork::aFloodOfStrangersChangesNoResult()
{
    constexpr quint64 cycles = 2000;
    const quint64 expected = cleanDigest(cycles);
    DistantPlant plant;
    QVERIFY(plant.master.listen() && plant.connect(plant.master.protocol("udp")));
    const quint16 port = plant.master.serverPort();
    std::atomic<bool> stop{false};
    std::thread flood([&stop, port] {
        QUdpSocket stranger;
        const QByteArray garbage(200, char(0x11));
        while (!stop) {  // some 10 000 a second
            for (int i = 0; i < 10; ++i)
                stranger.writeDatagram(garbage, QHostAddress::LocalHost, port);
            std::this_thread::sleep_for(1ms);
        }
    });
    const quint64 digest = digestAfter(plant.master, cycles);
    stop = true;
    flood.join();
    QCOMPARE(digest, expected);
    QVERIFY(plant.master.statistics().strangers > 0);
    QCOMPARE(plant.master.nodes().at(0).rejected, quint64(0));
}

void tst_BadNetwork::aFloodOfBadFramesOfANodeChangesNoResult()
{
    TestMaster master;
    ScriptedNode node;
    node.answerAll();
    QVERIFY(node.beginWith(master));
    const QByteArray good = node.answerFrames(node.requests.at(0).cycle, QPlcValue(9.0).toBytes()).at(0);
    for (int i = 0; i < 5000; ++i) {
        QByteArray bad = good;
        bad[4 + i % (good.size() - 4)] = char(bad.at(4 + i % (good.size() - 4)) ^ (1 + i % 255));
        node.sendFrame(bad);
        if (i % 50 == 0)
            QTest::qWait(1);
    }
    const quint64 before = master.statistics().cycles;
    QVERIFY(master.waitForCycles(before + 100));
    QVERIFY(master.nodes().at(0).rejected > 1000);
    QCOMPARE(master.signalValue("echo").toReal(), 0.0);  // what the node really says
    master.stop();
}

void tst_BadNetwork::cyclesRunOnOver32Bits()
{
    ScriptedMaster master;
    master.first = 0xFFFFFFF8;
    CounterNode node;
    QVector<quint64> numbers;
    node.onStep = [&numbers](const QPlcCycle &cycle) { numbers << cycle.number(); };
    QVERIFY(master.beginWith(node));
    for (quint64 cycle = 0; cycle < 16; ++cycle) {
        master.request(cycle);
        QVERIFY(master.waitForAnswers(int(cycle) + 1));
    }
    master.request(7);  // of before the wrap: old, and not four thousand million cycles ahead
    master.request(16);
    QVERIFY(master.waitForAnswers(17));
    QCOMPARE(node.counters().cycles, quint64(17));
    QCOMPARE(node.counters().missed, quint64(0));
    QCOMPARE(node.counters().outdated, quint64(1));
    node.disconnectFromMaster();
    for (int i = 0; i < 17; ++i)
        QCOMPARE(numbers.at(i), quint64(i));
}

QTEST_GUILESS_MAIN(tst_BadNetwork)
#include "tst_BadNetwork.moc"
