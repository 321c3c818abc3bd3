// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RecordedFlight.h"
#include "recording/Happenings.h"
#include "recording/McapReader.h"
#include "recording/Verification.h"

#include <QtCore/QJsonDocument>
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

/// What a file tells beside its cycles.
std::vector<Happening> happeningsOf(const QString &file)
{
    std::vector<Happening> result;
    Recording recording;
    QString error;
    if (!recording.open({file}, &error))
        qFatal("%s", qPrintable(error));
    HappeningReader reader(recording, ~0);
    for (Happening happening; reader.next(&happening);)
        result.push_back(happening);
    return result;
}

RecordedText textOf(RecordedText::Topic topic, quint64 cycle, quint64 settings = 0)
{
    RecordedText text;
    text.topic = topic;
    text.cycle = cycle;
    text.settings = settings;
    text.wallTime = 1'700'000'000'123'000'000;
    return text;
}

constexpr std::size_t TextCapacity = 1 << 16;

}  // namespace

// From the ring of a master into a file.
class tst_PlantRecorder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theFileHasTheWholeFlight();
    void aTableLargerThanAChunkIsRecorded();
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
    void whatHasHappenedIsInTheFile();
    void aValueHasTheCycleThatHasAdoptedIt();
    void textsThatAreMissingAreTold();
    void theLastTextIsWaitedForButNotForEver();
    void whatTheMasterHasToldBeforeItWasKilledIsInTheFile();
    void anotherFileGoesOnWithTheNextText();
    void theInitialValuesAreAnAttachment();
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

/// Its schema alone fills a chunk.
void tst_PlantRecorder::aTableLargerThanAChunkIsRecorded()
{
    QByteArray more;
    for (int i = 0; i < 20'000; ++i)
        more += "[more.number" + QByteArray::number(i) + "]\ntype = UInt8\n";
    RecordedFlight flight(1 << 20, 0, more);
    QVERIFY2(flight.begin() && flight.start(), qPrintable(flight.error));
    flight.step(10);
    flight.cycle.stop();
    PlantRecorder::Progress progress = PlantRecorder::Recorded;
    for (int i = 0; i < 20 && progress == PlantRecorder::Recorded; ++i)
        progress = flight.recorder.proceed(&flight.error);
    QCOMPARE(progress, PlantRecorder::Ended);
    QVERIFY2(flight.recorder.finish(&flight.error), qPrintable(flight.error));
    const VerifiedFile file = verified(flight.file);
    QCOMPARE(file.problems, QStringList());
    QCOMPARE(file.cycles, quint64(10));
    QCOMPARE(file.digest, flight.digest());
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
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(flight.ring->memory().header()->cycles.head));
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
    QVERIFY(!flight.recorder.save(false, &flight.error));  // its first attachment
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(0));
    isFull = false;
    QVERIFY(flight.recorder.save(false, &flight.error));
    const std::uint64_t saved = flight.ring->readPlace();
    isFull = true;
    flight.step(500);
    flight.recorder.proceed(&flight.error);
    QVERIFY(!flight.recorder.save(false, &flight.error));  // a chunk
    QCOMPARE(flight.error, QString("the disk is full"));
    QCOMPARE(flight.ring->readPlace(), saved);
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

void tst_PlantRecorder::whatHasHappenedIsInTheFile()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY2(flight.begin(), qPrintable(flight.error));
    flight.ring->addText(textOf(RecordedText::Event, RecordedText::BeforePhase), R"({"text":"armed"})");
    QVERIFY(flight.start());
    flight.step(10);
    flight.ring->addText(textOf(RecordedText::Lease, 9), R"({"what":"taken","by":"Anna","signals":["on"]})");
    flight.ring->addText(textOf(RecordedText::Statistics, 9), R"({"cycles":10})");
    flight.ring->addText(textOf(RecordedText::Event, 9), "no JSON");
    flight.ring->addText(textOf(RecordedText::Topic(77), 9), R"({"text":"of a later version"})");
    flight.step(10);
    flight.cycle.stop();
    flight.ring->addText(textOf(RecordedText::Event, 19), R"({"text":"stopped"})");
    flight.ring->endTexts();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY2(flight.recorder.finish(&flight.error), qPrintable(flight.error));
    QVERIFY(verified(flight.file).isComplete());

    const std::vector<Happening> told = happeningsOf(flight.file);
    QCOMPARE(told.size(), std::size_t(4));
    QCOMPARE(told[0].text,
             QJsonObject({{"text", "armed"}, {"cycle", 0}, {"before", true}, {"utc", "2023-11-14T22:13:20.123Z"}}));
    QVERIFY(told[1].topic == Happening::Lease && told[1].isAbout("on") && !told[1].isAbout("force"));
    QCOMPARE(told[1].cycle(), quint64(9));
    QCOMPARE(told[1].time, RecordedTime(9) * 10'000'000);
    QCOMPARE(told[1].sentence(), QString("'Anna' has taken the lease of on"));
    QVERIFY(told[2].topic == Happening::Statistics);
    QCOMPARE(told[3].sentence(), QString("stopped"));
    QCOMPARE(told[3].cycle(), quint64(19));
}

void tst_PlantRecorder::aValueHasTheCycleThatHasAdoptedIt()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step(5);
    const QByteArray command = R"({"by":"Anna","signal":"on","from":"0","to":"1","how":"set"})";
    // Told before the cycle has it: it waits, also for a recorder that is fast.
    flight.ring->addText(textOf(RecordedText::Command, 4, flight.cycle.settingsGiven() + 1), command);
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    flight.step(3);
    // Told late: several values together, of which the last one was adopted by the cycle 6.
    flight.ring->addText(textOf(RecordedText::Command, 7, flight.cycle.settingsGiven() - 3), command);
    flight.step(2);
    flight.cycle.setValues({{5, QPlcValue(quint8(1)), QPlcQuality::Good}});
    flight.ring->addText(textOf(RecordedText::Command, 9, flight.cycle.settingsGiven()), command);
    flight.cycle.stop();
    flight.ring->endTexts();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));

    const std::vector<Happening> told = happeningsOf(flight.file);
    QCOMPARE(told.size(), std::size_t(3));
    QCOMPARE(told[0].cycle(), quint64(5));
    QCOMPARE(told[0].time, RecordedTime(5) * 10'000'000);
    QCOMPARE(told[0].sentence(), QString("'Anna' has set on: 0 -> 1"));
    QCOMPARE(told[1].cycle(), quint64(6));
    QVERIFY(told[1].time >= told[0].time);
    QCOMPARE(told[2].text.value("adopted"), QJsonValue(false));
    QCOMPARE(told[2].sentence(), QString("'Anna' has set on: 0 -> 1; no cycle has adopted it"));
}

void tst_PlantRecorder::textsThatAreMissingAreTold()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step();
    flight.ring->addText(textOf(RecordedText::Event, 0), R"({"text":"first"})");
    flight.ring->leaveOutText();
    flight.ring->leaveOutText();
    flight.ring->addText(textOf(RecordedText::Event, 0), R"({"text":"last"})");
    flight.ring->leaveOutText();
    flight.cycle.stop();
    flight.ring->endTexts();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    const std::vector<Happening> told = happeningsOf(flight.file);
    QCOMPARE(told.size(), std::size_t(4));
    QCOMPARE(told[1].text.value("lost"), QJsonValue(2));
    QVERIFY2(told[1].sentence().startsWith("2 events, commands or"), qPrintable(told[1].sentence()));
    QCOMPARE(told[2].sentence(), QString("last"));
    QCOMPARE(told[3].text.value("lost"), QJsonValue(1));
}

void tst_PlantRecorder::theLastTextIsWaitedForButNotForEver()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step(3);
    flight.cycle.stop();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Waiting);
    int looks = 1;
    while (flight.recorder.proceed(&flight.error) == PlantRecorder::Waiting)
        ++looks;
    QVERIFY(looks > 5 && looks < 100);
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
}

void tst_PlantRecorder::whatTheMasterHasToldBeforeItWasKilledIsInTheFile()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY(flight.begin());
    QVERIFY(flight.start());
    flight.step(3);
    flight.ring->addText(textOf(RecordedText::Event, 2), R"({"text":"it burns"})");
    flight.ring->addText(textOf(RecordedText::Command, 2, flight.cycle.settingsGiven() + 1),
                         R"({"by":"Anna","signal":"on","from":"0","to":"1"})");
    flight.ring->memory().unlock(RingMemory::WriterLock);  // as the kernel does
    PlantRecorder::Progress progress = PlantRecorder::Recorded;
    while (progress == PlantRecorder::Recorded)
        progress = flight.recorder.proceed(&flight.error);
    QCOMPARE(progress, PlantRecorder::Abandoned);
    QVERIFY(flight.recorder.finish(&flight.error));
    const std::vector<Happening> told = happeningsOf(flight.file);
    QCOMPARE(told.size(), std::size_t(2));
    QCOMPARE(told[0].sentence(), QString("it burns"));
    QCOMPARE(told[1].text.value("adopted"), QJsonValue(false));
    flight.cycle.stop();
}

void tst_PlantRecorder::anotherFileGoesOnWithTheNextText()
{
    RecordedFlight flight(1 << 20, TextCapacity);
    QVERIFY(flight.begin("first.mcap"));
    const QString first = flight.file;
    QVERIFY(flight.start());
    flight.step(3);
    flight.ring->addText(textOf(RecordedText::Event, 2), R"({"text":"first"})");
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Recorded);
    QVERIFY(flight.recorder.finish(&flight.error));
    QVERIFY(flight.begin("second.mcap"));
    flight.step(3);
    flight.ring->addText(textOf(RecordedText::Event, 5), R"({"text":"second"})");
    flight.cycle.stop();
    flight.ring->endTexts();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    QCOMPARE(happeningsOf(first).size(), std::size_t(1));
    const std::vector<Happening> told = happeningsOf(flight.file);
    QCOMPARE(told.size(), std::size_t(1));
    QCOMPARE(told[0].sentence(), QString("second"));
}

void tst_PlantRecorder::theInitialValuesAreAnAttachment()
{
    RecordedFlight flight;
    QVERIFY(flight.begin());
    flight.cycle.setValues({{2, QPlcValue::fromString(flight.table.at(2).type, "1, 2, 3"), QPlcQuality::Good}});
    QVERIFY(flight.start());
    flight.step(3);
    flight.cycle.stop();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    Recording recording;
    QVERIFY2(recording.open({flight.file}, &flight.error), qPrintable(flight.error));
    mcap::Reader reader;
    QVERIFY(reader.open(flight.file, &flight.error));
    int found = 0;
    for (const mcap::NamedEntry &entry : recording.files()[0].attachments) {
        mcap::Attachment attachment;
        QVERIFY(reader.readAttachment(entry, &attachment));
        if (attachment.name != "initial_values.json")
            continue;
        ++found;
        const QJsonObject values = QJsonDocument::fromJson(attachment.data).object();
        QCOMPARE(values.size(), 6);
        QCOMPARE(values.value("force").toString(), QString("1, 2, 3"));
        QCOMPARE(values.value("phase").toString(), QString());
    }
    QCOMPARE(found, 1);
    QVERIFY(verified(flight.file).isComplete());
}

QTEST_GUILESS_MAIN(tst_PlantRecorder)
#include "tst_PlantRecorder.moc"
