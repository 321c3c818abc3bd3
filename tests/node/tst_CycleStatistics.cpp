// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "../realtime/FakeTime.h"
#include "NodeFixtures.h"
#include "node/api/QPlcSlaveNodePrivate.h"
#include "node/cycle/MasterCycle.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace qplc;

namespace {

constexpr std::int64_t Period = 10'000'000;  // [ns]
constexpr std::int64_t Second = 1'000'000'000;

/// Cycles of a master on a fake clock with one node in its process, which takes as long as it is
/// told.
class FakePlant : public QPlcCompactSlaveNode
{
public:
    struct Cycle
    {
        std::uint64_t number;
        std::int64_t begin;     // [ns]
        std::int64_t duration;  // [ns] of the step, which is all that takes time
    };

    explicit FakePlant(std::function<std::int64_t()> nextDuration)
        : QPlcCompactSlaveNode(QStringLiteral("Delayer"))
        , m_nextDuration(std::move(nextDuration))
    {
        QString error;
        bound = m_runtime.bind(testTable(), &error) && m_runtime.reset(&error);
        slot->name = name();
        slot->id = 1;
        slot->local = &m_runtime;
        slot->inputLayout = m_runtime.inputLayout();
        slot->outputLayout = m_runtime.outputLayout();
        slot->prepare(cycle.image(), 5);
        cycle.setRoster({{slot}});
        time.time = 17 * Second + 3;
    }
    ~FakePlant() override { cycle.stop(); }

    bool run(QPlcOverrunPolicy policy, std::uint64_t cycleLimit)
    {
        MasterCycle::Phase phase;
        phase.period = std::chrono::nanoseconds(Period);
        phase.overrunPolicy = policy;
        phase.cycleLimit = cycleLimit;
        m_origin = time.time;
        if (!cycle.start(phase))
            return false;
        const bool ended = waitUntil([this] { return hasEnded(); }, 60'000);
        cycle.stop();
        return ended;
    }

    FakeTime time;  // moved by the cycle thread only
    CyclicHub hub;
    MasterCycle cycle{testTable(), hub, false, &time};
    std::shared_ptr<NodeSlot> slot = std::make_shared<NodeSlot>();
    bool bound = false;
    std::vector<Cycle> cycles;
    std::vector<CycleEvent> events;

protected:
    void step(const QPlcCycle &computed) override
    {
        const std::int64_t begin = time.time;
        const std::int64_t duration = m_nextDuration();
        time.time += duration;
        cycles.push_back({computed.number(), begin, duration});
    }

private:
    bool hasEnded()
    {
        cycle.reports().take([this](const CycleEvent &event) { events.push_back(event); }, [](const TappedFrame &) {});
        return std::any_of(events.begin(), events.end(),
                           [](const CycleEvent &event) { return event.kind == CycleEvent::Ended; });
    }

    std::function<std::int64_t()> m_nextDuration;
    NodeRuntime &m_runtime = QPlcSlaveNodePrivate::of(*this).runtime;
    std::int64_t m_origin = 0;
};

std::int64_t exactQuantile(const std::vector<std::int64_t> &sorted, double q)
{
    const double rank = std::clamp(std::ceil(q * double(sorted.size())), 1.0, double(sorted.size()));
    return sorted[std::size_t(rank) - 1];
}

/// What differs between figures and an exact sort; empty: nothing.
QString difference(const QPlcDistribution &figures, std::vector<std::int64_t> values, std::int64_t parts)
{
    std::sort(values.begin(), values.end());
    if (figures.count != values.size())
        return QStringLiteral("count %1 for %2").arg(figures.count).arg(values.size());
    const double sum = double(std::accumulate(values.begin(), values.end(), std::int64_t(0)));
    if (figures.minimum != values.front() || figures.maximum != values.back()
        || figures.mean != sum / double(values.size()))
        return QStringLiteral("extremes or mean");
    for (const auto &[figure, q] :
         {std::pair(figures.p001, 0.001), std::pair(figures.p01, 0.01), std::pair(figures.p50, 0.5),
          std::pair(figures.p99, 0.99), std::pair(figures.p999, 0.999)}) {
        const std::int64_t exact = exactQuantile(values, q);
        if (figure < exact || figure - exact > exact / parts)
            return QStringLiteral("quantile %1: %2 for %3").arg(q).arg(figure).arg(exact);
    }
    return {};
}

/// The truth about a run, worked out from what the node saw.
struct Truth
{
    std::vector<std::int64_t> lateness, execution, slack, lastLateness;
    std::vector<std::pair<std::int64_t, std::uint64_t>> costs;  // and number of the cycle
    std::uint64_t overruns = 0, skipped = 0, caughtUp = 0;
    std::int64_t shifted = 0;
};

Truth truthOf(const std::vector<FakePlant::Cycle> &cycles)
{
    Truth truth;
    std::int64_t origin = cycles.front().begin;
    std::uint64_t due = 0;  // number of the cycle that should come next
    bool wasCatchingUp = false;
    const std::int64_t newestSecond = cycles.back().begin / Second;
    for (const FakePlant::Cycle &cycle : cycles) {
        const auto nominal = [&origin](std::uint64_t number) { return origin + std::int64_t(number) * Period; };
        const std::int64_t lateness = cycle.begin - nominal(cycle.number);
        const std::int64_t overdue = cycle.begin - nominal(due);
        const bool runsLate = lateness >= Period;
        truth.overruns += overdue >= Period && !wasCatchingUp ? 1 : 0;
        truth.skipped += cycle.number - due;
        truth.lateness.push_back(lateness);
        if (cycle.begin / Second > newestSecond - 10)
            truth.lastLateness.push_back(lateness);
        truth.execution.push_back(cycle.duration);
        truth.slack.push_back(std::max<std::int64_t>(nominal(cycle.number + 1) - cycle.begin - cycle.duration, 0));
        truth.costs.emplace_back(overdue + cycle.duration, cycle.number);
        truth.caughtUp += runsLate ? 1 : 0;
        wasCatchingUp = runsLate;
        due = cycle.number + 1;
    }
    std::sort(truth.costs.begin(), truth.costs.end(), [](const auto &a, const auto &b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    return truth;
}

}  // namespace

class tst_CycleStatistics : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void tenThousandInjectedDelaysAreFoundExactly_data();
    void tenThousandInjectedDelaysAreFoundExactly();
    void shiftLosesNoCycleAndCountsTheTime();
    void stopEndsTheCyclesBeforeTheLateOne();
    void worstCyclesAreThoseOfAFullSortWithTheirStages();
    void delayOfSkippedCyclesIsSeenInTheWorstCycles();
    void statisticsAreClearedAtEachPhaseStart();
    void incompleteCyclesAreCountedOncePerCycle();
    void interruptedSleepCausesNoOverrun();
};

void tst_CycleStatistics::tenThousandInjectedDelaysAreFoundExactly_data()
{
    QTest::addColumn<QPlcOverrunPolicy>("policy");
    for (const QPlcOverrunPolicy policy :
         {QPlcOverrunPolicy::skipToGrid(), QPlcOverrunPolicy::catchUp(1), QPlcOverrunPolicy::catchUp(5)})
        QTest::newRow(qPrintable(policy.toString())) << policy;
}

void tst_CycleStatistics::tenThousandInjectedDelaysAreFoundExactly()
{
    QFETCH(QPlcOverrunPolicy, policy);
    std::mt19937_64 random{7};
    int injected = 0;
    int untilNext = 20;  // long enough for the backlog of the injection before to be worked off
    FakePlant plant([&] {
        if (--untilNext > 0)
            return std::int64_t(random() % (Period / 2));
        untilNext = 20 + int(random() % 5);
        ++injected;
        // Every delay makes the next cycle at least one period late, however early this one began.
        return 2 * Period + std::int64_t(random() % (5 * Period));
    });
    QVERIFY(plant.bound);
    while (injected < 10'000) {
        // A phase at a time, so that the phase ends between two injections.
        const int before = injected;
        plant.cycles.clear();
        plant.events.clear();
        untilNext = 20;
        QVERIFY(plant.run(policy, 120'000));
        const Truth truth = truthOf(plant.cycles);
        const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
        const bool lastIsOpen = plant.cycles.back().duration >= 2 * Period;  // its effect was never seen
        QCOMPARE(int(found.overruns), injected - before - (lastIsOpen ? 1 : 0));
        QCOMPARE(found.overruns, quint64(truth.overruns));
        QCOMPARE(found.skippedCycles, quint64(truth.skipped));
        QCOMPARE(found.caughtUpCycles, quint64(truth.caughtUp));
        QCOMPARE(found.cycles, quint64(plant.cycles.size()));
        QCOMPARE(found.cycles + found.skippedCycles, quint64(plant.cycles.back().number + 1));
        QCOMPARE(found.shiftedTime, qint64(0));
        QCOMPARE(difference(found.lateness.sinceStart, truth.lateness, 32), QString());
        QCOMPARE(difference(found.lateness.last10s, truth.lastLateness, 8), QString());
        QCOMPARE(difference(found.execution.sinceStart, truth.execution, 32), QString());
        QCOMPARE(difference(found.slack.sinceStart, truth.slack, 32), QString());
        QCOMPARE(found.roundTrip.sinceStart.count, quint64(0));
        const QPlcNodeStatistics node
            = plant.slot->statistics.read(plant.cycle.cycleStatistics().newest(), QPlcDistribution::FiguresOnly);
        QCOMPARE(node.answers, found.cycles);
        QCOMPARE(difference(node.execution.sinceStart, truth.execution, 32), QString());
        QCOMPARE(difference(node.slack.sinceStart, truth.slack, 32), QString());
        const QPlcMasterStatistics summary = plant.cycle.statistics();
        QCOMPARE(summary.overruns, found.overruns);
        QCOMPARE(summary.skippedCycles, found.skippedCycles);
        QCOMPARE(summary.caughtUpCycles, found.caughtUpCycles);
        QCOMPARE(summary.latenessMedian, found.lateness.sinceStart.p50);
        QCOMPARE(summary.lateness99, found.lateness.sinceStart.p99);
        QCOMPARE(summary.latenessMaximum, found.lateness.sinceStart.maximum);
    }
}

void tst_CycleStatistics::shiftLosesNoCycleAndCountsTheTime()
{
    std::mt19937_64 random{11};
    quint64 injected = 0;
    FakePlant plant([&] {
        const bool inject = random() % 4 == 0;
        return inject ? 2 * Period + std::int64_t(random() % (5 * Period)) : std::int64_t(random() % (Period / 2));
    });
    QVERIFY(plant.run(QPlcOverrunPolicy::shift(), 50'000));
    const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
    std::int64_t nominal = plant.cycles.front().begin;
    std::int64_t shifted = 0;
    std::vector<std::int64_t> lateness;
    for (std::size_t i = 0; i < plant.cycles.size(); ++i) {
        QCOMPARE(plant.cycles[i].number, std::uint64_t(i));
        lateness.push_back(plant.cycles[i].begin - nominal);
        if (lateness.back() >= Period) {
            ++injected;
            shifted += lateness.back();
            nominal += lateness.back();
        }
        nominal += Period;
    }
    QVERIFY(injected > 10'000);
    QCOMPARE(found.overruns, injected);
    QCOMPARE(found.shiftedTime, qint64(shifted));
    QCOMPARE(found.skippedCycles, quint64(0));
    QCOMPARE(found.cycles, quint64(50'000));
    QCOMPARE(difference(found.lateness.sinceStart, lateness, 32), QString());
    QCOMPARE(plant.cycle.statistics().shiftedTime, qint64(shifted));
}

void tst_CycleStatistics::stopEndsTheCyclesBeforeTheLateOne()
{
    std::uint64_t count = 0;
    FakePlant plant([&] { return ++count == 42 ? 3 * Period + 5 : Period / 10; });
    QVERIFY(plant.run(QPlcOverrunPolicy::stop(), 0));
    QCOMPARE(plant.cycles.size(), std::size_t(42));
    const auto overrun = std::find_if(plant.events.begin(), plant.events.end(),
                                      [](const CycleEvent &event) { return event.kind == CycleEvent::Overrun; });
    QVERIFY(overrun != plant.events.end());
    QCOMPARE(overrun->cycle, std::uint64_t(42));
    QCOMPARE(overrun->duration, 2 * Period + 5);
    QCOMPARE(plant.cycle.statistics().cycles, quint64(42));
}

void tst_CycleStatistics::worstCyclesAreThoseOfAFullSortWithTheirStages()
{
    std::mt19937_64 random{13};
    FakePlant plant([&] { return std::int64_t(random() % 20 == 0 ? random() % (4 * Period) : random() % Period); });
    QVERIFY(plant.run(QPlcOverrunPolicy::skipToGrid(), 20'000));
    const Truth truth = truthOf(plant.cycles);
    const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
    QCOMPARE(found.worst.size(), 16);
    for (int i = 0; i < 16; ++i) {
        const QPlcWorstCycle &worst = found.worst.at(i);
        const std::int64_t cost = qint64(worst.skipped) * Period + worst.lateness + worst.execution;
        QCOMPARE(cost, truth.costs[std::size_t(i)].first);
        QCOMPARE(worst.cycle, quint64(truth.costs[std::size_t(i)].second));
        QCOMPARE(worst.roundTrip, qint64(0));
        QCOMPARE(worst.stages.size(), 5);
        for (const QPlcWorstCycle::Stage &stage : worst.stages)
            QCOMPARE(stage.duration, stage.name == QLatin1String("local nodes") ? worst.execution : qint64(0));
    }
}

void tst_CycleStatistics::delayOfSkippedCyclesIsSeenInTheWorstCycles()
{
    std::uint64_t count = 0;
    FakePlant plant([&] {
        ++count;
        if (count == 100)  // the machine does something else for a while: the wake-up is late, no cycle is long
            plant.time.target = plant.time.time, plant.time.overshoot = 50 * Period;
        return Period / 10;
    });
    QVERIFY(plant.run(QPlcOverrunPolicy::skipToGrid(), 1000));
    const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
    QCOMPARE(found.skippedCycles, quint64(50));
    QCOMPARE(found.overruns, quint64(1));
    QCOMPARE(found.worst.first().skipped, quint64(50));
    QCOMPARE(found.worst.first().cycle, quint64(150));
    QVERIFY(found.lateness.sinceStart.maximum < Period);
}

void tst_CycleStatistics::incompleteCyclesAreCountedOncePerCycle()
{
    CycleStatistics statistics;
    std::mt19937_64 random{19};
    for (int phase = 0; phase < 2; ++phase) {  // the second one begins with nothing
        statistics.restart(false, 0, 0);
        quint64 answers = 0;
        quint64 cycles = 0;
        for (std::uint64_t number = 0; number < 1000; ++number) {
            CycleClock::Tick tick;
            tick.cycle = number;
            tick.woken = std::int64_t(number) * Period;
            tick.deadline = tick.woken + Period;
            statistics.begin(tick, Period);
            const quint64 late = random() % 4;
            for (quint64 i = 0; i < late; ++i)
                statistics.lateAnswer();
            statistics.end(tick.deadline);
            answers += late;
            cycles += late > 0 ? 1 : 0;
        }
        QCOMPARE(statistics.summary().lateAnswers, answers);
        QCOMPARE(statistics.summary().incompleteCycles, cycles);
        QCOMPARE(statistics.read(QPlcDistribution::FiguresOnly).incompleteCycles, cycles);
    }
}

void tst_CycleStatistics::statisticsAreClearedAtEachPhaseStart()
{
    std::mt19937_64 random{17};
    FakePlant plant([&] { return std::int64_t(random() % (3 * Period)); });
    QVERIFY(plant.run(QPlcOverrunPolicy::skipToGrid(), 5000));
    plant.cycles.clear();
    plant.events.clear();
    QVERIFY(plant.run(QPlcOverrunPolicy::skipToGrid(), 3));
    const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
    QCOMPARE(found.cycles, quint64(plant.cycles.size()));
    QCOMPARE(found.lateness.sinceStart.count, found.cycles);
    QCOMPARE(found.execution.last10s.count, found.cycles);
    QCOMPARE(quint64(found.worst.size()), found.cycles);
}

void tst_CycleStatistics::interruptedSleepCausesNoOverrun()
{
    FakePlant plant([&] {
        plant.time.interruptions = 3;
        return Period / 10;
    });
    QVERIFY(plant.run(QPlcOverrunPolicy::stop(), 1000));
    const QPlcCycleStatistics found = plant.cycle.cycleStatistics().read(QPlcDistribution::FiguresOnly);
    QCOMPARE(found.cycles, quint64(1000));
    QCOMPARE(found.lateness.sinceStart.maximum, qint64(0));
    QCOMPARE(found.slack.sinceStart.minimum, qint64(Period - Period / 10));
    QVERIFY(plant.time.sleeps >= 4000 - 4);
}

QTEST_GUILESS_MAIN(tst_CycleStatistics)
#include "tst_CycleStatistics.moc"
