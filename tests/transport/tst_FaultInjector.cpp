// SPDX-License-Identifier: Apache-2.0
#include "transport/FaultInjector.h"

#include <QtTest/QtTest>

#include <cmath>

using qplc::FaultInjector;
using qplc::FaultPlan;

// Decisions about many frames, against what chance would give.
class tst_FaultInjector : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void emptyPlanChangesNoFrame();
    void faultRatesMatchThePlan();
    void lossesDoNotFollowEachOther();
    void theSameSeedGivesTheSameFaults();
    void streamsAndSeedsDiffer();
    void faultKindsAreIndependentOfEachOther();
    void delaysAreSpreadOverTheJitter();
    void cutLosesExactlyTheFramesOfItsInterval();
    void corruptionTurnsOneToThreeBits();
};

namespace {

constexpr int Many = 200'000;

bool isNear(std::uint64_t count, double probability, int n = Many)
{
    const double deviation = std::sqrt(n * probability * (1.0 - probability));
    return std::abs(double(count) - n * probability) <= 5.0 * deviation + 1e-9;
}

std::vector<int> fatesOf(FaultInjector injector, int n = 5000)
{
    std::vector<int> fates;
    for (int i = 0; i < n; ++i) {
        const FaultInjector::Decision d = injector.decide(0);
        fates.push_back(int(d.passes) | int(d.isHeld) << 1 | int(d.isDuplicated) << 2 | int(d.delay) << 3);
    }
    return fates;
}

FaultPlan::Direction everything()
{
    FaultPlan::Direction plan;
    plan.loss = 0.1;
    plan.duplicate = plan.reorder = plan.corrupt = 0.2;
    plan.jitter = 1000;
    return plan;
}

}  // namespace

void tst_FaultInjector::emptyPlanChangesNoFrame()
{
    FaultInjector injector({}, 1, 1);
    for (int i = 0; i < 1000; ++i) {
        const FaultInjector::Decision d = injector.decide(i);
        QVERIFY(d.passes && !d.isHeld && !d.isDuplicated && d.flips == 0 && d.delay == 0 && d.copyDelay == 0);
    }
    QCOMPARE(injector.frames(), std::uint64_t(1000));
    for (int kind = 0; kind < FaultInjector::Kinds; ++kind)
        QCOMPARE(injector.count(FaultInjector::Kind(kind)), std::uint64_t(0));
}

void tst_FaultInjector::faultRatesMatchThePlan()
{
    FaultPlan::Direction plan;
    plan.loss = 0.1;
    plan.duplicate = 0.02;
    plan.reorder = 0.3;
    plan.corrupt = 0.005;
    FaultInjector injector(plan, 7, 1);
    std::uint64_t lost = 0;
    std::uint64_t corrupted = 0;
    std::uint64_t held = 0;
    for (int i = 0; i < Many; ++i) {
        const FaultInjector::Decision d = injector.decide(0);
        lost += !d.passes;
        held += d.isHeld;
        corrupted += d.flips != 0;
    }
    QVERIFY(isNear(injector.count(FaultInjector::Lost), 0.1));
    QVERIFY(isNear(injector.count(FaultInjector::Duplicated), 0.02 * 0.9));      // of those that are not lost
    QVERIFY(isNear(injector.count(FaultInjector::Reordered), 0.3 / 1.3 * 0.9));  // not behind one that is held
    QCOMPARE(injector.count(FaultInjector::Reordered), held);
    QVERIFY(isNear(injector.count(FaultInjector::Corrupted), 0.005 * 0.9));
    QCOMPARE(injector.count(FaultInjector::Lost), lost);
    QCOMPARE(injector.count(FaultInjector::Corrupted), corrupted);
}

void tst_FaultInjector::lossesDoNotFollowEachOther()
{
    FaultPlan::Direction plan;
    plan.loss = 0.1;
    FaultInjector injector(plan, 3, 9);
    std::uint64_t pairs = 0;
    bool wasLost = false;
    for (int i = 0; i < Many; ++i) {
        const bool isLost = !injector.decide(0).passes;
        pairs += wasLost && isLost;
        wasLost = isLost;
    }
    QVERIFY2(isNear(pairs, 0.01), qPrintable(QString::number(pairs)));
}

void tst_FaultInjector::theSameSeedGivesTheSameFaults()
{
    QCOMPARE(fatesOf(FaultInjector(everything(), 42, 5)), fatesOf(FaultInjector(everything(), 42, 5)));
    // These very numbers: a seed in a report of today is worth something tomorrow.
    FaultPlan::Direction plan;
    plan.loss = 0.5;
    FaultInjector injector(plan, 7, 1);
    QByteArray fates;
    for (int i = 0; i < 32; ++i)
        fates += injector.decide(0).passes ? '.' : 'x';
    QCOMPARE(fates, QByteArray(".xx..xxxxx..xxxx.x..xxx...xxxx.."));
}

void tst_FaultInjector::streamsAndSeedsDiffer()
{
    const auto one = fatesOf(FaultInjector(everything(), 1, 1));
    QVERIFY(one != fatesOf(FaultInjector(everything(), 1, 2)));
    QVERIFY(one != fatesOf(FaultInjector(everything(), 2, 1)));
    QVERIFY(one != fatesOf(FaultInjector(everything(), 0, 0)));
}

void tst_FaultInjector::faultKindsAreIndependentOfEachOther()
{
    FaultPlan::Direction less = everything();
    less.duplicate = 0.0;
    FaultInjector all(everything(), 1, 1);
    FaultInjector without(less, 1, 1);
    for (int i = 0; i < 2000; ++i) {
        const FaultInjector::Decision a = all.decide(0);
        const FaultInjector::Decision b = without.decide(0);
        QCOMPARE(a.passes, b.passes);
        QCOMPARE(a.flips, b.flips);
        QCOMPARE(a.isHeld, b.isHeld);
        QCOMPARE(a.delay, b.delay);
    }
}

void tst_FaultInjector::delaysAreSpreadOverTheJitter()
{
    FaultPlan::Direction plan;
    plan.delay = 2'000'000;
    plan.jitter = 1'000'000;
    FaultInjector injector(plan, 1, 1);
    double sum = 0.0;
    std::int64_t least = INT64_MAX;
    std::int64_t most = 0;
    for (int i = 0; i < Many; ++i) {
        const std::int64_t delay = injector.decide(0).delay;
        sum += double(delay);
        least = std::min(least, delay);
        most = std::max(most, delay);
    }
    QVERIFY(least >= 2'000'000 && least < 2'001'000);
    QVERIFY(most < 3'000'000 && most > 2'999'000);
    QVERIFY(std::abs(sum / Many - 2'500'000) < 5'000);
    QCOMPARE(injector.count(FaultInjector::Delayed), std::uint64_t(Many));
}

void tst_FaultInjector::cutLosesExactlyTheFramesOfItsInterval()
{
    FaultPlan::Direction plan;
    plan.cutBegin = 100;
    plan.cutLength = 50;
    FaultInjector injector(plan, 1, 1);
    for (std::int64_t now = 1000; now < 1300; now += 10)  // the first frame comes at 1000
        QCOMPARE(injector.decide(now).passes, now < 1100 || now >= 1150);
    QCOMPARE(injector.count(FaultInjector::Cut), std::uint64_t(5));
}

void tst_FaultInjector::corruptionTurnsOneToThreeBits()
{
    std::array<int, 4> seen{};
    for (std::uint64_t i = 1; i < 3000; ++i) {
        QByteArray frame(20, '\0');
        FaultInjector::corrupt((i << 1) | 1, frame.data(), std::size_t(frame.size()));
        int bits = 0;
        for (const char byte : qAsConst(frame))
            bits += __builtin_popcount(static_cast<unsigned char>(byte));
        QVERIFY(bits >= 1 && bits <= 3);
        ++seen[std::size_t(bits)];
    }
    QVERIFY(seen[1] > 500 && seen[2] > 500 && seen[3] > 500);
    FaultInjector::corrupt(7, nullptr, 0);
}

QTEST_APPLESS_MAIN(tst_FaultInjector)
#include "tst_FaultInjector.moc"
