// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "BenchDriver.h"
#include "DriverBench.h"

#include <mutex>

using namespace qplc;
using namespace std::chrono_literals;

namespace {

constexpr QPlcDriver::Pace Paces[]{QPlcDriver::EveryCycle, QPlcDriver::OwnPace};

void addPaces()
{
    QTest::addColumn<int>("pace");
    QTest::newRow("every cycle") << int(QPlcDriver::EveryCycle);
    QTest::newRow("own pace") << int(QPlcDriver::OwnPace);
}

struct Bench : DriverBench
{
    explicit Bench(int pace, const QByteArray &keys = "device = bench0\n",
                   std::shared_ptr<BenchDevice> memory = std::make_shared<BenchDevice>())
        : DriverBench(QStringLiteral("bench"), keys, QStringLiteral("bench.ini"),
                      [=] { return std::make_unique<BenchDriver>(memory, QPlcDriver::Pace(pace)); })
        , device(memory)
    {
    }
    std::shared_ptr<BenchDevice> device;
};

/// What the thread of a driver has told.
struct Reports
{
    void add(const QString &error)
    {
        const std::lock_guard lock(mutex);
        texts << error;
    }
    /// A copy that shares nothing: ThreadSanitizer does not see how Qt counts who shares.
    QStringList taken()
    {
        const std::lock_guard lock(mutex);
        QStringList copy;
        for (const QString &text : texts)
            copy << QString(text.constData(), text.size());
        return copy;
    }
    std::mutex mutex;
    QStringList texts;
};

}  // namespace

class tst_DriverRunner : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void valuesFlowBothWays_data() { addPaces(); }
    void valuesFlowBothWays();
    void aValueIsFreshForItsTimeout_data() { addPaces(); }
    void aValueIsFreshForItsTimeout();
    void theTimeoutIsThreeIntervalsUnlessGiven();
    void outputWithoutSafeValueIsNotWritten_data() { addPaces(); }
    void outputWithoutSafeValueIsNotWritten();
    void openedDeviceGetsKnownValues();
    void aDeviceThatFailsHasNoValues_data() { addPaces(); }
    void aDeviceThatFailsHasNoValues();
    void aDeviceThatIsMissingIsOpenedAgainAndAgain_data() { addPaces(); }
    void aDeviceThatIsMissingIsOpenedAgainAndAgain();
    void aDeviceThatOpensAndDoesNotAnswerIsMissing_data() { addPaces(); }
    void aDeviceThatOpensAndDoesNotAnswerIsMissing();
    void errorAndItsEndAreReportedOnce();
    void stopWritesTheLastValuesAndCloses_data() { addPaces(); }
    void stopWritesTheLastValuesAndCloses();
    void lastCycleValuesAreWrittenAgainAfterTheCyclesEnd_data() { addPaces(); }
    void lastCycleValuesAreWrittenAgainAfterTheCyclesEnd();
    void valuesAreFreshWithoutCycles_data() { addPaces(); }
    void valuesAreFreshWithoutCycles();
    void aThreadHasThePriorityOfItsSection_data() { addPaces(); }
    void aThreadHasThePriorityOfItsSection();
    void deviceLossWithoutCyclesIsReported_data() { addPaces(); }
    void deviceLossWithoutCyclesIsReported();
    void newCycleUsesTheDeviceAgain();
    void cycleAndThreadNeverCallTheDriverTogether();
    void deviceOpenedDuringCyclesGetsCurrentValues_data() { addPaces(); }
    void deviceOpenedDuringCyclesGetsCurrentValues();
    void exceptionCountsAsDeviceFailure_data();
    void exceptionCountsAsDeviceFailure();
    void exceptionInACycleCountsAsDeviceLoss_data();
    void exceptionInACycleCountsAsDeviceLoss();
    void exceptionOnCloseIsReported();
    void everyDriverTellsWhetherItIsOnline();
    void aFloodOfEventsIsToldSlowly_data() { addPaces(); }
    void aFloodOfEventsIsToldSlowly();
    void unknownChannelErrorListsKnownChannels();
    void cycleErrorNamesActionReasonAndRemedy();
};

void tst_DriverRunner::valuesFlowBothWays()
{
    QFETCH(int, pace);
    Bench bench(pace, "device = bench0\ngain = 2\n");
    QCOMPARE(bench.errors(), QString());
    QCOMPARE(bench.wireRead("speed"), QString());
    QCOMPARE(bench.wireWrite("torque"), QString());
    QVERIFY(bench.open());
    bench.device->speed = 3.0;
    bench.set("torque", 7.5);
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value("speed"), 6.0);
    QCOMPARE(bench.device->torque.load(), 7.5);
    QVERIFY(!bench.device->torqueWasSafe);
    QCOMPARE(bench.device->brake.load(), -1.0);  // not wired
}

void tst_DriverRunner::aValueIsFreshForItsTimeout()
{
    QFETCH(int, pace);
    Bench bench(pace, "device = bench0\ntimeout = 50 ms\n");
    bench.wireRead("speed");
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("speed"));
    bench.device->isSilent = true;
    bench.advance(50ms);
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("speed"));
    bench.advance(1ns);
    QVERIFY(bench.exchange());
    QVERIFY(!bench.isFresh("speed"));
    bench.device->isSilent = false;
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("speed"));
}

void tst_DriverRunner::theTimeoutIsThreeIntervalsUnlessGiven()
{
    QCOMPARE(Bench(QPlcDriver::OwnPace, "device = b\ninterval = 20 ms\n").runner().driver().timeout(),
             std::chrono::nanoseconds(60ms));
    QCOMPARE(Bench(QPlcDriver::EveryCycle).runner().driver().timeout(), std::chrono::nanoseconds(100ms));
    QCOMPARE(Bench(QPlcDriver::EveryCycle, "device = b\ninterval = 20 ms\n").errors(),
             QString("bench.ini:4:12: 'interval' is not a key of this driver"));
}

void tst_DriverRunner::outputWithoutSafeValueIsNotWritten()
{
    QFETCH(int, pace);
    Bench bench(pace);
    bench.wireWrite("torque");
    bench.wireWrite("brake");
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QCOMPARE(bench.device->torque.load(), -1.0);
    bench.set("brake", 1.0, true);
    QVERIFY(bench.exchange());
    QCOMPARE(bench.device->torque.load(), -1.0);
    QCOMPARE(bench.device->brake.load(), 1.0);
}

void tst_DriverRunner::openedDeviceGetsKnownValues()
{
    Bench bench(QPlcDriver::EveryCycle);
    bench.wireWrite("torque");
    bench.set("torque", 4.0, true);
    bench.runner().write(0);  // nothing is open yet
    QCOMPARE(bench.device->torque.load(), -1.0);
    QVERIFY(bench.open());
    QCOMPARE(bench.device->torque.load(), 4.0);
    QVERIFY(bench.device->torqueWasSafe);
}

void tst_DriverRunner::aDeviceThatFailsHasNoValues()
{
    QFETCH(int, pace);
    Bench bench(pace);
    bench.wireRead("speed");
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("speed"));
    bench.device->isBroken = true;
    QVERIFY(!bench.exchange());
    QVERIFY(!bench.isFresh("speed"));
    bench.close();
    QCOMPARE(bench.runner().failures(), quint64(1));
    QCOMPARE(bench.device->closed.load(), 1);
    bench.device->isBroken = false;
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QVERIFY(bench.isFresh("speed"));
}

void tst_DriverRunner::aDeviceThatIsMissingIsOpenedAgainAndAgain()
{
    QFETCH(int, pace);
    Reports reports;
    Bench bench(pace);
    bench.wireRead("speed");
    bench.device->isPlugged = false;
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_COMPARE(reports.taken(), QStringList{"there is no device 'bench0'; plug it in"});
    QVERIFY(!bench.isOnline());
    bench.device->isPlugged = true;
    QTRY_VERIFY(bench.isOnline());
    QTRY_COMPARE(reports.taken().size(), 2);  // not once for each attempt
    QCOMPARE(reports.taken().last(), QString());
    bench.runner().stop();
    QCOMPARE(bench.device->closed.load(), 1);
}

void tst_DriverRunner::aDeviceThatOpensAndDoesNotAnswerIsMissing()
{
    QFETCH(int, pace);
    Reports reports;
    Bench bench(pace);
    bench.wireRead("speed");
    bench.device->isBroken = true;
    QElapsedTimer timer;
    timer.start();
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_VERIFY(bench.device->opened >= 4);
    QVERIFY2(timer.elapsed() > 500, "three growing pauses of 0.1, 0.2 and 0.4 s, 20 % less at most");
    QVERIFY(!bench.isOnline());
    QCOMPARE(bench.runner().failures(), quint64(0));
    QCOMPARE(reports.taken().size(), 1);
    QVERIFY2(reports.taken().first().startsWith("read from the bench: "), qPrintable(reports.taken().first()));
    bench.device->isBroken = false;
    QTRY_VERIFY(bench.isOnline());
    QTRY_COMPARE(reports.taken().size(), 2);
    QCOMPARE(reports.taken().last(), QString());
    bench.runner().stop();
    QCOMPARE(bench.device->closed.load(), bench.device->opened.load());
}

void tst_DriverRunner::errorAndItsEndAreReportedOnce()
{
    Reports reports;
    Bench bench(QPlcDriver::OwnPace, "device = bench0\ninterval = 1 ms\n");
    bench.wireRead("speed");
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_COMPARE(reports.taken(), QStringList{""});
    bench.device->isPlugged = false;
    bench.device->isBroken = true;
    QTRY_COMPARE(reports.taken().size(), 3);
    QVERIFY2(reports.taken().at(1).startsWith("read from the bench: "), qPrintable(reports.taken().at(1)));
    QCOMPARE(reports.taken().at(2), QString("there is no device 'bench0'; plug it in"));
    bench.device->isBroken = false;
    bench.device->isPlugged = true;
    QTRY_COMPARE(reports.taken().size(), 4);
    QCOMPARE(bench.runner().failures(), quint64(1));
    bench.runner().stop();
}

void tst_DriverRunner::stopWritesTheLastValuesAndCloses()
{
    QFETCH(int, pace);
    Reports reports;
    Bench bench(pace, pace == QPlcDriver::OwnPace ? "device = bench0\ninterval = 1 h\n" : "device = bench0\n");
    bench.wireWrite("torque");
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_VERIFY(bench.isOnline());
    bench.set("torque", 0.25, true);
    bench.runner().write(monotonicNow());
    bench.runner().stop();
    QCOMPARE(bench.device->torqueAtClose.load(), 0.25);
    QCOMPARE(bench.device->closed.load(), 1);
}

void tst_DriverRunner::lastCycleValuesAreWrittenAgainAfterTheCyclesEnd()
{
    QFETCH(int, pace);
    Bench bench(pace);
    bench.wireWrite("torque");
    bench.runner().start([](const QString &) {});
    bench.set("torque", 8.0);
    const auto takesInCycle = [&] {
        bench.runner().write(monotonicNow());
        return bench.device->torque.load() == 8.0;
    };
    QTRY_VERIFY(takesInCycle());
    bench.device->isFull = true;
    bench.set("torque", 0.5, true);
    bench.runner().leave(monotonicNow());
    QCOMPARE(bench.device->torque.load(), 8.0);
    bench.device->isFull = false;
    QTRY_COMPARE(bench.device->torque.load(), 0.5);
    QVERIFY(bench.device->torqueWasSafe);
    bench.runner().stop();
}

void tst_DriverRunner::valuesAreFreshWithoutCycles()
{
    QFETCH(int, pace);
    Bench bench(pace);
    bench.wireRead("speed");
    bench.runner().start([](const QString &) {});
    const auto hasFresh = [&](double speed) {
        const qint64 now = monotonicNow();
        bench.runner().read(now);
        const DriverRunner::Sample sample = bench.runner().sample(0, now);
        return sample.isFresh && sample.value == speed;
    };
    bench.device->speed = 2.0;
    QTRY_VERIFY(hasFresh(2.0));
    bench.runner().write(monotonicNow());
    bench.runner().leave(monotonicNow());
    bench.device->speed = 3.0;
    QTRY_VERIFY(hasFresh(3.0));
    bench.runner().stop();
}

void tst_DriverRunner::aThreadHasThePriorityOfItsSection()
{
    QFETCH(int, pace);
    bool isAllowed = false;
    std::thread([&isAllowed] {
        sched_param parameters{};
        parameters.sched_priority = 3;
        isAllowed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
    }).join();
    if (!isAllowed)
        QTest::ignoreMessage(QtWarningMsg,
                             QRegularExpression("'bench': its thread did not get the priority 3 .*; allow"));
    Bench bench(pace, "device = bench0\npriority = 3\n");
    QCOMPARE(bench.errors(), QString());
    bench.wireRead("speed");
    bench.runner().start({});
    QTRY_VERIFY(bench.device->reads > 1);
    bench.runner().stop();
    QCOMPARE(bench.device->priority.load(), isAllowed ? 3 : 0);
    Bench ordinary(pace);
    ordinary.wireRead("speed");
    ordinary.runner().start({});
    QTRY_VERIFY(ordinary.device->reads > 1);
    ordinary.runner().stop();
    QCOMPARE(ordinary.device->priority.load(), 0);
    QVERIFY(Bench(pace, "device = bench0\npriority = 99\n").errors().contains("from 0 to 98"));
}

void tst_DriverRunner::deviceLossWithoutCyclesIsReported()
{
    QFETCH(int, pace);
    Reports reports;
    Bench bench(pace);
    bench.wireRead("speed");
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_VERIFY(bench.isOnline());
    bench.runner().write(monotonicNow());
    bench.runner().leave(monotonicNow());
    bench.device->isPlugged = false;
    bench.device->isBroken = true;
    QTRY_COMPARE(reports.taken().value(2), QString("there is no device 'bench0'; plug it in"));
    QVERIFY(!bench.isOnline());
    bench.runner().stop();
}

void tst_DriverRunner::newCycleUsesTheDeviceAgain()
{
    Bench bench(QPlcDriver::EveryCycle);
    bench.wireWrite("torque");
    bench.runner().start([](const QString &) {});
    QTRY_VERIFY(bench.isOnline());
    bench.runner().leave(monotonicNow());
    const auto writesItself = [&] {
        const int before = bench.device->writes;
        for (int i = 0; i < 1000; ++i)
            bench.runner().write(monotonicNow());
        return bench.device->writes == before + 1000;
    };
    QTRY_VERIFY(writesItself());
    const int before = bench.device->writes;
    QTest::qWait(30);  // its thread leaves it alone
    QCOMPARE(bench.device->writes.load(), before);
    bench.runner().stop();
}

void tst_DriverRunner::cycleAndThreadNeverCallTheDriverTogether()
{
    Bench bench(QPlcDriver::EveryCycle);
    bench.wireRead("speed");
    bench.wireWrite("torque");
    bench.device->isSlow = true;
    DriverRunner &runner = bench.runner();
    runner.start([](const QString &) {});
    QTRY_VERIFY(bench.isOnline());
    for (int phase = 0; phase < 200; ++phase) {
        for (int cycle = 0; cycle < 5; ++cycle) {
            bench.set("torque", double(cycle));
            runner.write(monotonicNow());
            runner.read(monotonicNow());
        }
        bench.set("torque", -1.0 - phase, true);  // a value of its own: no older one comes after it
        runner.leave(monotonicNow());
        bench.device->isBroken = phase == 150;
    }
    QVERIFY(!bench.device->hasMet);
    bench.device->isBroken = false;
    QTRY_VERIFY(bench.isOnline());
    QTRY_COMPARE(bench.device->torque.load(), -200.0);
    runner.stop();
    QVERIFY(!bench.device->hasMet);
}

void tst_DriverRunner::deviceOpenedDuringCyclesGetsCurrentValues()
{
    QFETCH(int, pace);
    Bench bench(pace, pace == QPlcDriver::OwnPace ? "device = bench0\ninterval = 1 h\n" : "device = bench0\n");
    bench.wireWrite("torque");
    bench.device->isHeld = true;
    bench.set("torque", 8.0);
    bench.runner().write(monotonicNow());
    bench.runner().start([](const QString &) {});
    QTRY_COMPARE(bench.device->writes.load(), 1);  // the computed value is on its way
    bench.set("torque", 0.5, true);
    bench.runner().leave(monotonicNow());
    bench.device->isHeld = false;
    QTRY_COMPARE(bench.device->torque.load(), 0.5);
    QVERIFY(bench.device->torqueWasSafe);
    bench.runner().stop();
}

void tst_DriverRunner::exceptionCountsAsDeviceFailure_data()
{
    QTest::addColumn<int>("pace");
    QTest::addColumn<QByteArray>("function");
    for (const char *function : {"open", "write", "read"}) {
        QTest::addRow("%s, every cycle", function) << int(QPlcDriver::EveryCycle) << QByteArray(function);
        QTest::addRow("%s, own pace", function) << int(QPlcDriver::OwnPace) << QByteArray(function);
    }
}

void tst_DriverRunner::exceptionCountsAsDeviceFailure()
{
    QFETCH(int, pace);
    QFETCH(QByteArray, function);
    Reports reports;
    Bench bench(pace);
    bench.wireWrite("torque");
    bench.device->throwing = function.constData();
    bench.runner().start([&](const QString &error) { reports.add(error); });
    const QString text = QString::fromLatin1(function) + "() threw: the wire is too thin";
    QTRY_VERIFY(reports.taken().contains(text));
    bench.device->throwing = "";
    QTRY_VERIFY(bench.isOnline() && reports.taken().last().isEmpty());
    bench.runner().stop();
}

void tst_DriverRunner::exceptionInACycleCountsAsDeviceLoss_data()
{
    QTest::addColumn<QByteArray>("function");
    QTest::newRow("write") << QByteArray("write");
    QTest::newRow("read") << QByteArray("read");
}

void tst_DriverRunner::exceptionInACycleCountsAsDeviceLoss()
{
    QFETCH(QByteArray, function);
    Bench bench(QPlcDriver::EveryCycle);
    bench.wireRead("speed");
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    bench.device->throwing = function.constData();
    QVERIFY(!bench.exchange());
    QCOMPARE(bench.errorString(), QString::fromLatin1(function) + "() threw: the wire is too thin");
    QVERIFY(!bench.isFresh("speed"));
    bench.close();
    QCOMPARE(bench.device->closed.load(), 1);
    QCOMPARE(bench.runner().failures(), quint64(1));
}

void tst_DriverRunner::exceptionOnCloseIsReported()
{
    Reports reports;
    Bench bench(QPlcDriver::OwnPace);
    bench.runner().start([&](const QString &error) { reports.add(error); });
    QTRY_VERIFY(bench.isOnline());
    bench.device->throwing = "close";
    bench.runner().stop();
    QVERIFY(!bench.isOnline());
    QCOMPARE(reports.taken().last(), QString("close() threw: the wire is too thin"));
}

void tst_DriverRunner::everyDriverTellsWhetherItIsOnline()
{
    Bench bench(QPlcDriver::EveryCycle);
    for (const char *channel : {"speed", "@online", "@failures", "@age"})
        QCOMPARE(bench.wireRead(channel), QString());
    bench.runner().read(0);
    QCOMPARE(bench.value("@online"), 0.0);
    QVERIFY(std::isinf(bench.value("@age")));
    QVERIFY(bench.open());
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value("@online"), 1.0);
    bench.device->isSilent = true;
    bench.advance(250ms);
    QVERIFY(bench.exchange());
    QCOMPARE(bench.value("@age"), 0.25);
    bench.device->isBroken = true;
    QVERIFY(!bench.exchange());
    bench.close();
    QCOMPARE(bench.value("@online"), 0.0);
    QCOMPARE(bench.value("@failures"), 1.0);
}

/// Logs and disks are not for thousands of lines a second.
void tst_DriverRunner::aFloodOfEventsIsToldSlowly()
{
    QFETCH(int, pace);
    Bench bench(pace, pace == QPlcDriver::OwnPace ? "device = bench0\ninterval = 100 us\n" : "device = bench0\n");
    QCOMPARE(bench.wireRead("speed"), QString());
    bench.device->isFlooding = true;
    std::atomic<int> told{0};
    const qint64 begin = monotonicNow();
    DriverRunner &runner = bench.runner();
    runner.start([](const QString &) {}, [&told](const QPlcDeviceEvent &) { ++told; });
    QTRY_VERIFY(runner.isOnline());
    for (int i = 0; i < 2000 && pace == QPlcDriver::EveryCycle; ++i) {
        runner.write(monotonicNow());
        runner.read(monotonicNow());
    }
    QTRY_VERIFY_WITH_TIMEOUT(bench.device->reads >= 2000, 30000);
    QTRY_VERIFY(told >= 64);
    bench.device->isFlooding = false;
    runner.leave(monotonicNow());
    runner.stop();
    const qint64 seconds = (monotonicNow() - begin) / 1'000'000'000;
    QVERIFY2(told <= 64 * (seconds + 2), qPrintable(QString::number(told)));
}

void tst_DriverRunner::unknownChannelErrorListsKnownChannels()
{
    Bench bench(QPlcDriver::EveryCycle);
    QCOMPARE(bench.wireRead("sped"), QString("driver 'bench' has no channel 'sped' to read; did you mean 'speed'?"));
    QCOMPARE(bench.wireRead("torque"), QString("driver 'bench' has no channel 'torque' to read; known are: speed"));
}

void tst_DriverRunner::cycleErrorNamesActionReasonAndRemedy()
{
    for (const QPlcDriver::Pace pace : Paces) {
        Bench bench(pace);
        bench.wireRead("speed");
        QVERIFY(bench.open());
        bench.device->isBroken = true;
        QVERIFY(!bench.exchange());
        QCOMPARE(bench.errorString(),
                 QString("read from the bench: Input/output error; the device does not answer: look at its power, its "
                         "wires and its address"));
    }
}

QTEST_GUILESS_MAIN(tst_DriverRunner)
#include "tst_DriverRunner.moc"
