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
    void startWithoutANeededNodeIsFound_data();
    void startWithoutANeededNodeIsFound();
    void triedStartThatIsNotRefusedOrNotNamedIsFound_data();
    void triedStartThatIsNotRefusedOrNotNamedIsFound();
    void nodeThatGetsInBesideStrangersPasses();
    void nodeThatDoesNotGetInBesideStrangersIsFound();
    void plantThatStopsForStrangersIsFound();
    void joinerThatIsDroppedPasses();
    void joinerThatStopsThePlantIsFound();
    void nodesWithTheParametersOfTheirMasterPass();
    void nodeThatKeepsItsSafeValueIsFound();
    void nodeWithOtherParametersThatTakesPartIsFound();
};

namespace {

HandMade withSiege()
{
    HandMade plant;
    plant.addFault(FaultKind::Siege, 1, HandMade::at(20), HandMade::at(60));
    return plant;
}

/// Its master has come back with edition \a ofMaster; node 1 has a table of edition \a ofNode, and
/// goes safe with the value of edition \a ofValue.
HandMade withOtherParameters(quint64 ofMaster, quint64 ofNode, quint64 ofValue)
{
    HandMade plant;
    plant.addFault(FaultKind::OtherParameters, -1, HandMade::at(20), HandMade::at(60));
    plant.master().records.front().numbers[Record::Edition] = ofMaster;
    HandMade::add(plant.node(1), Record::Born, 1, 0, {0, ofNode});
    for (const int node : {0, 1, 2}) {
        const double limit = soak::safeLimit(node == 1 ? ofValue : ofMaster);
        HandMade::add(plant.node(node), Record::Safe, node, plant.end(), {0, 0, 0, soak::bitsOf(limit)});
    }
    HandMade::add(plant.node(2), Record::Born, 2, 0, {0, ofMaster});
    return plant;
}

}  // namespace

void tst_MemberGates::plantWithoutSuchFaultsIsNotJudged()
{
    QVERIFY(!HandMade().judge(&soak::friendsGetIn).isAsked);
    QVERIFY(!HandMade().judge(&soak::silentJoinersAreDropped).isAsked);
    QVERIFY(!HandMade().judge(&soak::safetyParametersAgree).isAsked);
}

void tst_MemberGates::startWithAllNodesPasses()
{
    HandMade plant;
    plant.addFault(FaultKind::MissingNode, 1, HandMade::at(20), HandMade::at(60));
    HandMade::add(plant.runner(), Record::Tried, 1, HandMade::at(30), {1, 1});
    const Gate gate = plant.judge(&soak::startsHaveTheirNodes);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(2));
}

void tst_MemberGates::startWithoutANeededNodeIsFound_data()
{
    QTest::addColumn<int>("node");
    QTest::addColumn<bool>("wasThere");
    QTest::addColumn<bool>("hasManifest");
    QTest::addColumn<qint64>("found");
    QTest::newRow("in the manifest") << 1 << true << true << qint64(1);
    QTest::newRow("in the manifest, never there") << 3 << false << true << qint64(1);
    QTest::newRow("critical") << 3 << true << false << qint64(1);
    QTest::newRow("critical, never there") << 3 << false << false << qint64(0);
    QTest::newRow("not critical") << 1 << true << false << qint64(0);
}

void tst_MemberGates::startWithoutANeededNodeIsFound()
{
    QFETCH(int, node);
    QFETCH(bool, wasThere);
    QFETCH(bool, hasManifest);
    QFETCH(qint64, found);
    HandMade plant;
    plant.evidence.shape.nodes = std::max(3, node + 1);
    plant.evidence.hasManifest = hasManifest;
    if (wasThere) {
        HandMade::add(plant.master(), Record::Registered, node, 650 * HandMade::Millisecond);
        HandMade::add(plant.master(), Record::Lost, node, 700 * HandMade::Millisecond);
    }
    const Gate gate = plant.judge(&soak::startsHaveTheirNodes);
    QVERIFY2(gate.failed == found, textOf(gate));
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
    const Gate gate = plant.judge(&soak::startsHaveTheirNodes);
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

void tst_MemberGates::joinerThatIsDroppedPasses()
{
    HandMade plant;
    plant.addFault(FaultKind::SilentJoiner, -1, HandMade::at(20), HandMade::at(60));
    const Gate gate = plant.judge(&soak::silentJoinersAreDropped);
    QVERIFY2(gate.isAsked && gate.passed(), textOf(gate));
}

void tst_MemberGates::joinerThatStopsThePlantIsFound()
{
    HandMade plant;
    plant.addFault(FaultKind::SilentJoiner, -1, HandMade::at(20), HandMade::at(60), 0);
    const Gate gate = plant.judge(&soak::silentJoinersAreDropped);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

void tst_MemberGates::nodesWithTheParametersOfTheirMasterPass()
{
    const Gate gate = withOtherParameters(2, 2, 2).judge(&soak::safetyParametersAgree);
    QVERIFY2(gate.isAsked && gate.passed(), textOf(gate));
    QCOMPARE(gate.looked, qint64(6));
}

void tst_MemberGates::nodeThatKeepsItsSafeValueIsFound()
{
    const Gate gate = withOtherParameters(2, 2, 1).judge(&soak::safetyParametersAgree);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

void tst_MemberGates::nodeWithOtherParametersThatTakesPartIsFound()
{
    const Gate gate = withOtherParameters(2, 1, 2).judge(&soak::safetyParametersAgree);
    QVERIFY2(gate.failed == 1, textOf(gate));
}

QTEST_GUILESS_MAIN(tst_MemberGates)
#include "tst_MemberGates.moc"
