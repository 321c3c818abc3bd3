// SPDX-License-Identifier: Apache-2.0
#include "node/session/FairTurns.h"

#include <QtTest/QtTest>

#include <memory>
#include <vector>

using namespace qplc;

namespace {

constexpr std::int64_t millisecond = 1'000'000;  // [ns]

/// Time passes only while a client is served.
class WorkTime : public TimeSource
{
public:
    std::int64_t now() noexcept override { return m_now; }
    bool sleepUntil(std::int64_t) noexcept override { return true; }
    void work(std::int64_t duration) { m_now += duration; }

private:
    std::int64_t m_now = 0;
};

/// Somebody who wants a number of steps, each of them with its cost.
struct Asker
{
    int wanted = 0;
    std::int64_t cost = 0;  // [ns] of a step
    int served = 0;
};

}  // namespace

// Who is served when, and for how long, by a clock of the test.
class tst_FairTurns : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_order.clear();
        m_onStep = {};
        m_turns = std::make_unique<FairTurns>([this](FairTurns::Client client) { return step(client); }, m_time);
    }
    void theTurnEndsWithTheStepThatUsesUpItsTime();
    void aClientIsServedForItsQuantumThenTheNext();
    void aCostlyStepIsPaidBack();
    void aNewcomerWaitsForOneStepOfEachOther();
    void whoWantsNothingMoreIsNotServedAgain();
    void aClientMayBeRemovedWhileItIsServed();
    void aTurnInsideOfAStepServesTheOthers();

private:
    bool step(FairTurns::Client client)
    {
        Asker &asker = *static_cast<Asker *>(client);
        m_order.push_back(&asker);
        ++asker.served;
        m_time.work(asker.cost);
        if (m_onStep)
            m_onStep(asker);
        return asker.served < asker.wanted;
    }
    void add(Asker &asker) { m_turns->add(&asker); }

    WorkTime m_time;
    std::unique_ptr<FairTurns> m_turns;
    std::vector<Asker *> m_order;
    std::function<void(Asker &)> m_onStep;
};

void tst_FairTurns::theTurnEndsWithTheStepThatUsesUpItsTime()
{
    Asker asker{1000, millisecond / 2};
    add(asker);
    const std::int64_t begin = m_time.now();
    m_turns->serve();
    QCOMPARE(m_time.now() - begin, FairTurns::Turn);
    QVERIFY(!m_turns->isEmpty());
    asker.cost = 50 * millisecond;
    m_turns->serve();
    QCOMPARE(asker.served, int(FairTurns::Turn / (millisecond / 2)) + 1);
}

void tst_FairTurns::aClientIsServedForItsQuantumThenTheNext()
{
    Asker a{1000, FairTurns::Quantum / 4};
    Asker b = a;
    add(a);
    add(b);
    m_turns->serve();
    const std::vector<Asker *> first(m_order.begin(), m_order.begin() + 9);
    QVERIFY(first == (std::vector<Asker *>{&a, &a, &a, &a, &b, &b, &b, &b, &a}));
}

void tst_FairTurns::aCostlyStepIsPaidBack()
{
    Asker costly{10'000, 10 * millisecond};
    Asker cheap{10'000'000, millisecond / 10};
    add(costly);
    add(cheap);
    for (int turn = 0; turn < 1000; ++turn)
        m_turns->serve();
    const double share = double(costly.served * costly.cost) / double(cheap.served * cheap.cost);
    QVERIFY2(share > 0.95 && share < 1.05, qPrintable(QString::number(share)));
}

void tst_FairTurns::aNewcomerWaitsForOneStepOfEachOther()
{
    std::vector<Asker> flood(8, Asker{10'000, 2 * millisecond});
    for (Asker &asker : flood)
        add(asker);
    for (int turn = 0; turn < 100; ++turn)
        m_turns->serve();
    Asker newcomer{1, millisecond};
    add(newcomer);
    m_order.clear();
    while (newcomer.served == 0)
        m_turns->serve();
    QVERIFY2(m_order.size() <= flood.size() + 1, qPrintable(QString::number(m_order.size())));
}

void tst_FairTurns::whoWantsNothingMoreIsNotServedAgain()
{
    Asker once{1, 0};
    add(once);
    add(once);  // said twice
    m_turns->serve();
    m_turns->serve();
    QCOMPARE(once.served, 1);
    QVERIFY(m_turns->isEmpty());
    add(once);
    m_turns->serve();
    QCOMPARE(once.served, 2);
}

void tst_FairTurns::aClientMayBeRemovedWhileItIsServed()
{
    Asker a{10, 0};
    Asker b{10, 0};
    add(a);
    add(b);
    m_onStep = [&](Asker &asker) {
        if (&asker != &a)
            return;
        m_turns->remove(&a);
        m_turns->remove(&b);
    };
    m_turns->serve();
    QCOMPARE(a.served, 1);
    QCOMPARE(b.served, 0);
    QVERIFY(m_turns->isEmpty());
}

/// As in a dialog that a receiver of a message opens.
void tst_FairTurns::aTurnInsideOfAStepServesTheOthers()
{
    Asker a{2, 0};
    Asker b{1, 0};
    add(a);
    add(b);
    m_onStep = [&](Asker &asker) {
        if (&asker == &a && a.served == 1)
            m_turns->serve();
    };
    m_turns->serve();
    QVERIFY(m_order == (std::vector<Asker *>{&a, &b, &a}));
    QVERIFY(m_turns->isEmpty());
}

QTEST_APPLESS_MAIN(tst_FairTurns)
#include "tst_FairTurns.moc"
