// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/NodeStatistics.h"
#include "node/cycle/SlaveStatistics.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

using qplc::NodeStatistics;
using qplc::SlaveStatistics;

namespace {

constexpr std::int64_t Period = 1'000'000;
constexpr std::int64_t Begin = 1'000'000'000;  // of cycle 0

}  // namespace

class tst_NodeStatistics : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<NodeStatistics> m_node;

    void ask(std::uint64_t cycle)
    {
        m_node->asked(cycle, Begin + std::int64_t(cycle) * Period, Begin + std::int64_t(cycle + 1) * Period);
    }
    void answer(std::uint64_t cycle, std::int64_t after)
    {
        m_node->answered(cycle, Begin + std::int64_t(cycle) * Period + after, after / 2);
    }
    QPlcNodeStatistics read()
    {
        m_node->fold();
        return m_node->read(Begin, QPlcDistribution::FiguresOnly);
    }

private Q_SLOTS:
    void init() { m_node = std::make_unique<NodeStatistics>(); }
    void answerInTimeGivesRoundTripExecutionAndSlack();
    void lateAnswerCountsWithItsFullTime();
    void missingAnswersAreLostAfterANewerAnswer();
    void cyclesThatWereSkippedAreNotLost();
    void answerToAForgottenRequestIsNotLost();
    void clearForgetsWhatWasAsked();
    void seededLossesAreCountedExactly();
    void lockstepCountsAnswersWithoutMeasuringTimes();
    void localStepHasNoRoundTrip();
    void slaveMeasuresDifferencesOfItsOwnClock();
    void slaveWithoutFramesHasNoValues();
};

void tst_NodeStatistics::answerInTimeGivesRoundTripExecutionAndSlack()
{
    ask(0);
    answer(0, 400'000);
    const QPlcNodeStatistics found = read();
    QCOMPARE(found.answers, quint64(1));
    QCOMPARE(found.roundTrip.sinceStart.maximum, qint64(400'000));
    QCOMPARE(found.roundTrip.last10s.maximum, qint64(400'000));
    QCOMPARE(found.execution.sinceStart.maximum, qint64(200'000));
    QCOMPARE(found.slack.sinceStart.minimum, qint64(600'000));
    QCOMPARE(found.lost, quint64(0));
}

void tst_NodeStatistics::lateAnswerCountsWithItsFullTime()
{
    for (std::uint64_t cycle = 0; cycle < 4; ++cycle)
        ask(cycle);
    answer(0, 3 * Period + 5);
    const QPlcNodeStatistics found = read();
    QCOMPARE(found.roundTrip.sinceStart.maximum, qint64(3 * Period + 5));
    QCOMPARE(found.slack.sinceStart.count, quint64(1));
    QCOMPARE(found.slack.sinceStart.maximum, qint64(0));
    QCOMPARE(found.lost, quint64(0));  // cycles 1 to 3 may still come
}

void tst_NodeStatistics::missingAnswersAreLostAfterANewerAnswer()
{
    for (std::uint64_t cycle = 0; cycle < 10; ++cycle)
        ask(cycle);
    answer(2, 9 * Period);
    QCOMPARE(read().lost, quint64(2));
    answer(3, 9 * Period);
    QCOMPARE(read().lost, quint64(2));
    answer(9, 1);
    QCOMPARE(read().lost, quint64(7));
}

void tst_NodeStatistics::cyclesThatWereSkippedAreNotLost()
{
    for (const std::uint64_t cycle : {0, 1, 50, 51, 1'000'000}) {
        ask(cycle);
        answer(cycle, 10);
    }
    QCOMPARE(read().answers, quint64(5));
    QCOMPARE(read().lost, quint64(0));
}

void tst_NodeStatistics::answerToAForgottenRequestIsNotLost()
{
    for (std::uint64_t cycle = 0; cycle < 100; ++cycle)
        ask(cycle);
    answer(3, 97 * Period);  // older than what is remembered
    QCOMPARE(read().roundTrip.sinceStart.count, quint64(0));
    QCOMPARE(read().execution.sinceStart.count, quint64(1));
    answer(99, 10);
    QCOMPARE(read().lost, quint64(98));
    QCOMPARE(read().roundTrip.sinceStart.count, quint64(1));
}

void tst_NodeStatistics::clearForgetsWhatWasAsked()
{
    ask(5);
    m_node->clear();
    answer(5, 400'000);  // of the phase before
    const QPlcNodeStatistics found = read();
    QCOMPARE(found.answers, quint64(1));
    QCOMPARE(found.roundTrip.sinceStart.count, quint64(0));
    QCOMPARE(found.lost, quint64(0));
}

void tst_NodeStatistics::seededLossesAreCountedExactly()
{
    std::mt19937_64 random{5};
    std::multiset<std::pair<std::int64_t, std::uint64_t>> underWay;  // arrival, cycle
    quint64 lost = 0;
    quint64 answers = 0;
    std::uint64_t newest = UINT64_MAX;
    std::vector<std::uint64_t> asked;
    std::size_t settled = 0;
    std::uint64_t cycle = 0;
    for (int i = 0; i < 20'000; ++i) {
        const std::int64_t now = Begin + std::int64_t(cycle) * Period;
        while (!underWay.empty() && underWay.begin()->first < now) {
            const auto [arrival, its] = *underWay.begin();
            underWay.erase(underWay.begin());
            if (newest != UINT64_MAX && its < newest)
                continue;  // out of order: the decoder does not let it pass
            m_node->answered(its, arrival, 1);
            ++answers;
            newest = its;
            for (; asked[settled] < its; ++settled)
                ++lost;
            ++settled;
        }
        ask(cycle);
        asked.push_back(cycle);
        if (random() % 5 != 0)
            underWay.emplace(now + std::int64_t(random() % (5 * Period)), cycle);
        cycle += 1 + (random() % 10 == 0 ? random() % 3 : 0);  // overruns
    }
    QCOMPARE(read().answers, answers);
    QCOMPARE(read().lost, lost);
    QVERIFY(lost > 1000);
    QCOMPARE(read().roundTrip.sinceStart.count, answers);
}

void tst_NodeStatistics::lockstepCountsAnswersWithoutMeasuringTimes()
{
    for (std::uint64_t cycle = 0; cycle < 10; ++cycle) {
        m_node->asked(cycle, 0, 0);
        if (cycle != 4)
            m_node->answered(cycle, 0, 0);
    }
    QCOMPARE(read().answers, quint64(9));
    QCOMPARE(read().lost, quint64(1));
    QCOMPARE(read().roundTrip.sinceStart.count, quint64(0));
    QCOMPARE(read().execution.sinceStart.count, quint64(0));
}

void tst_NodeStatistics::localStepHasNoRoundTrip()
{
    m_node->stepped(Begin, 7, Begin + 100);
    m_node->stepped(Begin + 200, 9, Begin + 100);  // too late
    QCOMPARE(read().answers, quint64(2));
    QCOMPARE(read().execution.sinceStart.maximum, qint64(9));
    QCOMPARE(read().slack.sinceStart.minimum, qint64(0));
    QCOMPARE(read().slack.sinceStart.maximum, qint64(100));
    QCOMPARE(read().roundTrip.sinceStart.count, quint64(0));
    m_node->clear();
    QCOMPARE(read().answers, quint64(0));
    QCOMPARE(read().execution.last10s.count, quint64(0));
}

void tst_NodeStatistics::slaveMeasuresDifferencesOfItsOwnClock()
{
    SlaveStatistics slave;
    slave.restart(Period);
    slave.answered(Begin, 100, 150 + Begin);
    slave.answered(Begin + Period + 30, 200, Begin + Period + 30 + 2 * Period);
    slave.answered(Begin + 4 * Period, 300, Begin + 4 * Period + 400);  // two cycles were missed
    slave.fold();
    const QPlcSlaveStatistics found = slave.read(QPlcDistribution::FiguresOnly);
    QCOMPARE(found.execution.sinceStart.count, quint64(3));
    QCOMPARE(found.execution.last10s.maximum, qint64(300));
    QCOMPARE(found.response.sinceStart.minimum, qint64(150));
    QCOMPARE(found.response.sinceStart.maximum, qint64(2 * Period));
    QCOMPARE(found.interval.sinceStart.count, quint64(2));
    QCOMPARE(found.interval.sinceStart.minimum, qint64(Period + 30));
    QCOMPARE(found.interval.sinceStart.maximum, qint64(3 * Period - 30));
    QCOMPARE(found.slack.sinceStart.minimum, qint64(0));
    QCOMPARE(found.slack.sinceStart.maximum, qint64(Period - 150));
    slave.restart(Period);
    QCOMPARE(slave.read(QPlcDistribution::FiguresOnly).response.sinceStart.count, quint64(0));
    slave.answered(Begin, 1, Begin + 1);
    slave.fold();
    QCOMPARE(slave.read(QPlcDistribution::FiguresOnly).interval.sinceStart.count, quint64(0));
}

void tst_NodeStatistics::slaveWithoutFramesHasNoValues()
{
    const SlaveStatistics slave;
    QCOMPARE(slave.read(QPlcDistribution::WithBins).slack.last10s.count, quint64(0));
}

QTEST_APPLESS_MAIN(tst_NodeStatistics)
#include "tst_NodeStatistics.moc"
