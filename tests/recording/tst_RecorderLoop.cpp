// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RecordedFlight.h"
#include "recording/RecorderControl.h"
#include "recording/RecorderLoop.h"
#include "recording/Verification.h"

#include <QtTest/QtTest>

using namespace qplc;

namespace {

constexpr std::int64_t Second = NanosecondsPerSecond;

/// A disk that a test fills, and whose files it can have stall.
class TestDisk final : public Disk
{
public:
    std::unique_ptr<mcap::FileSink> create(const QString &file, QString *error) override
    {
        std::unique_ptr<mcap::FileSink> sink = mcap::FileSink::create(file, error);
        return sink ? std::make_unique<Sink>(std::move(sink), this) : nullptr;
    }
    std::uint64_t freeBytes(const QString & /*folder*/) override { return free; }

    std::uint64_t free = 1U << 30;
    std::uint64_t left = ~std::uint64_t(0);  // [byte] that can still be written
    std::function<void()> stall;             // called in each write

private:
    class Sink final : public mcap::FileSink
    {
    public:
        Sink(std::unique_ptr<FileSink> sink, TestDisk *disk)
            : m_sink(std::move(sink))
            , m_disk(disk)
        {
        }
        bool reserve(std::uint64_t bytes, QString *error) override
        {
            const std::uint64_t more = m_sink->size() + bytes;
            if (more <= m_reserved)
                return true;
            *error = "the disk is full";
            if (more - m_reserved > m_disk->left)
                return false;
            m_disk->left -= more - m_reserved;
            m_reserved = more;
            return true;
        }
        bool append(const QByteArray &bytes, QString *error) override
        {
            if (m_disk->stall)
                m_disk->stall();
            return reserve(std::uint64_t(bytes.size()), error) && m_sink->append(bytes, error);
        }
        bool sync(QString *error) override { return m_sink->sync(error); }
        std::uint64_t size() const override { return m_sink->size(); }

    private:
        std::unique_ptr<FileSink> m_sink;
        TestDisk *m_disk;
        std::uint64_t m_reserved = 0;
    };
};

/// A flight, its disk, and a loop whose time the test sets.
struct Recorded : RecordedFlight
{
    Recorded(std::size_t capacity = 1 << 20)
        : RecordedFlight(capacity)
    {
        recorder.detach();
        settings.folder = folder.filePath("recordings");
        settings.limits.leastFree = 0;
    }
    bool open()
    {
        loop = std::make_unique<RecorderLoop>(settings, disk);
        loop->setCallback([this](const RecorderLoop::FileNews &news) { told.push_back(news); });
        return loop->open(&error);
    }
    bool attach()
    {
        auto plant = std::make_unique<PlantRecorder>();
        if (!plant->attach(ringFile, &error))
            return false;
        loop->add(std::move(plant));
        return true;
    }
    /// As if the process were killed: nothing is finished, and the ring stays.
    void kill() { loop.reset(); }
    void proceed(double seconds)
    {
        now += std::int64_t(seconds * double(Second));
        wall += std::int64_t(seconds * 1000.0);
        for (int i = 0; i < 100 && loop->proceed(now, wall) == 0; ++i) {}
    }
    QStringList files() const
    {
        QStringList names;
        for (const RecordingFolder::File &one : RecordingFolder::files(settings.folder))
            names << one.path;
        return names;
    }
    /// Flies and records \a cycles in steps of a second of 100 cycles.
    void fly(int cycles)
    {
        for (int i = 0; i < cycles; i += 100) {
            step(100);
            proceed(1.0);
        }
    }
    void endPhase()
    {
        cycle.stop();
        proceed(1.0);
        proceed(1.0);
    }

    RecorderLoop::Settings settings;
    TestDisk disk;
    std::unique_ptr<RecorderLoop> loop;
    std::vector<RecorderLoop::FileNews> told;
    std::int64_t now = Second;
    std::int64_t wall = 1'764'194'112'000;  // 2025-11-26 21:55:12 UTC
};

VerifiedFile verified(const QString &file)
{
    VerifiedFile result;
    QString error;
    if (!verifyRecording(file, &result, &error))
        result.problems << error;
    return result;
}

const QString noEnd = "the end of the phase is not in the file";

/// Whether \a files have the cycles from 0 to \a last, each once, and all are as in the flight.
void requireWhole(const QStringList &files, quint64 last, quint64 digest)
{
    quint64 next = 0;
    for (const QString &name : files) {
        const VerifiedFile file = verified(name);
        const bool isLast = name == files.constLast();
        QCOMPARE(file.problems, isLast ? QStringList() : QStringList(noEnd));
        QVERIFY(file.gaps.isEmpty());
        QCOMPARE(file.from, next);
        next = file.next;
        if (isLast)
            QCOMPARE(file.digest, digest);
    }
    QCOMPARE(next, last + 1);
}

}  // namespace

// What a recorder does, in a time that the test sets.
class tst_RecorderLoop : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void namesOfFilesSayTimePlantAndPhase();
    void aFileEndsAfterItsTime();
    void aFileEndsAtItsSize();
    void theNextPhaseBeginsAFile();
    void theOldestFilesAreDeleted();
    void aMarkedFileStays();
    void aMarkKeepsTheFileBeforeAndTheOneBehind();
    void aSafeStopMarksItsFile();
    void strangersFilesStay();
    void aKilledRecorderIsContinued();
    void aFileWithoutCyclesDoesNotStay();
    void aFileThatHasNotBegunDoesNotStay();
    void theRingOfAKilledMasterIsFound();
    void ringsOfOtherRecordersAreNotMapped();
    void aRecorderThatEndsBetweenTwoFilesLeavesTheRing();
    void aFullDiskIsTriedAgainEachSecond();
    void theMasterIsToldWhatTheRecorderDoes();
    void aMarkInTheRingMarksTheFile();
    void aPartThatAMasterHasKeptIsRecordedAndMarked();
    void aFullDiskLeavesRoomForTheSummary();
    void aStalledDiskCostsGapsThatAreExact();
    void twoRecordersOfOneFolderAreRefused();
    void aClockThatIsSetBackKeepsTheOrderOfFiles();
    void aMarkIsAskedForFromOutside();
    void aStopEndsTheFileAndAStartGoesOn();
    void aStopHoldsForTheNextRecorder();
    void theStatusSaysWhatIsRecorded();
    void theFilesOfAPhaseAreVerifiedAsOne();
    void cyclesOfTwoFilesAreVerifiedOnce();
    void aMissingFileIsAGapUnlessItWasDeleted();
    void aFileOfAnotherFlightDoesNotGoOn();
    void aFileStandsForItsPhase();
};

void tst_RecorderLoop::namesOfFilesSayTimePlantAndPhase()
{
    Recorded flight;
    QVERIFY2(flight.open() && flight.attach() && flight.start(), qPrintable(flight.error));
    flight.fly(100);
    QCOMPARE(flight.files(),
             QStringList(flight.settings.folder + "/20251126T215513.000Z_kite_abcdef_phase1.mcap.part"));
    flight.endPhase();
    QCOMPARE(flight.files(), QStringList(flight.settings.folder + "/20251126T215513.000Z_kite_abcdef_phase1.mcap"));
    QCOMPARE(flight.told.size(), std::size_t(2));
    QCOMPARE(flight.told[1].cycles, quint64(100));
    QVERIFY(flight.told[1].isFinished);
    QVERIFY(!QFileInfo::exists(QFile::decodeName(flight.ringFile)));
}

void tst_RecorderLoop::aFileEndsAfterItsTime()
{
    Recorded flight;
    flight.settings.segmentTime = 10 * Second;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(3000);
    flight.endPhase();
    QCOMPARE(flight.files().size(), 3);
    requireWhole(flight.files(), 2999, flight.digest());
}

void tst_RecorderLoop::aFileEndsAtItsSize()
{
    Recorded flight;
    flight.settings.segmentSize = 20'000;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(3000);
    flight.endPhase();
    QVERIFY(flight.files().size() > 2);
    for (const QString &file : flight.files())
        QVERIFY(QFileInfo(file).size() < 40'000);
    requireWhole(flight.files(), 2999, flight.digest());
}

void tst_RecorderLoop::theNextPhaseBeginsAFile()
{
    Recorded first;
    QVERIFY(first.open() && first.attach() && first.start());
    first.fly(200);
    RecordedFlight second;
    second.description.phase = 2;
    second.recorder.detach();
    QString error;
    second.ring->memory().remove();
    QVERIFY(second.ring->create(second.ringFile, 1 << 20, second.description.toText(), &error));
    auto plant = std::make_unique<PlantRecorder>();
    QVERIFY2(plant->attach(second.ringFile, &error), qPrintable(error));
    first.loop->add(std::move(plant));  // before the end of the first one
    first.cycle.stop();
    QVERIFY(second.start());
    second.step(50);
    first.proceed(1.0);
    second.cycle.stop();
    first.proceed(1.0);
    const QStringList files = first.files();
    QCOMPARE(files.size(), 2);
    QVERIFY(files[0].endsWith("_phase1.mcap") && files[1].endsWith("_phase2.mcap"));
    requireWhole({files[0]}, 199, first.digest());
    requireWhole({files[1]}, 49, second.digest());
}

void tst_RecorderLoop::theOldestFilesAreDeleted()
{
    for (int limit = 0; limit < 3; ++limit) {
        Recorded flight;
        flight.settings.segmentTime = 10 * Second;
        if (limit == 0)
            flight.settings.limits.longestAge = 25'000;
        if (limit == 1)
            flight.settings.limits.largestTotal = 100'000;
        if (limit == 2)
            flight.settings.limits.leastFree = 1U << 20;
        QVERIFY(flight.open() && flight.attach() && flight.start());
        flight.fly(5000);
        const QString newest = flight.files().constLast();
        QVERIFY2((flight.files().size() < 5) == (limit != 2), qPrintable(flight.files().join(' ')));
        flight.disk.free = limit == 2 ? 1000 : flight.disk.free;  // only now the disk is nearly full
        flight.fly(2000);
        QVERIFY2(flight.files().size() < 5, qPrintable(flight.files().join(' ')));
        QVERIFY(limit == 2 || flight.files().size() >= 2);
        QVERIFY(flight.files().constLast().endsWith(".part"));  // this one is never deleted
    }
}

void tst_RecorderLoop::aMarkedFileStays()
{
    Recorded flight;
    flight.settings.segmentTime = 100 * Second;
    flight.settings.limits.longestAge = 150'000;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(5000);
    QVERIFY(flight.loop->mark(flight.now));
    const QString marked = flight.files().constFirst();
    QVERIFY2(marked.endsWith("_phase1_marked.mcap.part"), qPrintable(marked));
    flight.fly(50'000);
    QVERIFY(flight.files().constFirst().endsWith("_phase1_marked.mcap"));
    QVERIFY(flight.files().size() < 4);
    QCOMPARE(verified(flight.files().constFirst()).from, quint64(0));
    flight.endPhase();
}

void tst_RecorderLoop::aMarkKeepsTheFileBeforeAndTheOneBehind()
{
    Recorded flight;
    flight.settings.segmentTime = 100 * Second;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    const auto marks = [&] {
        QString text;
        for (const RecordingFolder::File &one : RecordingFolder::files(flight.settings.folder))
            text += one.isMarked ? 'm' : '-';
        return text;
    };
    flight.fly(11'000);  // 10 s into the second file: what was before is in the first one
    flight.loop->mark(flight.now);
    QCOMPARE(marks(), QString("mm"));
    flight.fly(14'500);
    QCOMPARE(marks(), QString("mm-"));
    flight.fly(4000);
    QCOMPARE(marks(), QString("mm-"));
    QVERIFY(flight.loop->mark(flight.now));  // in the last seconds of the third file
    flight.fly(700);
    QCOMPARE(marks(), QString("mmmm"));
    flight.endPhase();
}

void tst_RecorderLoop::aSafeStopMarksItsFile()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(300);
    QVERIFY(flight.files().constFirst().endsWith("_phase1.mcap.part"));
    // A record as the master writes it after a safe stop.
    RecordedCycle record;
    record.number = 300;
    record.flags = RecordedCycle::Safe;
    record.imageSize = flight.cycle.image().totalSize();
    const std::uint32_t size = std::uint32_t(sizeof(RecordHead) + sizeof record) + paddedRecordSize(record.imageSize);
    char *to = flight.ring->begin(size);
    std::memset(to, 0, size - sizeof(RecordHead));
    std::memcpy(to, &record, sizeof record);
    flight.ring->commit(RecordKind::Cycle, size);
    flight.proceed(1.0);
    QVERIFY(flight.files().constFirst().endsWith("_phase1_marked.mcap.part"));
    flight.endPhase();
    QVERIFY(flight.files().constFirst().endsWith("_phase1_marked.mcap"));
}

void tst_RecorderLoop::strangersFilesStay()
{
    Recorded flight;
    flight.settings.limits.largestTotal = 1;
    flight.settings.limits.longestAge = 1;
    QVERIFY(flight.open());
    const QStringList names{"flight.mcap", "notes.txt", "20251126T215513.000Z_kite.mcap",
                            "20259926T215513.000Z_kite_abcdef_phase1.mcap"};
    for (const QString &name : names) {
        QFile file(flight.settings.folder + '/' + name);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("a text");
    }
    QVERIFY(flight.attach() && flight.start());
    flight.fly(300);
    flight.endPhase();
    flight.proceed(3600.0);
    QVERIFY(flight.files().isEmpty());
    for (const QString &name : names)
        QVERIFY(QFileInfo::exists(flight.settings.folder + '/' + name));
}

void tst_RecorderLoop::aKilledRecorderIsContinued()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(500);
    flight.step(70);
    flight.proceed(0.01);  // in memory, and not in the file
    flight.kill();
    flight.step(30);
    QVERIFY2(flight.open() && flight.attach(), qPrintable(flight.error));
    QCOMPARE(flight.files().size(), 1);
    QVERIFY(flight.files().constFirst().endsWith(".mcap"));  // it was finished
    flight.fly(400);
    flight.endPhase();
    QCOMPARE(flight.files().size(), 2);
    requireWhole(flight.files(), 999, flight.digest());
}

void tst_RecorderLoop::aFileWithoutCyclesDoesNotStay()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach());
    flight.proceed(0.01);
    QCOMPARE(flight.files().size(), 1);  // it has its head
    flight.kill();
    QVERIFY2(flight.open(), qPrintable(flight.error));
    QCOMPARE(flight.files(), QStringList());
    QVERIFY(flight.attach() && flight.start());
    flight.fly(400);
    flight.endPhase();
    QCOMPARE(flight.files().size(), 1);
    requireWhole(flight.files(), 399, flight.digest());
}

/// Its recorder was killed between the creation of the file and the first write.
void tst_RecorderLoop::aFileThatHasNotBegunDoesNotStay()
{
    for (const QByteArray &begin : {QByteArray(), QByteArray("\x89MCAP", 5)}) {
        Recorded flight;
        QVERIFY(flight.open() && flight.attach() && flight.start());
        flight.fly(500);
        flight.kill();
        QFile file(QString(flight.files().constFirst()).replace("T2155", "T2255"));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(begin) == begin.size());
        file.close();
        QVERIFY2(flight.open() && flight.attach(), qPrintable(flight.error));
        QCOMPARE(flight.files().size(), 1);
        flight.fly(400);
        flight.endPhase();
        requireWhole(flight.files(), 899, flight.digest());
    }
}

void tst_RecorderLoop::theRingOfAKilledMasterIsFound()
{
    QTemporaryDir rings("/dev/shm/qtplc-test-XXXXXX");
    qputenv("QTPLC_RING_DIR", rings.path().toUtf8());
    {
        Recorded flight;
        flight.settings.looksForRings = true;
        QVERIFY(flight.open() && flight.attach() && flight.start());
        flight.fly(500);
        flight.step(50);
        flight.kill();
        flight.step(50);
        flight.ring->memory().unlock(RingMemory::WriterLock);  // as the kernel does when it ends a process
        const QString found = rings.filePath("qtplc-ring-1-kite-abcdef-1");
        QVERIFY(QFile::rename(QFile::decodeName(flight.ringFile), found));
        QVERIFY(flight.open());
        flight.proceed(1.0);
        flight.proceed(1.0);
        flight.proceed(1.0);
        QVERIFY(!QFileInfo::exists(found));
        QCOMPARE(flight.files().size(), 2);
        const VerifiedFile second = verified(flight.files().constLast());
        QCOMPARE(second.problems, QStringList(noEnd));
        QCOMPARE(second.from, verified(flight.files().constFirst()).next);
        QCOMPARE(second.next, quint64(600));
        QCOMPARE(second.digest, flight.digest());
        QVERIFY(flight.told.back().isAbandoned);
        QVERIFY2(flight.files().constLast().endsWith("_marked.mcap"), "a master that was killed is worth to be kept");
    }
    qunsetenv("QTPLC_RING_DIR");
}

/// It looks five times a second, and a ring may have 64 MiB.
void tst_RecorderLoop::ringsOfOtherRecordersAreNotMapped()
{
    QTemporaryDir rings("/dev/shm/qtplc-test-XXXXXX");
    qputenv("QTPLC_RING_DIR", rings.path().toUtf8());
    {
        Recorded flight;
        flight.settings.looksForRings = true;
        RecordRing ring;
        RingReader other;
        const QByteArray file = rings.filePath("qtplc-ring-1-other-2-1").toUtf8();
        QVERIFY(ring.create(file, 1 << 16, flight.description.toText(), &flight.error));
        QVERIFY(other.open(file, &flight.error) && other.attach());
        QVERIFY(flight.open());
        const std::uint64_t before = RingMemory::mappings();
        for (int i = 0; i < 50; ++i)
            flight.proceed(0.2);
        QCOMPARE(RingMemory::mappings(), before);
        other.detach();
        flight.proceed(0.2);
        flight.proceed(0.2);
        QCOMPARE(RingMemory::mappings(), before + 1);
        QCOMPARE(flight.loop->status().phases, 1);
    }
    qunsetenv("QTPLC_RING_DIR");
}

void tst_RecorderLoop::aRecorderThatEndsBetweenTwoFilesLeavesTheRing()
{
    Recorded flight;
    flight.settings.segmentTime = 10 * Second;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(100);
    flight.step(100);
    flight.now += flight.settings.segmentTime;
    flight.loop->proceed(flight.now, flight.wall);  // ends the file, and no more
    QCOMPARE(flight.files().size(), 1);
    QVERIFY(!flight.files().constFirst().endsWith(".part"));
    QVERIFY(flight.ring->isRead());
    QVERIFY2(flight.loop->end(flight.wall, &flight.error), qPrintable(flight.error));
    QVERIFY(!flight.ring->isRead());
}

void tst_RecorderLoop::aFullDiskIsTriedAgainEachSecond()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(300);
    flight.disk.left = 0;
    flight.fly(200);
    QVERIFY(flight.loop->status().hasFailed);
    QCOMPARE(flight.loop->status().error, QString("the disk is full"));
    const qint64 size = QFileInfo(flight.files().constFirst()).size();
    flight.fly(300);
    QCOMPARE(QFileInfo(flight.files().constFirst()).size(), size);
    flight.disk.left = 1U << 30;
    flight.fly(200);
    QVERIFY(!flight.loop->status().hasFailed);
    flight.endPhase();
    requireWhole(flight.files(), 999, flight.digest());
}

void tst_RecorderLoop::theMasterIsToldWhatTheRecorderDoes()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    const RecorderReportPlace &place = flight.ring->memory().header()->report;
    flight.fly(500);
    std::optional<RecorderReport> report = place.read();
    QVERIFY(report);
    QCOMPARE(report->state, RecorderReport::Recording);
    QCOMPARE(report->file, flight.files().constFirst());
    QCOMPARE(report->freeBytes, flight.disk.free);
    QVERIFY(report->bytesPerSecond > 0);
    flight.disk.left = flight.disk.free = 0;
    flight.fly(200);
    report = place.read();
    QCOMPARE(report->state, RecorderReport::DiskFull);
    QCOMPARE(report->error, QString("the disk is full"));
    flight.disk.free = 1U << 30;  // of something else
    flight.fly(200);
    QCOMPARE(place.read()->state, RecorderReport::Failing);
    flight.disk.left = 1U << 30;
    flight.fly(200);
    QCOMPARE(place.read()->state, RecorderReport::Recording);
    QVERIFY(RecorderControl::setStopped(flight.settings.folder, true, &flight.error));
    flight.fly(100);
    QCOMPARE(place.read()->state, RecorderReport::Stopped);
    QVERIFY(!flight.ring->isRead());
}

void tst_RecorderLoop::aMarkInTheRingMarksTheFile()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(100);
    QVERIFY(!flight.files().constFirst().contains("_marked"));
    flight.ring->memory().header()->wishes.fetch_add(1);
    flight.fly(100);
    QVERIFY(flight.files().constFirst().contains("_marked"));
}

void tst_RecorderLoop::aPartThatAMasterHasKeptIsRecordedAndMarked()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.start());
    flight.step(300);
    flight.ring->memory().header()->isCut = 1;
    flight.ring->memory().unlock(RingMemory::WriterLock);
    QVERIFY(flight.attach());
    flight.proceed(1.0);
    flight.proceed(1.0);
    QCOMPARE(flight.files().size(), 1);
    QVERIFY(flight.files().constFirst().endsWith("_marked.mcap"));
    QVERIFY2(!flight.told.back().isAbandoned, "its master may go on");
    const VerifiedFile file = verified(flight.files().constFirst());
    QVERIFY(file.isFinished);
    QCOMPARE(file.problems, QStringList(noEnd));
    QVERIFY2(!QFile::exists(flight.ringFile), "all of it is in the file");
}

void tst_RecorderLoop::aFullDiskLeavesRoomForTheSummary()
{
    Recorded flight;
    flight.disk.left = 60'000;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    int cycles = 0;
    for (; !flight.loop->status().hasFailed && cycles < 10'000; cycles += 100)
        flight.fly(100);
    QVERIFY(flight.loop->status().hasFailed);
    flight.disk.left = 0;  // others have taken the rest
    QVERIFY(!flight.loop->end(flight.wall, &flight.error));
    const VerifiedFile file = verified(flight.files().constFirst());
    QVERIFY(file.isFinished);
    QVERIFY(file.next > 500 && file.next < quint64(cycles));
    QCOMPARE(file.problems, QStringList(noEnd));
}

void tst_RecorderLoop::aStalledDiskCostsGapsThatAreExact()
{
    Recorded flight(1 << 16);
    flight.phase.clock = QPlcClock::realTime();
    flight.phase.period = std::chrono::microseconds(100);
    QVERIFY(flight.open() && flight.attach());
    int stalls = 0;
    // The disk stalls once, until the master has cycles for which the ring has no room.
    flight.disk.stall = [&] {
        if (flight.cycle.statistics().cycles > 50 && stalls == 0) {
            ++stalls;
            QTRY_VERIFY(flight.cycle.tap().missing() > 100);
        }
    };
    QVERIFY(flight.start());
    QTRY_VERIFY((flight.proceed(1.0), stalls > 0));
    flight.proceed(1.0);
    flight.cycle.stop();
    flight.proceed(1.0);
    flight.proceed(1.0);
    QCOMPARE(flight.files().size(), 1);
    const VerifiedFile file = verified(flight.files().constFirst());
    QCOMPARE(file.problems, QStringList());
    QCOMPARE(file.missing, flight.cycle.tap().missing());
    QVERIFY(file.missing > 0);
    QCOMPARE(file.cycles + file.missing + file.skipped, file.next);
    QCOMPARE(file.digest, flight.digest());
}

void tst_RecorderLoop::twoRecordersOfOneFolderAreRefused()
{
    Recorded flight;
    QVERIFY(flight.open());
    RecorderLoop second(flight.settings, flight.disk);
    QString error;
    QVERIFY(!second.open(&error));
    QVERIFY2(error.contains("another recorder records into"), qPrintable(error));
}

void tst_RecorderLoop::aClockThatIsSetBackKeepsTheOrderOfFiles()
{
    Recorded flight;
    flight.settings.segmentTime = 10 * Second;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(1500);
    flight.wall -= 3'600'000;
    flight.fly(2000);
    flight.endPhase();
    QVERIFY(flight.files().size() >= 3);
    requireWhole(flight.files(), 3499, flight.digest());
}

void tst_RecorderLoop::aMarkIsAskedForFromOutside()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(100);
    QVERIFY(flight.files().constFirst().endsWith("_phase1.mcap.part"));
    QVERIFY2(RecorderControl::askForMark(flight.settings.folder, &flight.error), qPrintable(flight.error));
    QVERIFY(!RecorderControl::isMarkTaken(flight.settings.folder));
    flight.fly(100);
    QVERIFY(RecorderControl::isMarkTaken(flight.settings.folder));
    QVERIFY(flight.files().constFirst().endsWith("_phase1_marked.mcap.part"));
    QVERIFY(!RecorderControl::askForMark("/no-such-folder", &flight.error));
}

void tst_RecorderLoop::aStopEndsTheFileAndAStartGoesOn()
{
    Recorded flight;
    QVERIFY(flight.open() && flight.attach() && flight.start());
    flight.fly(300);
    QVERIFY(RecorderControl::setStopped(flight.settings.folder, true, &flight.error));
    flight.fly(200);
    QVERIFY(!flight.ring->isRead());  // it shows the last seconds
    QCOMPARE(flight.files().size(), 1);
    QVERIFY(flight.files().constFirst().endsWith(".mcap"));
    QCOMPARE(RecorderControl::status(flight.settings.folder).value("state"), QByteArray("stopped"));
    QVERIFY(RecorderControl::setStopped(flight.settings.folder, false, &flight.error));
    flight.fly(100);
    QVERIFY(flight.ring->isRead());
    QCOMPARE(RecorderControl::status(flight.settings.folder).value("state"), QByteArray("recording"));
    flight.endPhase();
    QCOMPARE(flight.files().size(), 2);
    requireWhole(flight.files(), 599, flight.digest());  // the ring still had what was between
}

void tst_RecorderLoop::aStopHoldsForTheNextRecorder()
{
    Recorded flight;
    QVERIFY(flight.open());
    QVERIFY(RecorderControl::setStopped(flight.settings.folder, true, &flight.error));
    flight.kill();
    QVERIFY(flight.open());
    flight.proceed(1.0);
    QVERIFY(flight.attach() && flight.start());
    flight.fly(100);
    QVERIFY(flight.files().isEmpty());
    QVERIFY(!flight.ring->isRead());
    QVERIFY(RecorderControl::setStopped(flight.settings.folder, false, &flight.error));
    flight.fly(100);
    flight.endPhase();
    requireWhole(flight.files(), 199, flight.digest());
}

void tst_RecorderLoop::theStatusSaysWhatIsRecorded()
{
    Recorded flight;
    QVERIFY(!RecorderControl::hasRecorder(flight.settings.folder));
    QVERIFY(flight.open());
    QVERIFY(RecorderControl::hasRecorder(flight.settings.folder));
    flight.proceed(1.0);
    QCOMPARE(RecorderControl::status(flight.settings.folder).value("state"), QByteArray("waiting"));
    QVERIFY(flight.attach() && flight.start());
    flight.fly(500);
    flight.disk.left = 0;
    flight.fly(300);
    const RecorderControl::Status status = RecorderControl::status(flight.settings.folder);
    QCOMPARE(status.value("state"), QByteArray("retrying"));
    QCOMPARE(status.value("error"), QByteArray("the disk is full"));
    QCOMPARE(status.value("phases"), QByteArray("1"));
    QVERIFY(status.value("cycles").toInt() >= 500);
    QVERIFY(status.value("bytes").toInt() > 10'000);
    QCOMPARE(status.value("file"), flight.files().constFirst().toUtf8());
    flight.kill();
    QVERIFY(!RecorderControl::hasRecorder(flight.settings.folder));
}

/// Fifty seconds in five files. \return the folder
static QString flyInFiveFiles(Recorded *flight)
{
    flight->settings.segmentTime = 10 * Second;
    if (!flight->open() || !flight->attach() || !flight->start())
        qFatal("%s", qPrintable(flight->error));
    flight->fly(5000);
    flight->endPhase();
    return flight->settings.folder;
}

static VerifiedPhase verifiedFolder(const QString &folder)
{
    QVector<RecordedPhase> phases;
    QString error;
    QStringList unreadable;
    if (!findPhases(folder, &phases, &unreadable, &error) || phases.size() != 1)
        qFatal("%lld phases: %s", qlonglong(phases.size()), qPrintable(error));
    return verifyPhase(phases.first());
}

void tst_RecorderLoop::theFilesOfAPhaseAreVerifiedAsOne()
{
    Recorded flight;
    const VerifiedPhase phase = verifiedFolder(flyInFiveFiles(&flight));
    QCOMPARE(phase.problems, QStringList());
    QVERIFY(phase.isComplete() && phase.deleted.isEmpty());
    QCOMPARE(phase.phase.files, flight.files());
    QCOMPARE(phase.phase.files.size(), 5);
    QCOMPARE(phase.cycles, quint64(5000));
    QCOMPARE(phase.firstCycle, quint64(0));
    QCOMPARE(phase.lastCycle, quint64(4999));
    QCOMPARE(phase.digest, flight.digest());
}

void tst_RecorderLoop::cyclesOfTwoFilesAreVerifiedOnce()
{
    Recorded flight;
    const QString folder = flyInFiveFiles(&flight);
    const QString file = flight.files()[1];
    QVERIFY(QFile::copy(file, QString(file).replace(".mcap", "_piece_marked.mcap")));
    const VerifiedPhase phase = verifiedFolder(folder);
    QVERIFY2(phase.isComplete(), qPrintable(phase.problems.join('\n')));
    QCOMPARE(phase.phase.files.size(), 6);
    QCOMPARE(phase.cycles, quint64(5000));
    QCOMPARE(phase.digest, flight.digest());
}

void tst_RecorderLoop::aMissingFileIsAGapUnlessItWasDeleted()
{
    Recorded flight;
    const QString folder = flyInFiveFiles(&flight);
    const VerifiedFile lost = verified(flight.files()[2]);
    QVERIFY(QFile::remove(flight.files()[2]));
    VerifiedPhase phase = verifiedFolder(folder);
    QVERIFY(!phase.isComplete() && phase.deleted.isEmpty());
    QCOMPARE(phase.gaps.size(), 1);
    QCOMPARE(phase.gaps[0].first, lost.from);
    QCOMPARE(phase.gaps[0].last, lost.next - 1);
    QCOMPARE(phase.missing, lost.cycles);
    QCOMPARE(phase.cycles + phase.missing, quint64(5000));

    for (int i = 0; i < 2; ++i)
        RecordingFolder::mark(flight.files()[i]);
    phase = verifiedFolder(folder);
    QVERIFY2(phase.isComplete(), qPrintable(phase.problems.join('\n')));
    QCOMPARE(phase.deleted.size(), 1);
    QCOMPARE(phase.deleted[0].first, lost.from);

    QVERIFY(QFile::remove(flight.files()[0]) && QFile::remove(flight.files()[0]));
    phase = verifiedFolder(folder);
    QVERIFY(phase.isComplete());
    QCOMPARE(phase.deleted.size(), 1);
    QCOMPARE(phase.deleted[0].first, quint64(0));
    QCOMPARE(phase.deleted[0].last, lost.next - 1);

    QVERIFY(QFile::remove(flight.files().constLast()));
    phase = verifiedFolder(folder);
    QCOMPARE(phase.problems, QStringList("the end of the phase is not in the files"));
}

void tst_RecorderLoop::aFileOfAnotherFlightDoesNotGoOn()
{
    Recorded flight;
    Recorded other;
    other.number = 1;  // other values
    const QString folder = flyInFiveFiles(&flight);
    flyInFiveFiles(&other);
    const QString name = flight.files()[2];
    QVERIFY(QFile::remove(name) && QFile::copy(other.files()[2], name));
    const VerifiedPhase phase = verifiedFolder(folder);
    QVERIFY(!phase.isComplete());
    QCOMPARE(phase.problems.size(), 2);  // it, and the one behind it
    QVERIFY2(phase.problems[0].startsWith(name + " does not go on where the file before has ended"),
             qPrintable(phase.problems[0]));
}

void tst_RecorderLoop::aFileStandsForItsPhase()
{
    Recorded flight;
    const QString folder = flyInFiveFiles(&flight);
    const QStringList files = flight.files();
    RecordedPhase phase;
    QStringList unreadable;
    QString error;
    QVERIFY2(findPhase(files[3], &phase, &unreadable, &error), qPrintable(error));
    QCOMPARE(phase.files, files);
    QVERIFY(QFile::copy(files[3], flight.folder.filePath("alone.mcap")));
    QVERIFY(findPhase(flight.folder.filePath("alone.mcap"), &phase, &unreadable, &error));
    QCOMPARE(phase.files, QStringList(flight.folder.filePath("alone.mcap")));
    QCOMPARE(phase.name(), phase.files.first());

    QVERIFY(findPhase(folder, &phase, &unreadable, &error));
    QCOMPARE(phase.files, files);
    QVERIFY2(phase.name().endsWith("phase 1 of session abcdef, 5 files"), qPrintable(phase.name()));
    QVERIFY(!findPhase(flight.folder.filePath("nowhere.mcap"), &phase, &unreadable, &error));
    QVERIFY2(error.contains("nowhere.mcap"), qPrintable(error));
    QVERIFY(unreadable.isEmpty());
    QFile odd(folder + "/odd.mcap");
    QVERIFY(odd.open(QIODevice::WriteOnly) && odd.write("odd") == 3);
    odd.close();
    QVERIFY2(findPhase(folder, &phase, &unreadable, &error), qPrintable(error));
    QCOMPARE(phase.files, files);
    QCOMPARE(unreadable.size(), 1);
    QVERIFY2(unreadable[0].contains("odd.mcap"), qPrintable(unreadable[0]));
    const QTemporaryDir empty;
    QVERIFY(!findPhase(empty.path(), &phase, &unreadable, &error));
    QVERIFY2(error.contains("has no recording"), qPrintable(error));
}

QTEST_GUILESS_MAIN(tst_RecorderLoop)
#include "tst_RecorderLoop.moc"
