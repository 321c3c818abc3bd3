// SPDX-License-Identifier: Apache-2.0
#include "FakeTime.h"
#include "realtime/WakeUpProbe.h"

#include <QtTest/QtTest>

using namespace std::chrono_literals;
using qplc::Histogram;
using qplc::WakeUps;

class tst_WakeUpProbe : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void everyWakeUpIsRecorded();
    void latenessIsMeasuredAgainstTheGrid();
    void interruptedSleepIsResumed();
    void ordinaryThreadIsMeasured();
    void onlyGrantedSchedulingIsMeasured();
    void memoryIsUnlockedAfterwards();
    void unknownSettingIsNotGranted();

private:
    static qint64 lockedMemory()  // [kB]
    {
        QFile file("/proc/self/status");
        return file.open(QIODevice::ReadOnly)
            ? QString::fromLatin1(file.readAll()).section("VmLck:", 1).section("kB", 0, 0).trimmed().toLongLong()
            : -1;
    }
};

void tst_WakeUpProbe::everyWakeUpIsRecorded()
{
    FakeTime time;
    Histogram lateness;
    qplc::recordWakeUps(time, 1ms, 1000, &lateness);
    QCOMPARE(lateness.count(), quint64(1000));
    QCOMPARE(lateness.maximum(), qint64(0));
    QCOMPARE(time.sleeps, 1000);
    QCOMPARE(time.time, qint64(1'000'000'000));
}

void tst_WakeUpProbe::latenessIsMeasuredAgainstTheGrid()
{
    FakeTime time;
    time.target = 5'000'000;
    time.overshoot = 2'500'000;
    Histogram lateness;
    qplc::recordWakeUps(time, 1ms, 10, &lateness);
    QCOMPARE(lateness.maximum(), qint64(2'500'000));
    QCOMPARE(lateness.mean(), (2.5e6 + 1.5e6 + 0.5e6) / 10);  // the grid stays where it is
    QCOMPARE(time.time, qint64(10'000'000));
}

void tst_WakeUpProbe::interruptedSleepIsResumed()
{
    FakeTime time;
    time.interruptions = 3;
    Histogram lateness;
    qplc::recordWakeUps(time, 1ms, 1, &lateness);
    QCOMPARE(lateness.count(), quint64(1));
    QCOMPARE(time.sleeps, 4);
    QCOMPARE(time.time, qint64(1'000'000));
}

void tst_WakeUpProbe::ordinaryThreadIsMeasured()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Other;
    const WakeUps wakeUps = qplc::probeWakeUps(options, 1ms, 20);
    QVERIFY(wakeUps.setting("scheduling").granted);
    QVERIFY(wakeUps.lateness != nullptr);
    QCOMPARE(wakeUps.lateness->count(), quint64(20));
}

void tst_WakeUpProbe::onlyGrantedSchedulingIsMeasured()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Fifo;
    options.priority = 1;
    const WakeUps wakeUps = qplc::probeWakeUps(options, 1ms, 5);
    QCOMPARE(wakeUps.lateness != nullptr, wakeUps.setting("scheduling").granted);
}

void tst_WakeUpProbe::memoryIsUnlockedAfterwards()
{
    const qint64 before = lockedMemory();
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Other;
    options.lockMemory = true;
    const WakeUps wakeUps = qplc::probeWakeUps(options, 1ms, 1);
    QVERIFY(!wakeUps.setting("locked memory").name.isEmpty());
    QCOMPARE(lockedMemory(), before);
}

void tst_WakeUpProbe::unknownSettingIsNotGranted()
{
    QVERIFY(!WakeUps().setting("scheduling").granted);
}

QTEST_APPLESS_MAIN(tst_WakeUpProbe)
#include "tst_WakeUpProbe.moc"
