// SPDX-License-Identifier: Apache-2.0
#include "RingFixtures.h"
#include "node/session/RecorderWatch.h"
#include "realtime/TimeSource.h"

#include <QtTest/QtTest>

#include <atomic>
#include <thread>

using namespace qplc;
using messages::RecorderState;

namespace {

constexpr std::int64_t Second = 1'000'000'000;

RecorderReport reportOf(RecorderReport::State state)
{
    RecorderReport report;
    report.state = state;
    report.bytesPerSecond = 14'100;
    report.freeBytes = 4096;
    report.file = "/recordings/kite.mcap.part";
    report.error = state == RecorderReport::Recording ? QString() : QStringLiteral("No space left on device");
    return report;
}

/// A master that looks at the ring of a phase, and what its journal has told.
struct Watched
{
    Watched()
    {
        watch.watch(test.ring);
        now = monotonicNow();
    }
    void look(int seconds = 1)
    {
        now += seconds * Second;
        watch.look(now);
    }
    RecorderState state() const { return watch.status()->state; }
    std::vector<JournalEvent> told() const { return journal.events().after(0, 100); }

    TestRing test;
    Journal journal;
    std::uint64_t missing = 0;
    RecorderWatch watch{journal, [this] { return missing; }};
    std::int64_t now = 0;
};

}  // namespace

// What a master knows of the recorder of its cycles.
class tst_RecorderWatch : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aReportIsReadAsItWasWritten();
    void longTextsAreCut();
    void aReportIsNeverTorn();
    void aReportWhoseWriterWasKilledIsNotRead();
    void withoutARingNothingIsKnown();
    void thatNobodyRecordsIsNoAlarm();
    void aRecorderIsSeenWithItsFigures();
    void aFullDiskIsAnAlarmUntilItGoesOn();
    void aRecorderThatSaysNothingStalls();
    void aRecorderThatWasKilledIsGoneUntilTheNextOneComes();
    void aStoppedRecorderIsToldFromNone();
    void missingCyclesAreToldWhenTheyBeginAndWhenTheyEnd();
    void aNewPhaseEndsTheAlarm();
};

void tst_RecorderWatch::aReportIsReadAsItWasWritten()
{
    RecorderReportPlace place;
    place.write(reportOf(RecorderReport::DiskFull));
    const std::optional<RecorderReport> read = place.read();
    QVERIFY(read);
    QCOMPARE(read->state, RecorderReport::DiskFull);
    QCOMPARE(read->bytesPerSecond, std::uint64_t(14'100));
    QCOMPARE(read->freeBytes, std::uint64_t(4096));
    QCOMPARE(read->file, QString("/recordings/kite.mcap.part"));
    QCOMPARE(read->error, QString("No space left on device"));
}

void tst_RecorderWatch::longTextsAreCut()
{
    RecorderReportPlace place;
    RecorderReport report;
    report.file = QString(5000, 'a') + "/kite.mcap";
    report.error = "full: " + QString(5000, 'b');
    place.write(report);
    const std::optional<RecorderReport> read = place.read();
    QVERIFY(read);
    QVERIFY(read->file.size() < 520 && read->file.endsWith("a/kite.mcap"));
    QVERIFY(read->error.size() < 520 && read->error.startsWith("full: b"));
}

void tst_RecorderWatch::aReportIsNeverTorn()
{
    RecorderReportPlace place;
    std::atomic<bool> isOver{false};
    std::thread writer([&] {
        for (std::uint64_t i = 1; !isOver; ++i) {
            RecorderReport report;
            report.bytesPerSecond = report.freeBytes = i;
            report.error = report.file = QString::number(i);
            place.write(report);
        }
    });
    int torn = 0;
    int reads = 0;
    for (int i = 0; i < 20'000; ++i) {
        const std::optional<RecorderReport> read = place.read();
        if (!read || read->freeBytes == 0)
            continue;
        ++reads;
        const bool isWhole = read->freeBytes == read->bytesPerSecond && read->file == read->error
            && read->file == QString::number(read->freeBytes);
        torn += isWhole ? 0 : 1;
    }
    isOver = true;
    writer.join();
    QCOMPARE(torn, 0);
    place.write(reportOf(RecorderReport::Recording));
    QVERIFY(place.read());
}

void tst_RecorderWatch::aReportWhoseWriterWasKilledIsNotRead()
{
    RecorderReportPlace place;
    const std::uint64_t odd = 7;
    std::memcpy(static_cast<void *>(&place), &odd, sizeof odd);  // as it was when the writer ended
    QVERIFY(!place.read());
    place.write(reportOf(RecorderReport::Recording));
    QVERIFY2(place.read(), "the next recorder is heard");
}

void tst_RecorderWatch::withoutARingNothingIsKnown()
{
    Watched watched;
    watched.watch.watch(nullptr);
    QVERIFY(!watched.watch.status());
    watched.look();
    QVERIFY(!watched.watch.status());
}

void tst_RecorderWatch::thatNobodyRecordsIsNoAlarm()
{
    Watched watched;
    watched.look();
    QCOMPARE(watched.state(), RecorderState::None);
    QVERIFY(watched.told().empty());
}

void tst_RecorderWatch::aRecorderIsSeenWithItsFigures()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    const messages::RecorderEntry seen = *watched.watch.status();
    QCOMPARE(seen.state, RecorderState::Recording);
    QCOMPARE(seen.bytesPerSecond, 14'100.0);
    QCOMPARE(seen.freeBytes, quint64(4096));
    QCOMPARE(seen.file, QString("/recordings/kite.mcap.part"));
    recorder.detach();
    watched.look();
    QCOMPARE(watched.state(), RecorderState::None);
    QCOMPARE(watched.watch.status()->bytesPerSecond, 0.0);
    QCOMPARE(watched.watch.status()->file, QString());  // it has another name by now
    QVERIFY(watched.told().empty());
}

void tst_RecorderWatch::aFullDiskIsAnAlarmUntilItGoesOn()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("No space left"));
    for (int i = 0; i < 3; ++i) {
        recorder.report(reportOf(RecorderReport::DiskFull));
        watched.look();
    }
    QCOMPARE(watched.state(), RecorderState::DiskFull);
    QCOMPARE(watched.told().size(), std::size_t(1));
    QCOMPARE(watched.told()[0].alarm, QString("recorder"));
    QVERIFY(watched.told()[0].isActive);
    QVERIFY(watched.told()[0].severity == JournalEvent::Error);
    QVERIFY(watched.told()[0].text.contains("No space left on device"));
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    QCOMPARE(watched.told().size(), std::size_t(2));
    QCOMPARE(watched.told()[1].alarm, QString("recorder"));
    QVERIFY(!watched.told()[1].isActive);
}

void tst_RecorderWatch::aRecorderThatSaysNothingStalls()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    watched.look(4);
    QCOMPARE(watched.state(), RecorderState::Recording);
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("no progress"));
    watched.look(2);
    QCOMPARE(watched.state(), RecorderState::Stalled);
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    QCOMPARE(watched.state(), RecorderState::Recording);
    QCOMPARE(watched.told().size(), std::size_t(2));
    QVERIFY(watched.told()[0].isActive && !watched.told()[1].isActive);
}

void tst_RecorderWatch::aRecorderThatWasKilledIsGoneUntilTheNextOneComes()
{
    Watched watched;
    {
        RingReader recorder;
        QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
        recorder.report(reportOf(RecorderReport::Recording));
        watched.look();
    }
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("ended without a word"));
    watched.look();
    QCOMPARE(watched.state(), RecorderState::Gone);
    RingReader next;
    QVERIFY(next.open(watched.test.file, &watched.test.error) && next.attach());
    next.report(reportOf(RecorderReport::Recording));
    watched.look();
    QCOMPARE(watched.state(), RecorderState::Recording);
    QCOMPARE(watched.told().size(), std::size_t(2));
    QVERIFY(!watched.told()[1].isActive);
}

void tst_RecorderWatch::aStoppedRecorderIsToldFromNone()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    recorder.report(reportOf(RecorderReport::Stopped));
    recorder.detach();
    watched.look();
    QCOMPARE(watched.state(), RecorderState::Stopped);
    QVERIFY(watched.told().empty());
}

void tst_RecorderWatch::missingCyclesAreToldWhenTheyBeginAndWhenTheyEnd()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("cycles are missing"));
    for (int i = 0; i < 3; ++i) {
        watched.missing += 100;
        recorder.report(reportOf(RecorderReport::Recording));
        watched.look();
    }
    QCOMPARE(watched.told().size(), std::size_t(1));
    recorder.report(reportOf(RecorderReport::Recording));
    watched.look();
    watched.look();
    QCOMPARE(watched.told().size(), std::size_t(2));
    QVERIFY2(watched.told()[1].text.contains("300 are missing"), qPrintable(watched.told()[1].text));
    QCOMPARE(watched.watch.status()->missing, quint64(300));
}

void tst_RecorderWatch::aNewPhaseEndsTheAlarm()
{
    Watched watched;
    RingReader recorder;
    QVERIFY(recorder.open(watched.test.file, &watched.test.error) && recorder.attach());
    recorder.report(reportOf(RecorderReport::DiskFull));
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("No space left"));
    watched.look();
    TestRing next;
    watched.watch.watch(next.ring);
    QCOMPARE(watched.told().size(), std::size_t(2));
    QVERIFY(!watched.told()[1].isActive);
    QCOMPARE(watched.state(), RecorderState::None);
}

QTEST_GUILESS_MAIN(tst_RecorderWatch)
#include "tst_RecorderWatch.moc"
