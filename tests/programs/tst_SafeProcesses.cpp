// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtTest/QtTest>

#include <csignal>
#include <memory>

// A master and two nodes as processes of their own: what becomes of the others when one of them is
// killed, stopped or told to end.
class tst_SafeProcesses : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aKilledMasterLeavesItsNodesSafe();
    void stoppedMasterTripsWatchdogsAndStopsSafely();
    void stoppedNodeIsSafeBeforeItComputes();
    void aKilledCriticalNodeStopsThePlantSafely();
    void restartedNodeReturnsWithoutDisturbingOthers();
    void aRestartedMasterFindsItsNodesAndStartsNothing();
    void terminatedProgramEndsInItsSafeState_data();
    void terminatedProgramEndsInItsSafeState();
    void cleanup()
    {
        a.reset();
        b.reset();
        master.reset();
    }

private:
    static constexpr int Watchdog = 300;  // [ms]
    static constexpr int Period = 10;     // [ms]

    static std::unique_ptr<Program> run(const QStringList &arguments)
    {
        return std::make_unique<Program>(QStringLiteral(QTPLC_PROGRAMS "/safe_plant"), arguments);
    }
    std::unique_ptr<Program> node(const char *name, int watchdog, const char *rank) const
    {
        return run({"node", name, port, QString::number(watchdog), rank});
    }
    bool startMaster(int nodes, const QString &wantedPort = "0")
    {
        master = run({"master", wantedPort, QString::number(nodes)});
        if (!master->waitForOutput("port "))
            return false;
        port = master->output().section("port ", 1).section('\n', 0, 0);
        return true;
    }
    /// All three run.
    bool startPlant(int watchdog, const char *rankOfA)
    {
        if (!startMaster(2))
            return false;
        a = node("A", watchdog, rankOfA);
        b = node("B", watchdog, "plain");
        return a->waitForOutput("runs") && b->waitForOutput("runs");
    }
    /// Time from its last step to its safe state, by its own record [ms]; -1: it was not made safe
    /// for this reason.
    static double safeAfter(Program &program, const char *reason)
    {
        const QString begin = QStringLiteral("safe %1 after ").arg(QLatin1String(reason));
        if (!program.waitForOutput(begin))
            return -1.0;
        program.waitForOutput("missed");
        return program.output().section(begin, 1).section(' ', 0, 0).toDouble() * 1e-3;
    }

    std::unique_ptr<Program> master, a, b;
    QString port;
};

void tst_SafeProcesses::aKilledMasterLeavesItsNodesSafe()
{
    QVERIFY(startPlant(Watchdog, "plain"));
    master->sendSignal(SIGKILL);
    for (Program *program : {a.get(), b.get()}) {
        const double time = safeAfter(*program, "MasterLost");  // long before the watchdog
        qInfo("safe %.1f ms after the last step", time);
        QVERIFY(time >= 0.0 && time <= Watchdog + Period);
    }
}

void tst_SafeProcesses::stoppedMasterTripsWatchdogsAndStopsSafely()
{
    QVERIFY(startPlant(Watchdog, "plain"));
    master->sendSignal(SIGSTOP);
    for (Program *program : {a.get(), b.get()}) {
        const double time = safeAfter(*program, "WatchdogReason");
        qInfo("safe %.1f ms after the last step, watchdog %d ms", time, Watchdog);
        QVERIFY(time >= Watchdog - Period);
        QVERIFY(time <= Watchdog + Period + 1000);  // a loaded machine
    }
    QTest::qWait(1100);  // more than its limit
    master->sendSignal(SIGCONT);
    QVERIFY(master->waitForOutput("state SafeStop the master stood still"));
    QVERIFY(a->waitForOutput("registered") && b->waitForOutput("registered"));
}

void tst_SafeProcesses::stoppedNodeIsSafeBeforeItComputes()
{
    QVERIFY(startPlant(Watchdog, "stops"));
    QVERIFY(a->waitForOutput("stops"));
    QTest::qWait(2 * Watchdog);  // meanwhile frames of the master arrive
    a->sendSignal(SIGCONT);
    const double time = safeAfter(*a, "WatchdogReason");
    qInfo("safe %.1f ms after the last step, watchdog %d ms", time, Watchdog);
    QVERIFY(time >= Watchdog);
    QVERIFY(a->waitForOutput("registered"));
}

void tst_SafeProcesses::aKilledCriticalNodeStopsThePlantSafely()
{
    QVERIFY(startPlant(0, "critical"));
    a->sendSignal(SIGKILL);
    QVERIFY(master->waitForOutput("state SafeStop critical node 'A' has left"));
    const double time = safeAfter(*b, "MasterStopsSafely");
    QVERIFY(time >= 0.0);
    a = node("A", 0, "critical");
    QVERIFY(a->waitForOutput("registered"));
    QTest::qWait(200);
    QVERIFY(!a->output().contains("runs"));  // not by itself
}

void tst_SafeProcesses::restartedNodeReturnsWithoutDisturbingOthers()
{
    QVERIFY(startPlant(0, "plain"));
    a->sendSignal(SIGKILL);
    QElapsedTimer watch;
    watch.start();
    a = node("A", 0, "plain");
    QVERIFY(a->waitForOutput("runs"));
    qInfo("back after %lld ms, with its first ten cycles", watch.elapsed());
    QVERIFY(!master->output().contains("SafeStop"));
    b->sendSignal(SIGTERM);
    QCOMPARE(b->waitForEnd(), 0);
    QVERIFY2(b->output().count("safe") == 1 && b->output().contains("safe PhaseEnded"), qPrintable(b->output()));
}

void tst_SafeProcesses::aRestartedMasterFindsItsNodesAndStartsNothing()
{
    QVERIFY(startPlant(0, "plain"));
    const QString samePort = port;
    master->sendSignal(SIGKILL);
    master->waitForEnd();
    QVERIFY(safeAfter(*a, "MasterLost") >= 0.0);
    QVERIFY(startMaster(0, samePort));
    QVERIFY(master->waitForOutput("node A"));
    QVERIFY(master->waitForOutput("node B"));
    QTest::qWait(200);
    QVERIFY2(!master->output().contains("RealTime"), qPrintable(master->output()));
}

void tst_SafeProcesses::terminatedProgramEndsInItsSafeState_data()
{
    QTest::addColumn<bool>("isMaster");
    QTest::newRow("a node") << false;
    QTest::newRow("the master") << true;
}

void tst_SafeProcesses::terminatedProgramEndsInItsSafeState()
{
    QFETCH(bool, isMaster);
    QVERIFY(startPlant(0, "plain"));
    Program &told = isMaster ? *master : *a;
    QElapsedTimer watch;
    watch.start();
    told.sendSignal(SIGTERM);
    QCOMPARE(told.waitForEnd(), 0);
    qInfo("ended after %lld ms", watch.elapsed());
    QVERIFY(safeAfter(*a, "PhaseEnded") >= 0.0);
    if (isMaster)
        QVERIFY(safeAfter(*b, "PhaseEnded") >= 0.0);
    else
        QVERIFY(!b->output().contains("safe"));
}

QTEST_GUILESS_MAIN(tst_SafeProcesses)
#include "tst_SafeProcesses.moc"
