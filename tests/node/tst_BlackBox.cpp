// SPDX-License-Identifier: Apache-2.0
#include "RingFixtures.h"
#include "node/session/BlackBox.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QtTest>

using namespace qplc;

namespace {

/// A phase with a cycle each second, whose ring nobody records.
struct Phase
{
    explicit Phase(double cyclesInRing = 1e6)
    {
        qputenv("QTPLC_RING_DIR", folder.path().toUtf8());
        RingDescription description;
        description.period = 1'000'000'000;
        description.table = "[x]\ntype = Real64\n";
        rings.setPlant("kite", 1);
        ring = rings.make(description, std::size_t(1e6 / cyclesInRing * 80.0));
        box.watch(ring, std::chrono::seconds(1));
    }
    void roster()
    {
        const RecordedRoster record{newest, 1, 0};
        std::memcpy(ring->begin(sizeof(RecordHead) + sizeof record), &record, sizeof record);
        ring->commit(RecordKind::Roster, sizeof(RecordHead) + sizeof record);
    }
    /// \param size [byte] of the image
    void run(int cycles, std::uint32_t size = 0)
    {
        for (int i = 0; i < cycles; ++i) {
            RecordedCycle record;
            record.number = newest++;
            record.imageSize = size;
            const auto bytes = std::uint32_t(sizeof(RecordHead) + sizeof record) + size;
            std::memcpy(ring->begin(bytes), &record, sizeof record);
            ring->commit(RecordKind::Cycle, bytes);
        }
    }
    QStringList files() const { return QDir(folder.path()).entryList({"*-part*"}, QDir::Files, QDir::Name); }
    /// Looks until there are so many parts.
    bool wait(int parts)
    {
        return QTest::qWaitFor([&] {
            box.look();
            return files().size() == parts && journal.events().after(0, 100).size() == std::size_t(parts);
        });
    }

    QTemporaryDir folder{"/dev/shm/qtplc-test-XXXXXX"};
    Journal journal;
    PhaseRing rings{journal};
    std::shared_ptr<RecordRing> ring;
    std::uint64_t newest = 0;  // cycle that comes next
    bool isRunning = true;
    BlackBox box{journal, rings, {[this] { return isRunning; }, [this] { return newest - 1; }}};
};

struct Content
{
    std::vector<std::uint64_t> cycles;
    bool beginsWithRoster = false;
    bool isCut = false;
};

Content contentOf(const QString &file)
{
    RingReader reader;
    QString error;
    Content content;
    if (!reader.open(file.toUtf8(), &error))
        return content;
    content.isCut = reader.memory().header()->isCut != 0;
    while (reader.next() == RingReader::Found) {
        CycleView view;
        if (reader.kind() == RecordKind::Roster)
            content.beginsWithRoster = content.cycles.empty();
        else if (CycleView::read(reader.body(), reader.size(), &view))
            content.cycles.push_back(view.cycle.number);
    }
    return content;
}

}  // namespace

// What stays of the cycles when nobody records.
class tst_BlackBox : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { qunsetenv("QTPLC_RING_DIR"); }
    void theCyclesAroundAStopAreKept();
    void aMarkOfAnotherProcessIsTaken();
    void nothingIsKeptWithoutAReason();
    void whatARecorderHasIsNotKeptAgain();
    void aShortRingKeepsWhatWasBefore();
    void aPhaseThatEndsBeforeLeavesItsRing();
    void anOrdinaryPhaseLeavesNothing();
    void onlyTheNewestFourStay();
    void withoutMemoryTheRingStaysAndTheJournalSaysWhy();
};

void tst_BlackBox::theCyclesAroundAStopAreKept()
{
    Phase phase;
    phase.roster();
    phase.run(100);
    phase.box.keep("safe stop");
    phase.run(10);
    phase.box.look();
    QCOMPARE(phase.files(), QStringList());
    phase.run(50);
    QVERIFY(phase.wait(1));
    const QString file = phase.folder.filePath(phase.files().constFirst());
    const Content content = contentOf(file);
    QCOMPARE(content.cycles.size(), std::size_t(41));
    QCOMPARE(content.cycles.front(), std::uint64_t(69));
    QCOMPARE(content.cycles.back(), std::uint64_t(109));
    QVERIFY(content.beginsWithRoster);
    QVERIFY(content.isCut);
    QVERIFY(RingMemory::useOf(file.toUtf8()) == RingMemory::Dead);
    QCOMPARE(QFile(file).permissions() & ~(QFile::ReadUser | QFile::WriteUser),
             QFile::Permissions(QFile::ReadOwner | QFile::WriteOwner));
}

void tst_BlackBox::aMarkOfAnotherProcessIsTaken()
{
    Phase phase;
    phase.run(5);
    RingMemory other;
    QString error;
    QVERIFY(other.open(phase.ring->memory().file(), &error));
    other.header()->wishes.fetch_add(1);
    phase.box.look();
    phase.run(11);
    QVERIFY(phase.wait(1));
    const Content content = contentOf(phase.folder.filePath(phase.files().constFirst()));
    QCOMPARE(content.cycles.size(), std::size_t(15));
    QCOMPARE(content.cycles.front(), std::uint64_t(0));
}

void tst_BlackBox::nothingIsKeptWithoutAReason()
{
    Phase phase;
    phase.run(100);
    phase.box.look();
    QCOMPARE(phase.files(), QStringList());
    QVERIFY(phase.journal.events().after(0, 100).empty());
}

void tst_BlackBox::whatARecorderHasIsNotKeptAgain()
{
    Phase phase;
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(phase.ring->memory().file(), &error) && recorder.attach());
    phase.run(100);
    phase.box.keep("safe stop");
    phase.run(20);
    phase.box.look();
    phase.box.look();
    QVERIFY(phase.journal.events().after(0, 100).empty());
    recorder.detach();
    phase.rings.setPlant("other", 1);
    QCOMPARE(phase.files(), QStringList());
}

void tst_BlackBox::aShortRingKeepsWhatWasBefore()
{
    Phase phase;
    const quint64 capacity = phase.ring->capacity();
    const auto image = std::uint32_t(capacity / 16 - sizeof(RecordHead) - sizeof(RecordedCycle));
    phase.run(100, image);  // the ring has 16 of them
    phase.box.keep("safe stop");
    phase.run(9, image);
    QVERIFY(phase.wait(1));
    const Content content = contentOf(phase.folder.filePath(phase.files().constFirst()));
    QVERIFY(!content.cycles.empty() && content.cycles.front() < 98);
    QCOMPARE(content.cycles.back(), std::uint64_t(108));
}

void tst_BlackBox::aPhaseThatEndsBeforeLeavesItsRing()
{
    Phase phase;
    phase.run(100);
    const QString file = phase.rings.file();
    phase.box.keep("fault");
    phase.isRunning = false;
    phase.box.look();
    phase.box.watch(nullptr, std::chrono::seconds(1));
    phase.ring.reset();
    RingDescription next;
    next.period = 1'000'000'000;
    QVERIFY(phase.rings.make(next, 80));
    QVERIFY(RingMemory::useOf(file.toUtf8()) == RingMemory::Dead);
    QCOMPARE(contentOf(file).cycles.size(), std::size_t(100));
}

void tst_BlackBox::anOrdinaryPhaseLeavesNothing()
{
    Phase phase;
    phase.run(100);
    const QString file = phase.rings.file();
    phase.ring.reset();
    RingDescription next;
    next.period = 1'000'000'000;
    QVERIFY(phase.rings.make(next, 80));
    QVERIFY(!QFile::exists(file));
}

void tst_BlackBox::onlyTheNewestFourStay()
{
    Phase phase;
    for (int i = 1; i <= 6; ++i) {
        phase.run(5);
        phase.box.keep("a mark");
        phase.run(11);
        QVERIFY(QTest::qWaitFor([&] {
            phase.box.look();
            return phase.journal.events().after(0, 100).size() == std::size_t(i);
        }));
    }
    QCOMPARE(phase.files().size(), 4);
    QVERIFY2(QFile::exists(phase.rings.file()), "the ring of the phase is none of them");
}

void tst_BlackBox::withoutMemoryTheRingStaysAndTheJournalSaysWhy()
{
    Phase phase;
    phase.run(100);
    phase.box.keep("safe stop");
    phase.run(20);
    QVERIFY(
        QFile(phase.folder.filePath(QFileInfo(phase.rings.file()).fileName() + "-part1")).open(QIODevice::WriteOnly));
    QTest::ignoreMessage(QtWarningMsg, QRegularExpression("cannot be kept"));
    QVERIFY(phase.wait(1));
    const QString file = phase.rings.file();
    phase.ring.reset();
    RingDescription next;
    next.period = 1'000'000'000;
    QVERIFY(phase.rings.make(next, 80));
    QVERIFY2(QFile::exists(file), "it is all there is");
}

QTEST_GUILESS_MAIN(tst_BlackBox)
#include "tst_BlackBox.moc"
