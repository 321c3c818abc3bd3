// SPDX-License-Identifier: Apache-2.0
#include "WinchStatistics.h"

#include "Near.h"

using namespace awe;

class tst_WinchStatistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void reportBeforeTheFirstSampleIsZero();
    void energiesAndLossesAddUp();
    void speedErrorCoversOnlyTheEnabledTime();
    void timeBeforeTheFirstEnableIsNotAnInterruption();
    void interruptionsAreCountedWithTheirTime();
    void positionErrorIsReportedAfterTheDriveIsDisabled();
};

void tst_WinchStatistics::reportBeforeTheFirstSampleIsZero()
{
    const WinchReport report = WinchStatistics().report();
    QCOMPARE(report.mechanicalEnergy, 0.0);
    QCOMPARE(report.losses, 0.0);
    QCOMPARE(report.speedError, 0.0);
    QCOMPARE(report.interruptions, 0);
}

void tst_WinchStatistics::energiesAndLossesAddUp()
{
    WinchStatistics statistics;
    for (int i = 0; i <= 100; ++i) {
        WinchSample sample;
        sample.time = i == 50 ? 0.02 : 0.01;  // a cycle was skipped
        sample.mechanicalEnergy = 500.0 + 10.0 * i;
        sample.electricalPower = 800.0;
        sample.current = i == 7 ? -40.0 : 20.0;
        statistics.step(sample);
    }
    const WinchReport report = statistics.report();
    COMPARE_NEAR(report.mechanicalEnergy, 1000.0, 1e-9);
    COMPARE_NEAR(report.electricalEnergy, 816.0, 1e-9);
    COMPARE_NEAR(report.losses, 184.0, 1e-9);
    QCOMPARE(report.largestCurrent, 40.0);
}

void tst_WinchStatistics::speedErrorCoversOnlyTheEnabledTime()
{
    WinchStatistics statistics;
    for (int i = 0; i < 100; ++i) {
        WinchSample sample;
        sample.time = 0.01;
        sample.isEnabled = i >= 20;
        sample.wantedSpeed = 2.0;
        sample.speed = !sample.isEnabled ? 0.0 : i % 2 == 0 ? 2.3 : 1.7;
        statistics.step(sample);
    }
    COMPARE_NEAR(statistics.report().speedError, 0.3, 1e-12);
    COMPARE_NEAR(statistics.report().largestSpeedError, 0.3, 1e-12);
}

void tst_WinchStatistics::timeBeforeTheFirstEnableIsNotAnInterruption()
{
    WinchStatistics statistics;
    WinchSample sample;
    sample.time = 0.01;
    for (int i = 0; i < 10; ++i)
        statistics.step(sample);
    sample.isEnabled = true;
    statistics.step(sample);
    QCOMPARE(statistics.report().interruptions, 0);
    QCOMPARE(statistics.report().timeDisabled, 0.0);
}

void tst_WinchStatistics::interruptionsAreCountedWithTheirTime()
{
    WinchStatistics statistics;
    WinchSample sample;
    sample.time = 0.01;
    for (int i = 0; i < 100; ++i) {
        sample.isEnabled = i < 10 || (i >= 30 && i < 70);
        statistics.step(sample);
    }
    QCOMPARE(statistics.report().interruptions, 2);
    COMPARE_NEAR(statistics.report().timeDisabled, 0.5, 1e-12);
}

void tst_WinchStatistics::positionErrorIsReportedAfterTheDriveIsDisabled()
{
    WinchStatistics statistics;
    WinchSample sample;
    sample.time = 0.01;
    for (int i = 0; i < 100; ++i) {
        sample.isEnabled = i >= 10 && i < 90;
        sample.tetherLength = 100.0 + 0.02 * i;
        sample.position = sample.isEnabled ? 7.0 + 0.021 * i : 0.0;
        statistics.step(sample);
    }
    COMPARE_NEAR(statistics.report().positionError, 79 * 0.001, 1e-9);
}

QTEST_APPLESS_MAIN(tst_WinchStatistics)
#include "tst_WinchStatistics.moc"
