// SPDX-License-Identifier: Apache-2.0
#include "RecordedFlight.h"
#include "recording/McapReader.h"
#include "recording/Verification.h"

#include <QtTest/QtTest>

using namespace qplc;
using mcap::FileSink;

namespace {

/// A file on a disk that is full now and then.
class FullDisk final : public FileSink
{
public:
    FullDisk(std::unique_ptr<FileSink> file, bool *isFull)
        : m_file(std::move(file))
        , m_isFull(isFull)
    {
    }
    bool append(const QByteArray &bytes, QString *error) override
    {
        *error = "the disk is full";
        return !*m_isFull && m_file->append(bytes, error);
    }
    bool sync(QString *error) override { return m_file->sync(error); }
    std::uint64_t size() const override { return m_file->size(); }

private:
    std::unique_ptr<FileSink> m_file;
    bool *m_isFull;
};

VerifiedFile verified(const QString &file)
{
    VerifiedFile result;
    QString error;
    if (!verifyRecording(file, &result, &error))
        result.problems << error;
    return result;
}

}  // namespace

// From the ring of a master into a file.
class tst_PlantRecorder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theFileHasTheWholeFlight();
    void theRingKeepsWhatIsNotInTheFile();
    void cyclesWithoutARecordAreInTheFileAsAGap();
    void aRecorderThatStartsLateSaysSo();
    void aFullDiskLosesNothing();
    void anotherRecorderGoesOnInAnotherFile();
    void theRingOfAKilledMasterIsRecordedToItsEnd();
    void equalFlightsMakeEqualFiles();
    void aChangedImageIsFound();
    void aMissingCycleIsFound();
    void twoRecordersOfOneRingAreRefused();
};

void tst_PlantRecorder::theFileHasTheWholeFlight()
{
    RecordedFlight flight;
    QVERIFY2(flight.begin(), qPrintable(flight.error));
    QVERIFY(flight.start());
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Waiting);
    for (int i = 0; i < 10; ++i) {
        flight.step(100);
        QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    }
    flight.cycle.stop();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY2(flight.recorder.finish(&flight.error), qPrintable(flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.problems, QStringList());
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(1000));
    QCOMPARE(file.lastCycle, quint64(999));
    QCOMPARE(file.digest, flight.digest());
    QCOMPARE(file.description.plant, QString("kite"));
    QCOMPARE(file.checkedCycles, quint64(1000));
}

void tst_PlantRecorder::theRingKeepsWhatIsNotInTheFile()
{
    RecordedFlight flight(1 << 16);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step(50);
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(0));
    QVERIFY(flight.recorder.save(true, &flight.error));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(flight.ring->memory().header()->head));
}

void tst_PlantRecorder::cyclesWithoutARecordAreInTheFileAsAGap()
{
    RecordedFlight flight(1 << 16);
    flight.phase.clock = QPlcClock::realTime();
    flight.phase.period = std::chrono::microseconds(100);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    QTRY_VERIFY(flight.cycle.tap().missing() > 100);
    flight.cycle.stop();
    PlantRecorder::Progress progress = PlantRecorder::Recorded;
    while (progress == PlantRecorder::Recorded)
        progress = flight.recorder.proceed(&flight.error);
    QCOMPARE(progress, PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.problems, QStringList());  // the digest is right on both sides of the gap
    QCOMPARE(file.gaps.size(), 1);
    QVERIFY(!file.isComplete());
    QCOMPARE(file.missing, flight.cycle.tap().missing());
    QCOMPARE(file.cycles + file.missing + file.skipped, file.gaps[0].last + 1);
    QCOMPARE(file.digest, flight.digest());
}

void tst_PlantRecorder::aRecorderThatStartsLateSaysSo()
{
    RecordedFlight flight(1 << 16);
    flight.recorder.detach();
    QVERIFY(flight.start());
    flight.step(3000);
    PlantRecorder late;
    QVERIFY2(late.attach(flight.ringFile, &flight.error), qPrintable(flight.error));
    flight.file = flight.folder.filePath("late.mcap");
    QVERIFY(late.begin(FileSink::create(flight.file, &flight.error), &flight.error));
    flight.cycle.stop();
    PlantRecorder::Progress progress = PlantRecorder::Recorded;
    while (progress == PlantRecorder::Recorded)
        progress = late.proceed(&flight.error);
    QCOMPARE(progress, PlantRecorder::Ended);
    QVERIFY(late.finish(&flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.gaps.size(), 1);
    QCOMPARE(file.gaps[0].first, quint64(0));
    QCOMPARE(file.gaps[0].last + 1, file.firstCycle);
    QCOMPARE(file.lastCycle, quint64(2999));
    QCOMPARE(file.missing + file.cycles, quint64(3000));
}

void tst_PlantRecorder::aFullDiskLosesNothing()
{
    RecordedFlight flight;
    bool isFull = false;
    flight.file = flight.folder.filePath("full.mcap");
    QVERIFY(flight.begin(std::make_unique<FullDisk>(FileSink::create(flight.file, &flight.error), &isFull)));
    QVERIFY(flight.start());
    flight.step(100);
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    isFull = true;
    QVERIFY(!flight.recorder.save(false, &flight.error));
    QCOMPARE(flight.error, QString("the disk is full"));
    flight.step(500);
    flight.recorder.proceed(&flight.error);
    QVERIFY(!flight.recorder.save(false, &flight.error));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(0));
    isFull = false;
    flight.cycle.stop();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.problems, QStringList());
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(600));
}

void tst_PlantRecorder::anotherRecorderGoesOnInAnotherFile()
{
    RecordedFlight flight;
    QString error;
    auto killed = std::make_unique<PlantRecorder>();
    flight.recorder.detach();
    QVERIFY(killed->attach(flight.ringFile, &error));
    const QString first = flight.folder.filePath("first.mcap");
    QVERIFY(killed->begin(FileSink::create(first, &error), &error));
    QVERIFY(flight.start());
    flight.step(100);
    killed->proceed(&error);
    QVERIFY(killed->save(false, &error));
    flight.step(50);
    killed->proceed(&error);
    killed.reset();  // as if it were killed: what was in its memory is in the ring
    flight.step(50);
    PlantRecorder next;
    QVERIFY2(next.attach(flight.ringFile, &error), qPrintable(error));
    const QString second = flight.folder.filePath("second.mcap");
    QVERIFY(next.begin(FileSink::create(second, &error), &error));
    flight.cycle.stop();
    QCOMPARE(next.proceed(&error), PlantRecorder::Ended);
    QVERIFY(next.finish(&error));
    QCOMPARE(verified(first).cycles, quint64(100));
    QCOMPARE(verified(first).lastCycle, quint64(99));
    QCOMPARE(verified(second).cycles, quint64(100));
    QCOMPARE(verified(second).firstCycle, quint64(100));
    QCOMPARE(verified(second).digest, flight.digest());
}

void tst_PlantRecorder::theRingOfAKilledMasterIsRecordedToItsEnd()
{
    RecordedFlight flight;
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step(77);
    flight.ring->memory().unlock(RingMemory::WriterLock);  // as the kernel does when it ends a process
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Abandoned);
    QVERIFY(flight.recorder.finish(&flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.cycles, quint64(77));
    QCOMPARE(file.digest, flight.digest());
    QCOMPARE(file.problems, QStringList("the end of the phase is not in the file"));
}

void tst_PlantRecorder::equalFlightsMakeEqualFiles()
{
    QByteArray files[2];
    for (QByteArray &bytes : files) {
        RecordedFlight flight;
        QVERIFY(flight.begin());
        QVERIFY(flight.start());
        flight.step(300);
        flight.cycle.stop();
        QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
        QVERIFY(flight.recorder.finish(&flight.error));
        QFile file(flight.file);
        QVERIFY(file.open(QIODevice::ReadOnly));
        bytes = file.readAll();
    }
    QCOMPARE(files[0], files[1]);
}

/// Writes what \a flight has recorded into another file, as \a change wants it.
static QString forged(const RecordedFlight &flight,
                      const std::function<bool(QByteArray *message, quint64 number)> &change)
{
    using namespace mcap;
    struct Copier final : ScanHandler
    {
        Writer writer;
        QString error;
        std::function<bool(QByteArray *, quint64)> change;
        QMap<std::uint16_t, std::uint16_t> ids;
        quint64 number = 0;
        explicit Copier(const QString &file)
            : writer(FileSink::create(file, &error))
        {
            writer.begin("forged", &error);
        }
        void attachment(const Attachment &from, const NamedEntry & /*entry*/) override
        {
            writer.addAttachment(from.name, from.mediaType, from.data, from.time, &error);
        }
        void chunk(const ChunkEntry & /*entry*/, const QByteArray &records) override
        {
            QMap<std::uint16_t, QByteArray> topics;
            forEachMessage(
                records,
                [&](const Channel &channel) {
                    topics[channel.id] = channel.topic;
                    if (!ids.contains(channel.id))
                        ids[channel.id] = writer.addChannel(channel.topic, channel.encoding);
                },
                [&](const Message &message, std::uint64_t) {
                    QByteArray bytes(message.bytes, int(message.size));
                    if (topics[message.channel] != "/plant" || change(&bytes, number++))
                        writer.addMessage(ids[message.channel], message.sequence, message.time, message.published,
                                          bytes.constData(), std::size_t(bytes.size()));
                });
            writer.flush(&error);
        }
    };
    const QString name = flight.folder.filePath("forged.mcap");
    Copier copier(name);
    copier.change = change;
    Reader reader;
    QString error;
    reader.open(flight.file, &error);
    reader.scan(copier);
    copier.writer.finish(&error);
    return name;
}

static void fly(RecordedFlight *flight)
{
    QVERIFY(flight->begin());
    QVERIFY(flight->start());
    flight->step(100);
    flight->cycle.stop();
    QCOMPARE(flight->recorder.proceed(&flight->error), PlantRecorder::Ended);
    QVERIFY(flight->recorder.finish(&flight->error));
}

void tst_PlantRecorder::aChangedImageIsFound()
{
    RecordedFlight flight;
    fly(&flight);
    QVERIFY(verified(forged(flight, [](QByteArray *, quint64) { return true; })).isComplete());
    QFile::remove(flight.folder.filePath("forged.mcap"));
    const VerifiedFile file = verified(forged(flight, [](QByteArray *message, quint64 number) {
        if (number == 50)
            (*message)[int(PlantMessage::CycleSize) + 12] = char(message->at(int(PlantMessage::CycleSize) + 12) ^ 1);
        return true;
    }));
    QCOMPARE(file.problems.size(), 1);
    QVERIFY2(file.problems[0].startsWith("the digest of the cycles before 100 is"), qPrintable(file.problems[0]));
}

void tst_PlantRecorder::aMissingCycleIsFound()
{
    RecordedFlight flight;
    fly(&flight);
    const VerifiedFile file = verified(forged(flight, [](QByteArray *, quint64 number) { return number != 50; }));
    QCOMPARE(file.problems, QStringList("cycle 51 follows cycle 49"));
    QVERIFY(!file.isComplete());
}

void tst_PlantRecorder::twoRecordersOfOneRingAreRefused()
{
    RecordedFlight flight;
    PlantRecorder second;
    QString error;
    QVERIFY(!second.attach(flight.ringFile, &error));
    QVERIFY2(error.contains("another recorder"), qPrintable(error));
}

QTEST_GUILESS_MAIN(tst_PlantRecorder)
#include "tst_PlantRecorder.moc"
