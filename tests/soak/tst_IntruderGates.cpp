// SPDX-License-Identifier: Apache-2.0
#include "HandMade.h"

#include <QtTest/QtTest>

using soak::Gate;
using soak::Record;

class tst_IntruderGates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void plantWithoutIntrudersIsNotJudged();
    void attemptsThatAreRefusedAndCountedPass();
    void attemptWithWrongCountersIsFound_data();
    void attemptWithWrongCountersIsFound();
    void countsBeforeTheFirstAttemptAreIgnored();
    void delayedNodeIsNotCountedAsIntruder();
};

namespace {

/// 5 attempts, one of which is refused as a node that is none, and 7 commands.
HandMade withIntruders(quint64 ended, quint64 failedHandshakes, quint64 denials, quint64 deniedMessages)
{
    HandMade plant;
    HandMade::remove(plant.master(), [](const Record &record) { return record.kind == Record::Counters; });
    const auto count = [&](quint64 cycle, quint64 failed, quint64 denied) {
        HandMade::add(plant.master(), Record::Counters, -1, HandMade::at(cycle),
                      {1, cycle, 0, 0, 0, 0, 0, failed, denied});
    };
    count(20, 2, 0);
    HandMade::add(plant.runner(), Record::Attempts, -1, HandMade::at(50), {1, 0, 1, 0});
    HandMade::add(plant.runner(), Record::Attempts, -1, HandMade::at(60), {5, ended, 7, denials});
    HandMade::add(plant.master(), Record::Refused, -1, HandMade::at(55));
    count(100, 2 + failedHandshakes, deniedMessages);
    return plant;
}

}  // namespace

void tst_IntruderGates::plantWithoutIntrudersIsNotJudged()
{
    QVERIFY(!HandMade().judge(&soak::attemptsAreRefused).isAsked);
    QVERIFY(!HandMade().judge(&soak::commandsAreDenied).isAsked);
}

void tst_IntruderGates::attemptsThatAreRefusedAndCountedPass()
{
    const Gate attempts = withIntruders(5, 4, 7, 7).judge(&soak::attemptsAreRefused);
    QVERIFY2(attempts.isAsked && attempts.passed(), textOf(attempts));
    QCOMPARE(attempts.looked, qint64(5));
    const Gate commands = withIntruders(5, 4, 7, 7).judge(&soak::commandsAreDenied);
    QVERIFY2(commands.isAsked && commands.passed(), textOf(commands));
    QCOMPARE(commands.looked, qint64(7));
}

void tst_IntruderGates::attemptWithWrongCountersIsFound_data()
{
    QTest::addColumn<int>("ended");
    QTest::addColumn<int>("failedHandshakes");
    QTest::addColumn<int>("denials");
    QTest::addColumn<int>("deniedMessages");
    QTest::newRow("a stranger is still in") << 4 << 4 << 7 << 7;
    QTest::newRow("a refusal is not counted") << 5 << 3 << 7 << 7;
    QTest::newRow("one refusal is counted twice") << 5 << 5 << 7 << 7;
    QTest::newRow("a command is carried out") << 5 << 4 << 6 << 7;
    QTest::newRow("a denial is not counted") << 5 << 4 << 7 << 6;
}

void tst_IntruderGates::attemptWithWrongCountersIsFound()
{
    QFETCH(int, ended);
    QFETCH(int, failedHandshakes);
    QFETCH(int, denials);
    QFETCH(int, deniedMessages);
    const auto plant = [&] {
        return withIntruders(quint64(ended), quint64(failedHandshakes), quint64(denials), quint64(deniedMessages));
    };
    const qint64 failures
        = plant().judge(&soak::attemptsAreRefused).failed + plant().judge(&soak::commandsAreDenied).failed;
    QCOMPARE(failures, qint64(1));
}

void tst_IntruderGates::countsBeforeTheFirstAttemptAreIgnored()
{
    HandMade plant = withIntruders(5, 4, 7, 7);
    HandMade::add(plant.master(), Record::Refused, -1, HandMade::at(10));
    QVERIFY(plant.judge(&soak::attemptsAreRefused).passed());
}

void tst_IntruderGates::delayedNodeIsNotCountedAsIntruder()
{
    HandMade plant = withIntruders(5, 5, 7, 7);
    HandMade::add(plant.node(1), Record::KeptOut, 1, HandMade::at(56));
    const Gate gate = plant.judge(&soak::attemptsAreRefused);
    QVERIFY2(gate.passed(), textOf(gate));
    QCOMPARE(gate.excused, qint64(1));
    HandMade other = withIntruders(5, 6, 7, 7);
    HandMade::add(other.node(1), Record::KeptOut, 1, HandMade::at(56));
    QVERIFY(!other.judge(&soak::attemptsAreRefused).passed());
}

QTEST_GUILESS_MAIN(tst_IntruderGates)
#include "tst_IntruderGates.moc"
