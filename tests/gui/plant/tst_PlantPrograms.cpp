// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "ProgramFixtures.h"

#include <algorithm>
#include <csignal>

using namespace qplc;

namespace {

struct Report
{
    quint64 rows = 0;
    quint64 gaps = 0;
    int largestBatch = 0;
    quint64 kept = 0;  // rows of the store
};

/// The newest report of plant_window.
Report reportOf(Program &window)
{
    const QStringList words = window.output().section(QLatin1Char('\n'), -2, -2).split(QLatin1Char(' '));
    return {words.value(0).toULongLong(), words.value(1).toULongLong(), words.value(2).toInt(),
            words.value(3).toULongLong()};
}

}  // namespace

class tst_PlantPrograms : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void killedMasterIsFoundAgainWithoutBlocking();
    void valuesOfASuspendedMasterAreStaleUntilItContinues();
    void suspendedWindowHasAGapAndDoesNotDelayTheMaster();
    void aSlowWindowKeepsABoundedBacklog();
    void aWindowThatIsStartedAgainHasWhatTheRecorderHas();
    void masterSetsSignalsOfALostWindowToNeutral_data();
    void masterSetsSignalsOfALostWindowToNeutral();
};

void tst_PlantPrograms::killedMasterIsFoundAgainWithoutBlocking()
{
    std::unique_ptr<Program> master = startMaster(QStringLiteral("0"));
    QVERIFY(master);
    const QString port = portOf(*master);
    RunningMaster other;
    QVERIFY(other.startRealTime());
    PlantList plants;
    Plant *plant = plants.add(QStringLiteral("127.0.0.1:") + port, QStringLiteral("kite"));
    Plant *bystander = plants.add(other.address(), QStringLiteral("bystander"));
    QTRY_COMPARE(plant->nextAction(), Plant::Start);
    plant->start();
    QTRY_VERIFY(plant->values().rows() > 20);
    QTRY_VERIFY(bystander->values().rows() > 20);

    const Heartbeat heartbeat;
    master->sendSignal(SIGKILL);
    QTRY_COMPARE(plant->quality(), Plant::Stale);
    QTRY_VERIFY(!plant->isConnected());
    const auto rows = plant->store()->endRow();
    const quint64 seen = bystander->values().rows();
    QTRY_VERIFY(bystander->values().rows() > seen + 100);
    master = startMaster(port);
    QVERIFY(master);
    QTRY_COMPARE(plant->nextAction(), Plant::Start);
    plant->start();
    QTRY_VERIFY(plant->store()->endRow() > rows + 20);
    QVERIFY(plant->store()->beginsAnew(rows));
    QVERIFY2(heartbeat.longest() < 1000, qPrintable(QString::number(heartbeat.longest())));
}

void tst_PlantPrograms::valuesOfASuspendedMasterAreStaleUntilItContinues()
{
    std::unique_ptr<Program> master = startMaster(QStringLiteral("0"));
    QVERIFY(master);
    Plant plant(QStringLiteral("udp://127.0.0.1:") + portOf(*master));
    plant.open();
    QTRY_COMPARE(plant.nextAction(), Plant::Start);
    plant.start();
    QTRY_COMPARE(plant.quality(), Plant::Good);
    QTRY_VERIFY(plant.values().rows() > 20);
    master->sendSignal(SIGSTOP);
    QTRY_COMPARE(plant.quality(), Plant::Stale);
    QVERIFY(plant.isConnected());  // nobody knows yet what is the matter
    QVERIFY(plant.age() >= 0.5);
    master->sendSignal(SIGCONT);
    QTRY_COMPARE(plant.quality(), Plant::Good);
}

void tst_PlantPrograms::suspendedWindowHasAGapAndDoesNotDelayTheMaster()
{
    RunningMaster master;
    QVERIFY(master.setInterval(std::chrono::milliseconds(1)));
    QVERIFY(master.startRealTime());
    Program window(QStringLiteral(QTPLC_PLANT_WINDOW), {QStringLiteral("local://%1").arg(master.serverPort())});
    QTRY_VERIFY(reportOf(window).rows > 200);
    window.sendSignal(SIGSTOP);
    const quint64 cycles = master.statistics().cycles;
    QVERIFY(waitUntil([&] { return master.statistics().cycles > cycles + 3000; }));
    const Report before = reportOf(window);
    window.sendSignal(SIGCONT);
    QTRY_VERIFY(reportOf(window).rows > before.rows + 500);
    QTRY_VERIFY(reportOf(window).gaps > before.gaps);
    QVERIFY2(reportOf(window).largestBatch <= 2048, qPrintable(window.output().right(100)));
    QCOMPARE(master.state(), QPlcMasterNode::RealTime);
}

void tst_PlantPrograms::aSlowWindowKeepsABoundedBacklog()
{
    RunningMaster master;  // whose cycle thread goes on while this thread sleeps
    QVERIFY(master.setInterval(std::chrono::milliseconds(1)));
    QVERIFY(master.startRealTime());
    Plant plant(master.address());
    plant.open();
    QTRY_VERIFY(plant.values().rows() > 50);
    const quint64 gaps = plant.values().gaps();
    const quint64 cycles = master.statistics().cycles;
    for (int looks = 0; looks < 1000 && master.statistics().cycles < cycles + 3000; ++looks)
        QThread::msleep(50);  // nothing is taken meanwhile
    int largestBatch = 0;
    connect(&plant, &Plant::updated, this, [&] { largestBatch = std::max(largestBatch, plant.values().batchSize()); });
    QTRY_VERIFY(plant.values().gaps() > gaps);
    QVERIFY2(largestBatch > 1000 && largestBatch <= 2048, qPrintable(QString::number(largestBatch)));
}

void tst_PlantPrograms::aWindowThatIsStartedAgainHasWhatTheRecorderHas()
{
    QTemporaryDir folder;
    const QString record = QStringLiteral("--record=%1/").arg(folder.path());
    Program master(QStringLiteral(QTPLC_PROGRAMS "/awe_master"), {QStringLiteral("--port=0"), record});
    QVERIFY(master.waitForOutput(QStringLiteral("\n")));
    const QString address = QStringLiteral("127.0.0.1:") + portOf(master);
    Plant person(address);
    person.open();
    QTRY_COMPARE(person.nextAction(), Plant::Start);
    person.start();
    {
        Program window(QStringLiteral(QTPLC_PLANT_WINDOW), {address});
        QTRY_VERIFY(reportOf(window).rows > 200);
        window.sendSignal(SIGKILL);
    }
    Program window(QStringLiteral(QTPLC_PLANT_WINDOW), {address});
    QTRY_VERIFY(reportOf(window).rows > 0);
    const auto hasPast = [&] { return reportOf(window).kept > reportOf(window).rows + 100; };
    QVERIFY2(waitUntil(hasPast), qPrintable(window.output().right(100)));
}

void tst_PlantPrograms::masterSetsSignalsOfALostWindowToNeutral_data()
{
    QTest::addColumn<int>("signal");
    QTest::newRow("killed") << SIGKILL;
    QTest::newRow("stopped") << SIGSTOP;
}

void tst_PlantPrograms::masterSetsSignalsOfALostWindowToNeutral()
{
    QFETCH(int, signal);
    const QString setpoint = QStringLiteral("setpoint");
    RunningMaster master;
    QVERIFY(master.startRealTime());
    Plant other(master.address());
    other.open();
    Program window(QStringLiteral(QTPLC_PLANT_WINDOW), {master.address(), setpoint, QStringLiteral("4")});
    const auto value = [&] { return master.signalValue(setpoint).toReal(); };
    QTRY_COMPARE(value(), 4.0);
    QTRY_VERIFY(other.lease(setpoint) && !other.lease(setpoint)->isMine);
    QTest::qWait(2 * PlantLeases::Timeout);  // it holds as long as it lives
    QCOMPARE(value(), 4.0);
    QCOMPARE(other.lease(setpoint)->state, LeaseStatus::Held);

    QElapsedTimer clock;
    clock.start();
    window.sendSignal(signal);
    QTRY_COMPARE(value(), 0.0);
    QVERIFY2(clock.elapsed() < PlantLeases::Timeout + 2000, qPrintable(QString::number(clock.elapsed())));
    QTRY_VERIFY(other.lease(setpoint) && other.lease(setpoint)->state == LeaseStatus::Lost);
    window.sendSignal(SIGCONT);  // who comes back has lost it
    QTest::qWait(3 * PlantLeases::HeartbeatPeriod);
    QCOMPARE(value(), 0.0);
    other.takeLease({setpoint}, {{setpoint, QPlcValue(2.5)}});
    QTRY_COMPARE(value(), 2.5);
}

QTEST_GUILESS_MAIN(tst_PlantPrograms)
#include "tst_PlantPrograms.moc"
