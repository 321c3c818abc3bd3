// SPDX-License-Identifier: Apache-2.0
#include "../common/NotifyListener.h"
#include "../common/Waiting.h"
#include "Program.h"

#include <csignal>
#include <memory>

// The programs of the example as a service manager starts them.
class tst_Services : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aMasterIsReadyWhenItListens();
    void aNodeIsReadyWhenItIsRegistered();
    void aNodeThatStaysIsReadyWithoutItsMaster();
    void runningPlantFeedsTheWatchdogs();
    void stoppedProgramDoesNotFeedTheWatchdog();

private:
    /// A program of the example with a service manager of its own.
    struct Service
    {
        Service(const char *name, const QStringList &arguments)
        {
            qputenv("NOTIFY_SOCKET", QFile::encodeName(listener.path()));
            qputenv("WATCHDOG_USEC", "200000");
            program = std::make_unique<Program>(QStringLiteral(QTPLC_PROGRAMS "/") + QLatin1String(name), arguments);
            qunsetenv("NOTIFY_SOCKET");
            qunsetenv("WATCHDOG_USEC");
        }
        NotifyListener listener;
        std::unique_ptr<Program> program;
    };
    static QString portOf(Service &master)
    {
        return master.program->waitForOutput("port ") ? master.program->output().section("port ", 1).section('\n', 0, 0)
                                                      : QString();
    }
};

void tst_Services::aMasterIsReadyWhenItListens()
{
    Service master("awe_master", {"--port", "0"});
    QVERIFY(master.listener.waitFor("READY=1"));
    QVERIFY(!portOf(master).isEmpty());
    master.program->sendSignal(SIGTERM);
    QCOMPARE(master.program->waitForEnd(), 0);
    QVERIFY(master.listener.take().contains("STOPPING=1"));
}

void tst_Services::aNodeIsReadyWhenItIsRegistered()
{
    Service master("awe_master", {"--port", "0"});
    const QString port = portOf(master);
    QVERIFY(!port.isEmpty());
    Service model("awe_model", {"--master", "localhost:" + port});
    QVERIFY(model.listener.waitFor("READY=1"));
    QVERIFY(master.listener.waitFor(QStringLiteral("STATUS=Off, 1 nodes, port %1").arg(port)));
    model.program->sendSignal(SIGTERM);
    QCOMPARE(model.program->waitForEnd(), 0);
    QVERIFY(model.listener.take().contains("STOPPING=1"));
}

void tst_Services::aNodeThatStaysIsReadyWithoutItsMaster()
{
    Service model("awe_model", {"--master", "localhost:1", "--stay"});
    QVERIFY(model.listener.waitFor("READY=1"));
    QVERIFY(model.listener.waitFor("WATCHDOG=1"));
    model.program->sendSignal(SIGTERM);
    QCOMPARE(model.program->waitForEnd(), 0);
}

void tst_Services::runningPlantFeedsTheWatchdogs()
{
    Service master("awe_master", {"--port", "0"});
    const QString address = "localhost:" + portOf(master);
    Service model("awe_model", {"--master", address});
    Service autopilot("awe_autopilot", {"--master", address});
    QVERIFY(model.listener.waitFor("READY=1") && autopilot.listener.waitFor("READY=1"));
    QCOMPARE(runProgram(QTPLC_PROGRAMS "/qtplc", {"--master", address, "start"}).exitCode, 0);
    for (Service *service : {&master, &model, &autopilot}) {
        QVERIFY(waitUntil([&] { return service->listener.take().join('\n').contains("STATUS=Real time"); }, 10000));
        QVERIFY(service->listener.waitFor("WATCHDOG=1"));
        QVERIFY(service->listener.waitFor("WATCHDOG=1"));
    }
}

void tst_Services::stoppedProgramDoesNotFeedTheWatchdog()
{
    Service master("awe_master", {"--port", "0"});
    QVERIFY(master.listener.waitFor("WATCHDOG=1"));
    master.program->sendSignal(SIGSTOP);
    QTest::qWait(100);
    master.listener.take();
    QVERIFY(!master.listener.waitFor("WATCHDOG=1", 300));
    master.program->sendSignal(SIGCONT);
    QVERIFY(master.listener.waitFor("WATCHDOG=1"));
}

QTEST_GUILESS_MAIN(tst_Services)
#include "tst_Services.moc"
