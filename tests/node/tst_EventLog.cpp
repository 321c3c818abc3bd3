// SPDX-License-Identifier: Apache-2.0
#include "node/statistics/EventLog.h"
#include "node/statistics/ReportLimiter.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <ctime>

using namespace qplc;

// The ring of events, and what keeps it from being flooded, by a clock of the test.
class tst_EventLog : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eventsAreNumberedFromOne();
    void oldestEventsAreForgotten();
    void nextQueryContinuesAfterThePreviousOne();
    void longTextIsCutWithAnEllipsis();
    void aLongSourceIsCut();
    void furtherReportsAreCombinedAfterTheFirst();
    void everyTopicHasItsOwnPause();
    void combinedReportSpansFirstToLast();
    void lastReportIsIssuedWithoutAFurtherReport();
    void inactiveTopicsAreRemoved();
    void pendingReportCanBeFetchedEarly();
    void dueReportsComeInTheOrderOfTheirPauses();
    void aReportCostsNoMoreAmongManyTopics();
};

namespace {

JournalEvent anEvent(const QString &text)
{
    return {JournalEvent::Warning, JournalEvent::Late, QStringLiteral("Winch"), text};
}

constexpr std::int64_t ms = 1'000'000;

/// [s] of the processor for a report and the look for the next one, among so many topics; the least
/// of three.
double costOfAReport(int topics)
{
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
        ReportLimiter limiter;
        const std::clock_t begin = std::clock();
        for (int i = 0; i < topics; ++i) {
            limiter.report(QString::number(i), "", anEvent("x"), i);
            (void)limiter.nextDue();
        }
        least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC / topics);
    }
    return least;
}

}  // namespace

void tst_EventLog::eventsAreNumberedFromOne()
{
    EventLog log;
    QCOMPARE(log.newest(), quint64(0));
    QVERIFY(log.after(0, 10).empty());
    log.append(anEvent("a"), 100);
    log.append(anEvent("b"), 50);  // the wall clock may be set back
    QCOMPARE(log.newest(), quint64(2));
    const std::vector<JournalEvent> all = log.after(0, 10);
    QCOMPARE(int(all.size()), 2);
    QCOMPARE(all[0].sequence, quint64(1));
    QCOMPARE(all[0].time, std::int64_t(100));
    QCOMPARE(all[0].source, QString("Winch"));
    QCOMPARE(all[1].text, QString("b"));
    QCOMPARE(int(log.after(1, 10).size()), 1);
    QVERIFY(log.after(2, 10).empty());
    QVERIFY(log.after(~quint64(0), 10).empty());
}

void tst_EventLog::oldestEventsAreForgotten()
{
    EventLog log;
    for (std::size_t i = 0; i < EventLog::Capacity + 5; ++i)
        log.append(anEvent("x"), 0);
    const std::vector<JournalEvent> all = log.after(0, 10 * EventLog::Capacity);
    QCOMPARE(all.size(), EventLog::Capacity);
    QCOMPARE(all.front().sequence, quint64(6));
    QCOMPARE(all.back().sequence, log.newest());
}

void tst_EventLog::nextQueryContinuesAfterThePreviousOne()
{
    EventLog log;
    for (int i = 0; i < 7; ++i)
        log.append(anEvent(QString::number(i)), 0);
    QString texts;
    for (quint64 since = 0; since < log.newest();) {
        const std::vector<JournalEvent> some = log.after(since, 3);
        QVERIFY(!some.empty() && some.size() <= 3);
        for (const JournalEvent &one : some)
            texts += one.text;
        since = some.back().sequence;
    }
    QCOMPARE(texts, QString("0123456"));
    QVERIFY(log.after(0, 0).empty());
}

void tst_EventLog::longTextIsCutWithAnEllipsis()
{
    EventLog log;
    log.append(anEvent(QString(EventLog::LongestText, 'x')), 0);
    log.append(anEvent(QString(EventLog::LongestText + 1, 'x')), 0);
    const std::vector<JournalEvent> all = log.after(0, 2);
    QCOMPARE(all[0].text, QString(EventLog::LongestText, 'x'));
    QCOMPARE(all[1].text, QString(EventLog::LongestText - 1, 'x') + QChar(0x2026));
}

void tst_EventLog::aLongSourceIsCut()
{
    EventLog log;
    JournalEvent event = anEvent("a");
    event.source = QString(60000, 'n');
    log.append(event, 0);
    QCOMPARE(log.after(0, 1)[0].source, QString(EventLog::LongestSource, 'n'));
}

void tst_EventLog::furtherReportsAreCombinedAfterTheFirst()
{
    ReportLimiter limiter;
    QCOMPARE(limiter.report("late", "cycle ", anEvent("7"), 0)->text, QString("cycle 7"));
    for (int i = 1; i <= 4; ++i)
        QVERIFY(!limiter.report("late", "cycle ", anEvent(QString::number(7 + i)), i * ms));
    const std::optional<JournalEvent> told = limiter.report("late", "cycle ", anEvent("12"), 1000 * ms);
    QCOMPARE(told->text, QString("cycle 12 (and 4 more since the last report)"));
    QCOMPARE(told->source, QString("Winch"));
    QVERIFY(told->severity == JournalEvent::Warning && told->kind == JournalEvent::Late);
    QVERIFY(!limiter.report("late", "cycle ", anEvent("13"), 1999 * ms));
    QCOMPARE(limiter.report("late", "cycle ", anEvent("14"), 2000 * ms)->text,
             QString("cycle 14 (and 1 more since the last report)"));
    QCOMPARE(limiter.report("late", "cycle ", anEvent("15"), 9000 * ms)->text, QString("cycle 15"));
}

void tst_EventLog::everyTopicHasItsOwnPause()
{
    ReportLimiter limiter;
    QVERIFY(limiter.report("a", "", anEvent("1"), 0));
    QVERIFY(limiter.report("b", "", anEvent("1"), 1));
    QVERIFY(!limiter.report("a", "", anEvent("2"), 2));
}

void tst_EventLog::combinedReportSpansFirstToLast()
{
    ReportLimiter limiter;
    QCOMPARE(limiter.report("set", "0", anEvent(" -> 1"), 0)->text, QString("0 -> 1"));
    limiter.report("set", "1", anEvent(" -> 2"), 1);
    limiter.report("set", "2", anEvent(" -> 3"), 2);
    const std::vector<JournalEvent> due = limiter.takeDue(1000 * ms);
    QCOMPARE(int(due.size()), 1);
    QCOMPARE(due[0].text, QString("1 -> 3 (and 1 more since the last report)"));
}

void tst_EventLog::lastReportIsIssuedWithoutAFurtherReport()
{
    ReportLimiter limiter;
    limiter.report("late", "", anEvent("1"), 0);
    limiter.report("late", "", anEvent("2"), 1);
    QCOMPARE(*limiter.nextDue(), 1000 * ms);
    QVERIFY(limiter.takeDue(999 * ms).empty());
    QCOMPARE(limiter.takeDue(1000 * ms).at(0).text, QString("2"));
    QVERIFY(!limiter.report("late", "", anEvent("3"), 1001 * ms));  // the pause begins again
}

void tst_EventLog::inactiveTopicsAreRemoved()
{
    ReportLimiter limiter;
    QVERIFY(!limiter.nextDue());
    for (int i = 0; i < 1000; ++i)
        limiter.report(QString::number(i), "", anEvent("x"), 0);
    QVERIFY(limiter.takeDue(1000 * ms).empty());
    QVERIFY(!limiter.nextDue());
}

void tst_EventLog::pendingReportCanBeFetchedEarly()
{
    ReportLimiter limiter;
    QVERIFY(!limiter.take("state"));
    limiter.report("state", "", anEvent("a"), 0);
    QVERIFY(!limiter.take("state"));
    limiter.report("state", "", anEvent("b"), 1);
    QCOMPARE(limiter.take("state")->text, QString("b"));
    QVERIFY(!limiter.take("state"));
    QVERIFY(limiter.takeDue(1000 * ms).empty());
}

void tst_EventLog::dueReportsComeInTheOrderOfTheirPauses()
{
    ReportLimiter limiter;
    limiter.report("b", "b", anEvent("1"), 0);
    limiter.report("a", "a", anEvent("1"), 1 * ms);
    limiter.report("a", "a", anEvent("2"), 2 * ms);
    limiter.report("b", "b", anEvent("2"), 3 * ms);
    const std::vector<JournalEvent> due = limiter.takeDue(2000 * ms);
    QCOMPARE(int(due.size()), 2);
    QCOMPARE(due[0].text, QString("b2"));
    QCOMPARE(due[1].text, QString("a2"));
    QCOMPARE(*limiter.nextDue(), 3000 * ms);
}

/// One message may set all signals of a large table.
void tst_EventLog::aReportCostsNoMoreAmongManyTopics()
{
    const double few = costOfAReport(1000);
    const double many = costOfAReport(30'000);
    QVERIFY2(many < 6 * few, qPrintable(QStringLiteral("%1 and %2 s").arg(few).arg(many)));
}

QTEST_APPLESS_MAIN(tst_EventLog)
#include "tst_EventLog.moc"
