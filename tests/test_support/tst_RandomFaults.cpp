// SPDX-License-Identifier: Apache-2.0
#include "RandomFaults.h"

#include <QtTest/QTest>

#include <algorithm>

class tst_RandomFaults : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void planFollowsFromItsSeed();
    void samePlanGivesSameTraffic();
    void plantComesBackBehindACutRoad();
    void shrinkingLeavesTheFaultThatMatters();
};

void tst_RandomFaults::planFollowsFromItsSeed()
{
    const FaultPlanOfPlant plan = planFor(3, 20);
    const FaultPlanOfPlant again = planFor(3, 20);
    QVERIFY(plan.size() > 1);
    QCOMPARE(again.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i)
        QCOMPARE(again[i].toString(), plan[i].toString());
    QVERIFY(planFor(4, 20)[0].toString() != plan[0].toString());
}

void tst_RandomFaults::samePlanGivesSameTraffic()
{
    const FaultPlanOfPlant plan = planFor(3, 20);
    QCOMPARE(runPlan(3, plan).digest, runPlan(3, plan).digest);
    QVERIFY(runPlan(3, plan).digest != runPlan(3, {}).digest);
}

void tst_RandomFaults::plantComesBackBehindACutRoad()
{
    PlannedFault cut;
    cut.kind = PlannedFault::RoadCut;
    cut.duration = 1'000'000'000;
    QCOMPARE(runPlan(1, {cut}).violation, QString());
}

void tst_RandomFaults::shrinkingLeavesTheFaultThatMatters()
{
    FaultPlanOfPlant plan = planFor(3, 60);
    plan[2].kind = PlannedFault::NodeStopped;
    plan[2].node = 7;
    const auto matters = [](const PlannedFault &fault) { return fault.node == 7; };
    const auto fails = [&](const FaultPlanOfPlant &tried) { return std::any_of(tried.begin(), tried.end(), matters); };
    const FaultPlanOfPlant left = shrunk(plan, fails);
    QCOMPARE(left.size(), std::size_t(1));
    QCOMPARE(left[0].node, 7);
}

QTEST_GUILESS_MAIN(tst_RandomFaults)
#include "tst_RandomFaults.moc"
