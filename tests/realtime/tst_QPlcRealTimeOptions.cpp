// SPDX-License-Identifier: Apache-2.0
#include "QPlcClock.h"
#include "QPlcCycle.h"
#include "QPlcRealTimeOptions.h"

#include <QtTest/QtTest>

using namespace std::chrono_literals;

Q_DECLARE_METATYPE(QPlcRealTimeOptions)

namespace {

template<typename Change>
QPlcRealTimeOptions options(Change change)
{
    QPlcRealTimeOptions result;
    change(result);
    return result;
}

}  // namespace

class tst_QPlcRealTimeOptions : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void invalidOptionsAreReportedWithTheirRange_data();
    void invalidOptionsAreReportedWithTheirRange();
    void settingReadsAsASentence();
    void cycleTimeIsExactAfterAYear();
    void clockTellsItsKindAndLimits();
};

void tst_QPlcRealTimeOptions::invalidOptionsAreReportedWithTheirRange_data()
{
    using O = QPlcRealTimeOptions;
    QTest::addColumn<O>("wanted");
    QTest::addColumn<QString>("error");
    const auto row = [](const char *name, auto change, const char *error) {
        QTest::newRow(name) << options(change) << QString::fromUtf8(error);
    };
    row(
        "default", [](O &) {}, "");
    row(
        "other", [](O &o) { o.policy = O::Other; }, "");
    row(
        "least priority", [](O &o) { o.policy = O::Fifo, o.priority = 1; }, "");
    row(
        "highest priority", [](O &o) { o.policy = O::RoundRobin, o.priority = 99; }, "");
    row(
        "all wishes", [](O &o) { o.cpu = 0, o.lockMemory = true, o.prefaultStack = 0, o.timerSlack = 1; }, "");
    row(
        "largest values",
        [](O &o) { o.cpu = 1023, o.prefaultStack = 67108864, o.heapReserve = 1073741824, o.timerSlack = 1000000000; },
        "");

    row(
        "no priority", [](O &o) { o.policy = O::Fifo; }, "priority 0: use 1 ... 99");
    row(
        "priority too high", [](O &o) { o.policy = O::RoundRobin, o.priority = 120; }, "priority 120: use 1 ... 99");
    row(
        "priority below 0", [](O &o) { o.policy = O::Fifo, o.priority = -1; }, "priority -1: use 1 ... 99");
    row(
        "priority without policy", [](O &o) { o.priority = 49; },
        "priority 49 without a real-time policy: set the policy to Fifo or RoundRobin, or the priority to 0");
    row(
        "priority of ordinary scheduling", [](O &o) { o.policy = O::Other, o.priority = 1; },
        "priority 1 without a real-time policy: set the policy to Fifo or RoundRobin, or the priority to 0");
    row(
        "unknown policy", [](O &o) { o.policy = O::Policy(9); }, "policy 9: use Inherit, Other, Fifo or RoundRobin");
    row(
        "cpu below 0", [](O &o) { o.cpu = -1; }, "cpu -1: use 0 ... 1023");
    row(
        "cpu too high", [](O &o) { o.cpu = 1024; }, "cpu 1024: use 0 ... 1023");
    row(
        "stack below 0", [](O &o) { o.prefaultStack = -1; }, "prefaultStack -1: use 0 ... 67108864 byte");
    row(
        "stack too large", [](O &o) { o.prefaultStack = 67108865; }, "prefaultStack 67108865: use 0 ... 67108864 byte");
    row(
        "reserve below 0", [](O &o) { o.heapReserve = -1; }, "heapReserve -1: use 0 ... 1073741824 byte");
    row(
        "reserve too large", [](O &o) { o.heapReserve = 1073741825; },
        "heapReserve 1073741825: use 0 ... 1073741824 byte");
    row(
        "negative idle latency", [](O &o) { o.idleLatency = -1; }, "idleLatency -1: use 0 ... 1000000 µs");
    row(
        "negative spin", [](O &o) { o.spin = -1; }, "spin -1: use 0 ... 10000000 ns");
    row(
        "too much spin", [](O &o) { o.spin = 10000001; }, "spin 10000001: use 0 ... 10000000 ns");
    row(
        "no timer slack", [](O &o) { o.timerSlack = 0; }, "timerSlack 0: use 1 ... 1000000000 ns");
    row(
        "too much timer slack", [](O &o) { o.timerSlack = 1000000001; },
        "timerSlack 1000000001: use 1 ... 1000000000 ns");
}

void tst_QPlcRealTimeOptions::invalidOptionsAreReportedWithTheirRange()
{
    QFETCH(QPlcRealTimeOptions, wanted);
    QTEST(wanted.errorString(), "error");
}

void tst_QPlcRealTimeOptions::settingReadsAsASentence()
{
    QPlcRealTimeSetting setting;
    setting.name = QStringLiteral("scheduling");
    setting.wanted = QStringLiteral("SCHED_FIFO 49");
    setting.obtained = QStringLiteral("SCHED_OTHER 0");
    setting.remedy = QStringLiteral("sudo chrt -f 49 '/opt/100% sure'");
    QCOMPARE(setting.toString(),
             QStringLiteral(
                 "scheduling: wanted SCHED_FIFO 49, obtained SCHED_OTHER 0; cure: sudo chrt -f 49 '/opt/100% sure'"));
    setting.obtained = setting.wanted;
    setting.granted = true;
    setting.remedy.clear();
    QCOMPARE(setting.toString(), QStringLiteral("scheduling: wanted SCHED_FIFO 49, obtained SCHED_FIFO 49"));
}

void tst_QPlcRealTimeOptions::cycleTimeIsExactAfterAYear()
{
    const quint64 aYear = quint64(365) * 86'400 * 10'000;
    const QPlcCycle cycle(aYear, 100us, 3);
    QCOMPARE(cycle.number(), aYear);
    QVERIFY(cycle.time() == std::chrono::hours(365 * 24));
    QCOMPARE(cycle.dt(), 1e-4);
    QCOMPARE(cycle.missedCycles(), quint64(3));
    QVERIFY(QPlcCycle().time() == 0ns);
}

void tst_QPlcRealTimeOptions::clockTellsItsKindAndLimits()
{
    QCOMPARE(QPlcClock(), QPlcClock::realTime());
    QVERIFY(QPlcClock::lockstep().isLockstep());
    QVERIFY(QPlcClock::lockstep().isValid());
    QCOMPARE(QPlcClock::lockstep().scale(), 0.0);
    QVERIFY(QPlcClock::scaled(1.0) != QPlcClock::realTime());
    QVERIFY(QPlcClock::scaled(0.001).isValid());
    QVERIFY(QPlcClock::scaled(1000.0).isValid());
    for (const double scale : {0.0, 0.0009, 1000.1, -1.0, double(qQNaN()), double(qInf())})
        QVERIFY(!QPlcClock::scaled(scale).isValid());
}

QTEST_APPLESS_MAIN(tst_QPlcRealTimeOptions)
#include "tst_QPlcRealTimeOptions.moc"
