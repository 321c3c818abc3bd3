// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include <QtTest/QtTest>

using soak::FaultKind;
using soak::Gate;
using soak::Record;

class tst_MemberGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void plantWithoutSuchFaultsIsNotJudged();
    void startWithAllNodesPasses();
    void startWithoutANodeIsFound();
    void triedStartThatIsNotRefusedOrNotNamedIsFound_data();
    void triedStartThatIsNotRefusedOrNotNamedIsFound();
    void nodeThatGetsInBesideStrangersPasses();
    void nodeThatDoesNotGetInBesideStrangersIsFound();
    void plantThatStopsForStrangersIsFound();
};

namespace {

HandMade withSiege()
{
    HandMade plant;
    plant.addFault(FaultKind::Siege, 1, HandMade::at(20), HandMade::at(60));
    return plant;
}

}  // namespace

void tst_MemberGates::plantWithoutSuchFaultsIsNotJudged()
{
    QVERIFY(!HandMade().judge(&soak::friendsGetIn).isAsked);
}

void tst_MemberGates::startWithAllNodesPasses()
{
    HandMade plant;
    plant.addFault(FaultKind::MissingNode, 1, HandMade::at(20), HandMade::at(60));
    HandMade::add(plant.runner(), Record::Tried, 1, HandMade::at(30), {1, 1});
    const Gate gate = plant.judge(&soak::startsNeedAllNodes);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(2));
}

void tst_MemberGates::startWithoutANodeIsFound()
{
    HandMade plant;
    HandMade::add(plant.master(), Record::Lost, 1, 700 * HandMade::Millisecond);
    const Gate gate = plant.judge(&soak::startsNeedAllNodes);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

void tst_MemberGates::triedStartThatIsNotRefusedOrNotNamedIsFound_data()
{
    QTest::addColumn<quint64>("isRefused");
    QTest::addColumn<quint64>("isNamed");
    QTest::newRow("not refused") << quint64(0) << quint64(0);
    QTest::newRow("not named") << quint64(1) << quint64(0);
}

void tst_MemberGates::triedStartThatIsNotRefusedOrNotNamedIsFound()
{
    QFETCH(quint64, isRefused);
    QFETCH(quint64, isNamed);
    HandMade plant;
    plant.addFault(FaultKind::MissingNode, 1, HandMade::at(20), HandMade::at(60));
    HandMade::add(plant.runner(), Record::Tried, 1, HandMade::at(30), {isRefused, isNamed});
    const Gate gate = plant.judge(&soak::startsNeedAllNodes);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

void tst_MemberGates::nodeThatGetsInBesideStrangersPasses()
{
    HandMade plant = withSiege();
    HandMade::add(plant.master(), Record::Registered, 1, HandMade::at(40));
    const Gate gate = plant.judge(&soak::friendsGetIn);
    QVERIFY2(gate.isAsked && gate.passed(), textOf(gate));
}

void tst_MemberGates::nodeThatDoesNotGetInBesideStrangersIsFound()
{
    const Gate gate = withSiege().judge(&soak::friendsGetIn);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

void tst_MemberGates::plantThatStopsForStrangersIsFound()
{
    HandMade plant = withSiege();
    HandMade::add(plant.master(), Record::Registered, 1, HandMade::at(40));
    plant.setState(Record::SafeStop, HandMade::at(50));
    const Gate gate = plant.judge(&soak::friendsGetIn);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

QTEST_GUILESS_MAIN(tst_MemberGates)
#include "tst_MemberGates.moc"
