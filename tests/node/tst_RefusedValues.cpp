// SPDX-License-Identifier: Apache-2.0
#include "node/statistics/Journal.h"
#include "node/statistics/RefusedValues.h"

#include <QtTest/QtTest>

using qplc::Journal;
using qplc::RefusedValues;

// Values that a master does not take, as its journal tells them.
class tst_RefusedValues : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aSignalIsToldOnceUntilItIsCalm();
    void eachPhaseCountsItsOwn();

private:
    static QStringList texts(const Journal &journal)
    {
        QStringList texts;
        for (const qplc::JournalEvent &event : journal.events().after(0, 100))
            texts << event.text.section(QStringLiteral(", after"), 0, 0);
        return texts;
    }
};

void tst_RefusedValues::aSignalIsToldOnceUntilItIsCalm()
{
    std::uint64_t count = 1;
    Journal journal;
    RefusedValues values(journal, [&](QPlcSignalIndex) { return count; });
    values.refused(3, "speed", "Winch", "12 is above 10");
    count = 7;
    values.refused(3, "speed", "Winch", "13 is above 10");
    QCOMPARE(texts(journal), QStringList{"speed of Winch: 12 is above 10; held"});
    values.end();
    QCOMPARE(texts(journal).last(),
             QString("speed of Winch: no more values are refused; refused: 7, the last one: 13 is above 10"));
}

void tst_RefusedValues::eachPhaseCountsItsOwn()
{
    std::uint64_t count = 5;
    Journal journal;
    RefusedValues values(journal, [&](QPlcSignalIndex) { return count; });
    for (const std::uint64_t ofPhase : {5, 2}) {
        count = ofPhase;  // the cycle counts from 0 in each phase
        values.refused(3, "speed", "Winch", "12 is above 10");
        values.end();
        QCOMPARE(texts(journal).last(),
                 QString("speed of Winch: no more values are refused; refused: %1, the last one: 12 is above 10")
                     .arg(ofPhase));
    }
}

QTEST_GUILESS_MAIN(tst_RefusedValues)
#include "tst_RefusedValues.moc"
