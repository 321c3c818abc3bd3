// SPDX-License-Identifier: Apache-2.0
#include <QtPlcTest>

#include <QtTest/QTest>

using StepResult = QPlcMasterNode::StepResult;
using namespace std::chrono_literals;

// A program on a simulated host that turns the clock of its master.
class tst_SimulatedHostThread : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stepsAreCompleteInVirtualTime();
    void theSameSeedGivesTheSameSteps();
    void aKilledNodeEndsTheStep();
    void aKilledHostEndsItsThread();
};

namespace {

class Winch : public QPlcCompactSlaveNode
{
public:
    Winch()
        : QPlcCompactSlaveNode(QStringLiteral("Winch"))
    {
    }

private:
    QPlcOutput<double> m_length{this, "tetherLength"};  // [m]
    void reset() override { m_length = 300.0; }
    void step(const QPlcCycle &cycle) override { m_length = m_length + cycle.dt(); }
};

/// A master whose clock is turned, and a winch on another host.
struct Plant
{
    explicit Plant(QPlcSimulator &owner)
        : simulator(owner)
        , masterHost(owner, QStringLiteral("master"))
        , winchHost(owner, QStringLiteral("winch"))
        , master(masterHost.start<QPlcMasterNode>())
    {
        masterHost.call([&] {
            master->setSignalTable(QPlcSignalTable::fromIni("[tetherLength]\ntype = Real64\n"));
            master->setClock(QPlcClock::external());
            master->startServer(masterHost.place());
        });
        winchHost.call([&, winch = winchHost.start<Winch>()] { winch->connectToMaster(masterHost.place()); });
    }
    bool begin()
    {
        if (!simulator.runUntil([&] { return master->nodes().size() == 1; }, 5s))
            return false;
        masterHost.call([&] { master->startRealTime(); });
        return simulator.runUntil([&] { return master->state() == QPlcMasterNode::RealTime; }, 5s);
    }
    /// Begins to step until a step is not complete, or \a most were.
    void turn(int most)
    {
        masterHost.startThread([this, most] {
            for (last = StepResult::Complete; last == StepResult::Complete && steps < most; ++steps)
                last = master->step();
            hasEnded = true;
        });
    }

    QPlcSimulator &simulator;
    QPlcSimulatedHost masterHost;
    QPlcSimulatedHost winchHost;
    QPlcMasterNode *master;
    StepResult last = StepResult::Busy;
    int steps = 0;
    bool hasEnded = false;
};

}  // namespace

void tst_SimulatedHostThread::stepsAreCompleteInVirtualTime()
{
    QPlcSimulator::run(1, [](QPlcSimulator &simulator) {
        Plant plant(simulator);
        QVERIFY(plant.begin());
        plant.turn(100);
        QVERIFY(simulator.runUntil([&] { return plant.hasEnded; }, 10s));
        QCOMPARE(plant.last, StepResult::Complete);
        QCOMPARE(plant.master->statistics().cycles, quint64(100));
        const double length = plant.master->signalValue("tetherLength").toReal();
        QVERIFY(length > 300.99 && length < 301.01);
    });
}

void tst_SimulatedHostThread::theSameSeedGivesTheSameSteps()
{
    QVector<quint64> digests;
    for (int run = 0; run < 2; ++run) {
        QPlcSimulator::run(7, [&](QPlcSimulator &simulator) {
            Plant plant(simulator);
            QVERIFY(plant.begin());
            plant.turn(50);
            simulator.runFor(1s);
            digests << simulator.digest() << plant.master->statistics().imageDigest;
        });
    }
    QCOMPARE(digests.size(), 4);
    QCOMPARE(digests.at(2), digests.at(0));
    QCOMPARE(digests.at(3), digests.at(1));
}

void tst_SimulatedHostThread::aKilledNodeEndsTheStep()
{
    QPlcSimulator::run(3, [](QPlcSimulator &simulator) {
        Plant plant(simulator);
        QVERIFY(plant.begin());
        plant.winchHost.setStopped(true);
        plant.turn(100);
        simulator.runFor(100ms);
        QVERIFY(!plant.hasEnded);
        plant.winchHost.kill();
        QVERIFY(simulator.runUntil([&] { return plant.hasEnded; }, 1s));
        QCOMPARE(plant.last, StepResult::Late);
        QCOMPARE(plant.steps, 1);
    });
}

void tst_SimulatedHostThread::aKilledHostEndsItsThread()
{
    QPlcSimulator::run(4, [](QPlcSimulator &simulator) {
        Plant plant(simulator);
        QVERIFY(plant.begin());
        plant.winchHost.setStopped(true);
        plant.turn(100);
        simulator.runFor(100ms);
        QVERIFY(!plant.hasEnded);
        plant.masterHost.kill();
        QVERIFY(plant.hasEnded);
        QCOMPARE(plant.last, StepResult::Stopped);
    });
}

QTEST_GUILESS_MAIN(tst_SimulatedHostThread)
#include "tst_SimulatedHostThread.moc"
