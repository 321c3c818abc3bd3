// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RingFixtures.h"
#include "ThreadCosts.h"
#include "node/cycle/MasterCycle.h"

#include <QtTest/QtTest>

#include <atomic>
#include <thread>

using namespace qplc;

namespace {

/// Time passes only while a cycle sleeps.
class SleptTime : public TimeSource
{
public:
    std::int64_t now() noexcept override { return m_now; }
    bool sleepUntil(std::int64_t deadline) noexcept override
    {
        for (std::int64_t time = m_now; !stands && time < deadline;) {
            if (m_now.compare_exchange_weak(time, deadline))
                break;
        }
        if (m_now >= jumpAt) {
            jumpAt = INT64_MAX;
            m_now += 20'000'000;  // the computer stands still
        }
        return true;
    }
    std::int64_t jumpAt = INT64_MAX;
    std::atomic<bool> stands{false};

private:
    std::atomic<std::int64_t> m_now{0};
};

/// A master without nodes: its signals are the time of the cycle, and one that is set.
struct Bench
{
    explicit Bench(std::size_t capacity = 64 * 1024)
        : test(capacity)
    {
        phase.period = std::chrono::milliseconds(1);
        phase.timeSignal = 0;
        phase.ring = test.ring;
        QString error;
        if (!recorder.open(test.file, &error))
            qFatal("%s", qPrintable(error));
    }

    /// Rosters come between cycles.
    RingReader::Result nextCycle()
    {
        RingReader::Result result = recorder.next();
        while (result == RingReader::Found && recorder.kind() != RecordKind::Cycle)
            result = recorder.next();
        return result;
    }

    QPlcSignalTable table = QPlcSignalTable::fromIni("[time]\ntype = DateTime\n[x]\ntype = Real64\n");
    TestRing test;
    RingReader recorder;
    SleptTime time;
    CyclicHub hub;
    MasterCycle cycle{table, hub, false, &time};
    MasterCycle::Phase phase;
};

/// What a recorder has found, in order.
struct Found
{
    std::vector<std::uint64_t> cycles;
    std::uint64_t missing = 0;  // of all gaps
    std::uint64_t skipped = 0;
    int gaps = 0;
    bool hasEnd = false;
    RecordedEnd end;
    std::uint64_t digest = 0;  // of the images, across gaps
    QString error;             // empty: all that was computed is in one of the records

    void read(RingReader &reader, const ProcessImage &image)
    {
        while (error.isEmpty() && reader.next() == RingReader::Found) {
            if (reader.kind() == RecordKind::Cycle)
                addCycle(reader, image);
            else if (reader.kind() == RecordKind::Gap)
                addGap(reader);
            else if (reader.kind() == RecordKind::End)
                addEnd(reader);
        }
    }

private:
    void addCycle(const RingReader &reader, const ProcessImage &image)
    {
        CycleView view;
        if (!CycleView::read(reader.body(), reader.size(), &view))
            error = "a record is not whole";
        else if (view.cycle.number != next + view.cycle.skipped)
            error = QStringLiteral("cycle %1 after %2").arg(view.cycle.number).arg(next);
        ProcessImage there(image.table());
        std::memcpy(there.data(), view.image, view.cycle.imageSize);
        digest = there.digest(digest);
        skipped += view.cycle.skipped;
        if (digest != view.cycle.digest)
            error = QStringLiteral("the digest of cycle %1 is another one").arg(view.cycle.number);
        cycles.push_back(view.cycle.number);
        next = view.cycle.number + 1;
    }
    void addGap(const RingReader &reader)
    {
        RecordedGap gap;
        std::memcpy(&gap, reader.body(), sizeof gap);
        if (gap.first < next || next + gap.skipped + gap.cycles != gap.last + 1)
            error = QStringLiteral("gap from %1, after %2").arg(gap.first).arg(next);
        next = gap.last + 1;
        missing += gap.cycles;
        skipped += gap.skipped;
        digest = gap.digest;
        ++gaps;
    }
    void addEnd(const RingReader &reader)
    {
        std::memcpy(&end, reader.body(), sizeof end);
        if (end.last + 1 != next || end.cycles != cycles.size() + missing || end.missing != missing
            || end.digest != digest)
            error = "the end does not fit what came before it";
        hasEnd = true;
    }
    std::uint64_t next = 0;
};

}  // namespace

// What a master writes into its ring in each cycle.
class tst_CycleTap : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void eachCycleHasARecord();
    void theRecordHasTheImageOfItsCycle();
    void theFirstRecordHasTheImageBefore();
    void cyclesThatWereSkippedAreCounted();
    void whenNobodyRecordsTheNewestCyclesStay();
    void aTimedCycleNeverWaitsAndGapsAreExact();
    void besideARecorderGapsAreExact();
    void aCycleInLockstepWaitsForRoom();
    void aRecorderThatHasStoppedIsNotWaitedForForever();
    void aStopDoesNotWaitForARecorder();
    void aRecordCostsNoAllocationAndNoLock();
};

void tst_CycleTap::eachCycleHasARecord()
{
    Bench bench;
    bench.phase.clock = QPlcClock::external();
    QVERIFY(bench.cycle.start(bench.phase));
    for (int i = 0; i < 100; ++i)
        QCOMPARE(bench.cycle.step(), MasterCycle::Step::Complete);
    bench.cycle.stop();
    Found found;
    found.read(bench.recorder, bench.cycle.image());
    QCOMPARE(found.error, QString());
    QCOMPARE(found.cycles.size(), std::size_t(100));
    QVERIFY(found.hasEnd);
    QCOMPARE(found.end.digest, std::uint64_t(bench.cycle.statistics().imageDigest));
    QCOMPARE(bench.cycle.tap().missing(), std::uint64_t(0));
}

void tst_CycleTap::theRecordHasTheImageOfItsCycle()
{
    Bench bench;
    bench.phase.clock = QPlcClock::external();
    QVERIFY(bench.cycle.start(bench.phase));
    QVERIFY(bench.cycle.setValues({{1, QPlcValue(2.5), QPlcQuality::Good}}));
    bench.cycle.step();
    CycleView view;
    QCOMPARE(bench.nextCycle(), RingReader::Found);
    QVERIFY(CycleView::read(bench.recorder.body(), bench.recorder.size(), &view));
    const std::vector<char> values = bench.cycle.values();
    QCOMPARE(QByteArray(view.image, int(view.cycle.imageSize)), QByteArray(values.data(), int(values.size())));
    double x = 0.0;
    std::memcpy(&x, view.image + bench.cycle.offset(1), sizeof x);
    QCOMPARE(x, 2.5);
}

void tst_CycleTap::theFirstRecordHasTheImageBefore()
{
    Bench bench;
    bench.phase.clock = QPlcClock::external();
    QVERIFY(bench.cycle.start(bench.phase));
    for (const bool hasBefore : {true, false}) {
        bench.cycle.step();
        CycleView view;
        QCOMPARE(bench.nextCycle(), RingReader::Found);
        QVERIFY(CycleView::read(bench.recorder.body(), bench.recorder.size(), &view));
        QCOMPARE(view.cycle.beforeSize != 0, hasBefore);
        QCOMPARE((view.cycle.flags & RecordedCycle::NewNodes) != 0, hasBefore);
    }
}

void tst_CycleTap::cyclesThatWereSkippedAreCounted()
{
    Bench bench;
    bench.time.jumpAt = 5'000'000;
    bench.phase.cycleLimit = 1'000;
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    Found found;
    while (!found.hasEnd && found.error.isEmpty()) {
        found.read(bench.recorder, bench.cycle.image());
        bench.recorder.release();
    }
    bench.cycle.stop();
    QCOMPARE(found.error, QString());
    QCOMPARE(found.end.last, std::uint64_t(999));
    QVERIFY(found.skipped >= 19);
    QCOMPARE(found.cycles.size() + found.missing + found.skipped, std::size_t(1'000));
}

void tst_CycleTap::whenNobodyRecordsTheNewestCyclesStay()
{
    Bench bench;
    bench.phase.clock = QPlcClock::external();
    QVERIFY(bench.cycle.start(bench.phase));
    for (int i = 0; i < 10'000; ++i)
        bench.cycle.step();
    QCOMPARE(bench.cycle.tap().missing(), std::uint64_t(0));
    QCOMPARE(bench.recorder.next(), RingReader::Lost);
    std::uint64_t last = 0;
    while (bench.nextCycle() == RingReader::Found) {
        CycleView view;
        QVERIFY(CycleView::read(bench.recorder.body(), bench.recorder.size(), &view));
        last = view.cycle.number;
    }
    QCOMPARE(last, std::uint64_t(9'999));
}

void tst_CycleTap::aTimedCycleNeverWaitsAndGapsAreExact()
{
    Bench bench;
    bench.phase.cycleLimit = 5'000;
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    QTRY_COMPARE(bench.cycle.statistics().cycles, quint64(5'000));
    bench.cycle.stop();
    Found found;
    found.read(bench.recorder, bench.cycle.image());
    QCOMPARE(found.error, QString());
    QCOMPARE(found.gaps, 1);
    QVERIFY(found.missing > 4'000);
    QCOMPARE(found.cycles.size() + found.missing, std::size_t(5'000));
    QCOMPARE(bench.cycle.tap().missing(), found.missing);
    QVERIFY(found.hasEnd);
}

void tst_CycleTap::besideARecorderGapsAreExact()
{
    Bench bench;
    bench.phase.cycleLimit = 100'000;
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    Found found;
    for (int turn = 0; !found.hasEnd && found.error.isEmpty(); ++turn) {
        found.read(bench.recorder, bench.cycle.image());
        if (turn % 3 == 0)
            bench.recorder.release();
        std::this_thread::yield();
        if (!bench.cycle.isRunning() || bench.cycle.cycle() == 99'999)
            bench.recorder.release();
    }
    bench.cycle.stop();
    QCOMPARE(found.error, QString());
    QCOMPARE(found.cycles.size() + found.missing, std::size_t(100'000));
    QCOMPARE(bench.cycle.tap().missing(), found.missing);
}

void tst_CycleTap::aCycleInLockstepWaitsForRoom()
{
    Bench bench;
    bench.time.stands = true;  // nobody loses patience
    bench.phase.clock = QPlcClock::lockstep();
    bench.phase.cycleLimit = 20'000;
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    Found found;
    while (!found.hasEnd && found.error.isEmpty()) {
        found.read(bench.recorder, bench.cycle.image());
        if (bench.test.ring->hasRoomFor(1024) && !found.hasEnd)
            continue;  // until the ring is full
        bench.recorder.release();
    }
    bench.cycle.stop();
    QCOMPARE(found.error, QString());
    QCOMPARE(found.cycles.size(), std::size_t(20'000));
    QCOMPARE(found.gaps, 0);
    QCOMPARE(found.digest, std::uint64_t(bench.cycle.statistics().imageDigest));
}

void tst_CycleTap::aRecorderThatHasStoppedIsNotWaitedForForever()
{
    Bench bench;
    bench.phase.clock = QPlcClock::lockstep();
    bench.phase.cycleLimit = 5'000;
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    QTRY_COMPARE(bench.cycle.statistics().cycles, quint64(5'000));
    bench.cycle.stop();
    QVERIFY(bench.time.now() > CycleTap::Patience);
    QVERIFY(bench.time.now() < 2 * CycleTap::Patience);  // once, and not in each cycle
    Found found;
    found.read(bench.recorder, bench.cycle.image());
    QCOMPARE(found.error, QString());
    QCOMPARE(found.cycles.size() + found.missing, std::size_t(5'000));
}

void tst_CycleTap::aStopDoesNotWaitForARecorder()
{
    Bench bench;
    bench.time.stands = true;  // it would be waited for without an end
    bench.phase.clock = QPlcClock::lockstep();
    QVERIFY(bench.recorder.attach());
    QVERIFY(bench.cycle.start(bench.phase));
    QTRY_VERIFY(!bench.test.ring->hasRoomFor(1024));
    bench.cycle.stop();
    Found found;
    found.read(bench.recorder, bench.cycle.image());
    QCOMPARE(found.error, QString());
    QVERIFY(found.hasEnd);
}

void tst_CycleTap::aRecordCostsNoAllocationAndNoLock()
{
    if (!ThreadCosts::areCounted())
        QSKIP("a sanitizer owns the functions of the C library");
    Bench bench;
    bench.phase.clock = QPlcClock::external();
    QVERIFY(bench.cycle.start(bench.phase));
    for (int i = 0; i < 10; ++i)
        bench.cycle.step();
    const ThreadCosts before = ThreadCosts::ofThisThread();
    for (int i = 0; i < 10'000; ++i)  // several times around the ring
        bench.cycle.step();
    const ThreadCosts costs = ThreadCosts::ofThisThread() - before;
    QCOMPARE(costs.allocations, std::uint64_t(0));
    QCOMPARE(costs.locks, std::uint64_t(0));
    QCOMPARE(costs.pageFaults, std::uint64_t(0));
}

QTEST_GUILESS_MAIN(tst_CycleTap)
#include "tst_CycleTap.moc"
