// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "VirtualTime.h"
#include "node/cycle/CycleStatistics.h"
#include "node/statistics/Journal.h"

using qplc::Journal;
using qplc::JournalEvent;
using namespace std::chrono_literals;

// What a master writes down, without a master.
class tst_Journal : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aStateThatPassesIsTold();
    void manyStatesThatPassAreToldTogether();
    void whoIsRefusedAgainAndAgainIsToldOneByOneAtFirst();
    void strangersAreToldTogether();
    void eachReportOfOverrunsHasItsOwnNumbers();
    void alarmsAreToldOnceAndCleared();
    void alarmsThatNobodyClearsHaveABound();
    void theLeastSevereAlarmIsDroppedFirst();
    void aWarningDropsNoError();

private:
    static void raise(Journal *journal, const QString &alarm, JournalEvent::Severity severity)
    {
        journal->raise(alarm, severity, JournalEvent::Node, alarm, "node is lost");
    }
    static void raiseMany(Journal *journal, int count)
    {
        for (int i = 0; i < count; ++i)
            raise(journal, QStringLiteral("node %1").arg(i, 4, 10, QLatin1Char('0')), JournalEvent::Warning);
    }
    static std::vector<JournalEvent> newest(const Journal &journal, int count)
    {
        return journal.events().after(journal.events().newest() - quint64(count), std::size_t(count));
    }
    static QStringList texts(const Journal &journal)
    {
        QStringList texts;
        for (const JournalEvent &event : journal.events().after(0, 1000))
            texts << event.text;
        return texts;
    }
};

void tst_Journal::aStateThatPassesIsTold()
{
    Journal journal;
    journal.stateChanged("Waiting", true);
    QCOMPARE(texts(journal), QStringList{"state Waiting"});
}

void tst_Journal::manyStatesThatPassAreToldTogether()
{
    Journal journal;
    for (int i = 0; i < 10; ++i)
        journal.stateChanged(i % 2 == 0 ? "Waiting" : "RealTime", true);
    QCOMPARE(texts(journal).size(), 1);
    journal.stateChanged("Off", false);  // what is not told yet would be wrong behind it
    QCOMPARE(texts(journal).size(), 3);
    QCOMPARE(texts(journal).last(), QString("state Off"));
}

void tst_Journal::whoIsRefusedAgainAndAgainIsToldOneByOneAtFirst()
{
    Journal journal;
    for (int i = 0; i < 16; ++i)
        journal.refused("Winch", "192.0.2.1", "no such signal");
    QCOMPARE(texts(journal).size(), 16);
    journal.refused("Winch", "192.0.2.1", "no such signal");  // the first of those that are told together
    for (int i = 0; i < 100; ++i)
        journal.refused("Winch", "192.0.2.1", "no such signal");
    QCOMPARE(texts(journal).size(), 17);
}

void tst_Journal::strangersAreToldTogether()
{
    Journal journal;
    for (int i = 0; i < 100; ++i)
        journal.strangerRefused("192.0.2.1", "too many connections");
    QCOMPARE(texts(journal), QStringList{"refused 192.0.2.1: too many connections"});
}

void tst_Journal::eachReportOfOverrunsHasItsOwnNumbers()
{
    constexpr std::int64_t period = 1'000'000;
    const auto text = [](int skipped) {
        return QStringLiteral("cycles that began a period or more late since the last report: 1; left out: %1")
            .arg(skipped);
    };
    qplc::CycleStatistics statistics;
    const auto skip = [&](std::uint64_t cycles) {
        qplc::CycleClock::Tick tick;
        tick.overrun = true;
        tick.skipped = cycles;
        statistics.begin(tick, period);
    };
    Journal journal;
    journal.watchOverruns(&statistics);
    skip(3);
    pass(990ms);
    QCOMPARE(texts(journal), QStringList());
    pass(20ms);
    QCOMPARE(texts(journal), QStringList{text(3)});
    skip(2);
    journal.watchOverruns(nullptr);  // the cycles have ended
    QCOMPARE(texts(journal), QStringList({text(3), text(2)}));
}

void tst_Journal::alarmsAreToldOnceAndCleared()
{
    Journal journal;
    journal.clear("node Winch", "node Winch is back");  // it was not raised
    QCOMPARE(texts(journal), QStringList());
    for (int i = 0; i < 3; ++i)
        journal.raise("node Winch", JournalEvent::Error, JournalEvent::Node, "Winch", "node Winch is gone");
    pass(1500ms);
    journal.clear("node Winch", "node Winch is back");
    const std::vector<JournalEvent> all = journal.events().after(0, 10);
    QCOMPARE(all.front().alarm, QString("node Winch"));
    QVERIFY(all.front().isActive && !all.back().isActive);
    QCOMPARE(all.back().text, QString("node Winch is back, after 1.5 s"));
}

void tst_Journal::alarmsThatNobodyClearsHaveABound()
{
    Journal journal;
    raiseMany(&journal, int(Journal::mostAlarms));
    raise(&journal, "node of a stranger", JournalEvent::Warning);
    const std::vector<JournalEvent> last = newest(journal, 2);
    QCOMPARE(last[0].alarm, QString("node of a stranger"));
    QVERIFY(last[0].isActive);
    QCOMPARE(last[1].alarm, QString("node 0000"));
    QVERIFY(!last[1].isActive);
    QCOMPARE(
        last[1].text,
        QString("node 0000: this condition may still last; the master keeps 1000 alarms and will not report its end"));
    QCOMPARE(last[1].severity, JournalEvent::Warning);
    raise(&journal, "node 0001", JournalEvent::Warning);  // it is one of them
    QCOMPARE(newest(journal, 1)[0].alarm, QString("node 0001"));
    QCOMPARE(newest(journal, 2)[0].alarm, QString("node 0000"));
}

void tst_Journal::theLeastSevereAlarmIsDroppedFirst()
{
    Journal journal;
    raise(&journal, "oldest error", JournalEvent::Error);
    pass(1s);
    raise(&journal, "became an error", JournalEvent::Warning);
    raise(&journal, "became an error", JournalEvent::Error);
    pass(1s);
    raise(&journal, "warning", JournalEvent::Warning);
    pass(1s);
    raiseMany(&journal, int(Journal::mostAlarms) - 3);
    raise(&journal, "error", JournalEvent::Error);
    QCOMPARE(newest(journal, 1)[0].alarm, QString("warning"));
    raise(&journal, "another error", JournalEvent::Error);
    QCOMPARE(newest(journal, 1)[0].alarm, QString("node 0000"));
}

void tst_Journal::aWarningDropsNoError()
{
    Journal journal;
    for (std::size_t i = 0; i < Journal::mostAlarms; ++i)
        raise(&journal, QStringLiteral("error %1").arg(i), JournalEvent::Error);
    raise(&journal, "warning", JournalEvent::Warning);
    for (const JournalEvent &event : newest(journal, 2))
        QCOMPARE(event.alarm, QString("warning"));
    QCOMPARE(newest(journal, 1)[0].isActive, false);
}

QTPLC_VIRTUAL_TIME_MAIN(tst_Journal)
#include "tst_Journal.moc"
