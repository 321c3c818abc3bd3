// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RecordedFlight.h"
#include "recording/Recording.h"
#include "recording/Recovery.h"

#include <QtCore/QDateTime>
#include <QtTest/QtTest>

using namespace qplc;

namespace {

constexpr RecordedTime Period = 10'000'000;

Recording opened(const QStringList &files)
{
    Recording recording;
    QString error;
    if (!recording.open(files, &error))
        qFatal("%s", qPrintable(error));
    return recording;
}

QByteArray contentOf(const QString &file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? opened.readAll() : QByteArray();
}

void write(const QString &file, const QByteArray &content)
{
    QFile opened(file);
    QVERIFY(opened.open(QIODevice::WriteOnly) && opened.write(content) == content.size());
}

std::vector<overview::Bucket> byRows(Recording &recording, int signal, int count)
{
    std::vector<overview::Bucket> result(static_cast<std::size_t>(count));
    const double width = double(recording.end() + Period - recording.begin()) / count;
    RecordedRows rows(recording, {signal}, recording.begin(), recording.end());
    while (rows.next()) {
        overview::Bucket bucket{rows.number(0), rows.number(0), overview::flagOf(rows.quality(0))};
        result[std::size_t(double(rows.time() - recording.begin()) / width)].add(bucket);
    }
    return result;
}

std::vector<overview::Bucket> byOverview(Recording &recording, int signal, int count)
{
    return recording.overview(signal, 0, recording.begin(), recording.end() + Period, count);
}

bool areSame(const std::vector<overview::Bucket> &a, const std::vector<overview::Bucket> &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto &one, const auto &other) {
        return one.flags == other.flags && one.minimum == other.minimum && one.maximum == other.maximum;
    });
}

}  // namespace

class tst_Recording : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void rowsHaveTheValuesOfTheFlight();
    void aRangeReadsItsChunksOnly();
    void signalsBehindATextAreFound();
    void unfinishedFilesAreRead();
    void filesOfAFolderAreOneRecording();
    void cyclesOfTwoFilesAreReadOnce();
    void aPieceOfAnotherFileHidesNothing();
    void twoSimulationsAreRefused();
    void whatIsNoRecordingIsRefused();
    void anOddFileOfAFolderIsLeftOut();
    void timesOfAPhaseInRealTimeAreThoseOfTheClock();
    void aDamagedChunkIsLeftOutAndCounted();
    void theOverviewHasTheExtremesOfTheRows();
    void aDetailIsReadFromTheRows();
    void filesWithoutAnOverviewGetOne();
    void recoveredFilesHaveAnOverview();
    void aDamagedOverviewShowsNoWrongValue();
    void theOverviewIsBounded();
    void theOverviewHasEachKindOfValueAndQuality_data();
    void theOverviewHasEachKindOfValueAndQuality();
};

void tst_Recording::rowsHaveTheValuesOfTheFlight()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(250)});
    QCOMPARE(recording.begin(), RecordedTime(0));
    QCOMPARE(recording.end(), 249 * Period);
    QVERIFY(!recording.isTimed());
    RecordedRows rows(recording, {recording.indexOf("position.x"), recording.indexOf("position_x")}, 0,
                      recording.end());
    int number = 0;
    for (; rows.next(); ++number) {
        QCOMPARE(rows.cycle().number, std::uint64_t(number));
        QCOMPARE(rows.time(), number * Period);
        QCOMPARE(rows.number(0), std::sin(0.1 * number));
        QCOMPARE(rows.number(1), double(number));
        QVERIFY(rows.quality(0).isGood());
    }
    QCOMPARE(number, 250);
    QCOMPARE(recording.indexOf("nothing"), -1);
}

void tst_Recording::aRangeReadsItsChunksOnly()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(1000)});
    RecordedRows rows(recording, {1}, 540 * Period, 559 * Period);
    int count = 0;
    while (rows.next())
        ++count;
    QCOMPARE(count, 20);
    QCOMPARE(rows.chunks(), 1);
    RecordedRows none(recording, {1}, 5000 * Period, 6000 * Period);
    QVERIFY(!none.next());
    QCOMPARE(none.chunks(), 0);
}

void tst_Recording::signalsBehindATextAreFound()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(20)});
    RecordedRows rows(recording, {recording.indexOf("phase"), recording.indexOf("on")}, 0, recording.end());
    for (int i = 0; rows.next(); ++i) {
        QCOMPARE(QByteArray(rows.value(0), int(rows.size(0))), QByteArray(i % 7, 'a'));
        QCOMPARE(rows.number(1), 0.0);
    }
}

void tst_Recording::unfinishedFilesAreRead()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(300, false)});
    QVERIFY(!recording.files().front().isFinished);
    QCOMPARE(recording.end(), 299 * Period);
    RecordedRows rows(recording, {1}, 100 * Period, 199 * Period);
    int count = 0;
    while (rows.next())
        ++count;
    QCOMPARE(count, 100);
}

void tst_Recording::filesOfAFolderAreOneRecording()
{
    RecordedFlight flight;
    QVERIFY(flight.begin("b.mcap") && flight.start());
    flight.step(100);
    flight.recorder.proceed(&flight.error);
    QVERIFY(flight.recorder.finish(&flight.error));
    QVERIFY(flight.begin("a.mcap"));
    flight.step(100);
    flight.recorder.proceed(&flight.error);
    QVERIFY(flight.recorder.finish(&flight.error));
    Recording recording = opened({flight.folder.path()});
    QCOMPARE(recording.files().size(), std::size_t(2));
    QVERIFY(recording.files().front().name.endsWith("b.mcap"));
    RecordedRows rows(recording, {3}, 50 * Period, 149 * Period);
    int number = 50;
    for (; rows.next(); ++number)
        QCOMPARE(rows.number(0), double(number));
    QCOMPARE(number, 150);
}

void tst_Recording::cyclesOfTwoFilesAreReadOnce()
{
    RecordedFlight flight;
    const QString file = flight.record(200);
    const QString copy = flight.folder.filePath("copy.mcap");
    QVERIFY(QFile::copy(file, copy));
    Recording recording = opened({flight.folder.path()});
    RecordedRows rows(recording, {3}, 0, recording.end());
    int number = 0;
    for (; rows.next(); ++number)
        QCOMPARE(rows.number(0), double(number));
    QCOMPARE(number, 200);
}

/// As the cycles around a mark, which were kept before the recorder came.
void tst_Recording::aPieceOfAnotherFileHidesNothing()
{
    RecordedFlight flight;
    QVERIFY(flight.begin() && flight.start());
    flight.step(100);
    flight.recorder.proceed(&flight.error);
    flight.recorder.save(false, &flight.error);
    QVERIFY(QFile::copy(flight.file, flight.folder.filePath("piece.mcap")));
    flight.step(200);
    flight.cycle.stop();
    flight.recorder.proceed(&flight.error);
    QVERIFY(flight.recorder.finish(&flight.error));
    Recording recording = opened({flight.folder.path()});
    QCOMPARE(recording.files().size(), std::size_t(2));
    QCOMPARE(recording.end(), 299 * Period);
    RecordedRows rows(recording, {3}, 0, recording.end());
    int number = 0;
    for (; rows.next(); ++number)
        QCOMPARE(rows.number(0), double(number));
    QCOMPARE(number, 300);
}

void tst_Recording::twoSimulationsAreRefused()
{
    RecordedFlight first;
    RecordedFlight second;
    second.description.phase = 2;
    second.ring = std::make_shared<RecordRing>();
    QFile::remove(QFile::decodeName(second.ringFile));
    QVERIFY(second.ring->create(second.ringFile, 1 << 20, second.description.toText(), &second.error));
    second.recorder.detach();
    QVERIFY(second.recorder.attach(second.ringFile, &second.error));
    second.phase.ring = second.ring;
    Recording recording;
    QString error;
    QVERIFY(!recording.open({first.record(10), second.record(10)}, &error));
    QVERIFY2(error.contains("different flights at the same time"), qPrintable(error));
}

void tst_Recording::whatIsNoRecordingIsRefused()
{
    QTemporaryDir folder;
    Recording recording;
    QString error;
    QVERIFY(!recording.open({folder.path()}, &error));
    QVERIFY2(error.contains("no file there ends with .mcap"), qPrintable(error));
    QVERIFY(!recording.open({folder.filePath("nothing.mcap")}, &error));
    QVERIFY2(error.contains("cannot open"), qPrintable(error));
    write(folder.filePath("text.mcap"), "not a recording");
    QVERIFY(!recording.open({folder.path()}, &error));
    QVERIFY2(error.contains("not a recording"), qPrintable(error));
}

void tst_Recording::anOddFileOfAFolderIsLeftOut()
{
    RecordedFlight flight;
    flight.record(10);
    const QString odd = flight.folder.filePath("odd.mcap");
    write(odd, "not a recording");
    Recording recording = opened({flight.folder.path()});
    QCOMPARE(recording.files().size(), std::size_t(1));
    QCOMPARE(recording.unreadable(), 1);
    QCOMPARE(recording.notes().size(), 1);
    QVERIFY2(recording.notes()[0].contains("odd.mcap' is not a recording"), qPrintable(recording.notes()[0]));
    QString error;
    QVERIFY(!recording.open({flight.file, odd}, &error));  // it was named
    QVERIFY2(error.contains("odd.mcap' is not a recording"), qPrintable(error));
    QVERIFY2(recording.open({flight.file, odd}, &error, Recording::LeaveOut), qPrintable(error));
}

/// The recorder is there before the phase begins.
void tst_Recording::timesOfAPhaseInRealTimeAreThoseOfTheClock()
{
    RecordedFlight flight;
    flight.phase.clock = QPlcClock::realTime();
    const QDateTime before = QDateTime::currentDateTimeUtc();
    QVERIFY(flight.begin() && flight.start());
    QTRY_VERIFY(flight.cycle.statistics().cycles >= 3);
    flight.cycle.stop();
    flight.recorder.proceed(&flight.error);
    QVERIFY(flight.recorder.finish(&flight.error));
    Recording recording = opened({flight.file});
    QVERIFY(recording.isTimed());
    QVERIFY(recording.begin() / 1'000'000 >= before.toMSecsSinceEpoch());
    RecordedRows rows(recording, {}, recording.begin(), recording.end());
    QVERIFY(rows.next());
    const RecordedTime start = rows.time() - RecordedTime(rows.cycle().number) * Period;
    while (rows.next())
        QCOMPARE(rows.time() - start, RecordedTime(rows.cycle().number) * Period);
}

void tst_Recording::aDamagedChunkIsLeftOutAndCounted()
{
    RecordedFlight flight;
    const QString file = flight.record(300);
    QByteArray content = contentOf(file);
    const int chunk = content.indexOf("zstd", content.indexOf("zstd") + 4);
    content[chunk + 40] = char(content.at(chunk + 40) ^ 1);
    write(file, content);
    Recording recording = opened({file});
    RecordedRows rows(recording, {3}, 0, recording.end());
    std::vector<double> numbers;
    while (rows.next())
        numbers.push_back(rows.number(0));
    QCOMPARE(numbers.size(), std::size_t(200));
    QCOMPARE(numbers.at(99), 99.0);
    QCOMPARE(numbers.at(100), 200.0);
    QCOMPARE(rows.damages(), 1);
}

void tst_Recording::theOverviewHasTheExtremesOfTheRows()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(20000)});
    const int signal = recording.indexOf("position.x");
    const int whole = recording.indexOf("position_x");
    // 128 cycles in each interval, and 1024: buckets that lie within the intervals
    recording.overview(signal, 0, 0, 1, 1);
    for (const int count : {2, 3, 10, 19}) {
        const auto wanted = recording.overview(signal, 0, 0, count * 1024 * Period, count);
        std::vector<overview::Bucket> found(wanted.size());
        RecordedRows rows(recording, {signal, whole}, 0, count * 1024 * Period - 1);
        while (rows.next())
            found[rows.cycle().number / 1024].add({rows.number(0), rows.number(0), overview::flagOf(rows.quality(0))});
        QVERIFY(areSame(wanted, found));
    }
    const auto coarse = byOverview(recording, whole, 2);
    QCOMPARE(coarse.front().minimum, 0.0);
    QCOMPARE(coarse.back().maximum, 19999.0);
}

void tst_Recording::aDetailIsReadFromTheRows()
{
    RecordedFlight flight;
    Recording recording = opened({flight.record(500)});
    const int signal = recording.indexOf("position.x");
    QVERIFY(areSame(byOverview(recording, signal, 37), byRows(recording, signal, 37)));
    QVERIFY(recording.overview(recording.indexOf("phase"), 0, 0, 1000 * Period, 3).front().flags == 0);
    QVERIFY(recording.overview(signal, 0, 10, 10, 5).front().flags == 0);
    QVERIFY(recording.overview(signal, 0, 0, 10, 0).empty());
}

void tst_Recording::filesWithoutAnOverviewGetOne()
{
    RecordedFlight flight;
    const QString file = flight.record(5000, false);
    Recording unfinished = opened({file});
    QVERIFY(flight.recorder.finish(&flight.error));
    Recording finished = opened({file});
    const int signal = finished.indexOf("position.x");
    const auto wanted = byOverview(finished, signal, 20);
    QVERIFY(wanted.front().flags & overview::HasValue);
    QVERIFY(areSame(byOverview(unfinished, signal, 20), wanted));
}

void tst_Recording::recoveredFilesHaveAnOverview()
{
    RecordedFlight flight;
    const QString file = flight.record(5000, false);
    RecoveredFile recovered;
    QVERIFY(recoverRecording(file, &recovered, &flight.error));
    Recording recording = opened({file});
    const auto &attachments = recording.files().front().attachments;
    QCOMPARE(attachments.size(), std::size_t(3));  // description, initial values, overview
    QCOMPARE(attachments.back().name, QByteArray(overview::Name));
    overview::File overview;
    auto reader = std::make_shared<mcap::Reader>();
    QVERIFY(reader->open(file, &flight.error));
    QVERIFY(overview.open(reader, attachments.back(), ProcessImage(flight.table)));
    QCOMPARE(overview.levels().front().count, 79U);  // of 64 cycles
    std::vector<overview::Bucket> buckets;
    QVERIFY(overview.read(overview.levels().front(), overview::firstColumn(flight.table, 3), 1, 3, &buckets));
    QCOMPARE(buckets.size(), std::size_t(2));
    QCOMPARE(buckets.front().minimum, 64.0);
    QCOMPARE(buckets.back().maximum, 191.0);
}

void tst_Recording::aDamagedOverviewShowsNoWrongValue()
{
    RecordedFlight flight;
    const QString file = flight.record(2000);
    Recording whole = opened({file});
    const mcap::NamedEntry entry = whole.files().front().attachments.back();
    QCOMPARE(entry.name, QByteArray(overview::Name));
    const int signal = whole.indexOf("position.x");
    const auto wanted = byOverview(whole, signal, 5);
    const QByteArray content = contentOf(file);
    for (std::uint64_t at = entry.offset + 60; at < entry.offset + entry.length; at += 97) {
        QByteArray damaged = content;
        damaged[int(at)] = char(damaged.at(int(at)) ^ 8);
        write(file, damaged);
        Recording recording = opened({file});
        const auto found = byOverview(recording, signal, 5);
        for (std::size_t i = 0; i < found.size(); ++i) {  // of buckets, or of rows
            QVERIFY(std::abs(found[i].maximum - wanted[i].maximum) < 1e-2);
            QCOMPARE(found[i].flags, wanted[i].flags);
        }
    }
}

void tst_Recording::theOverviewIsBounded()
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni("[x]\ntype = Int32\n");
    ProcessImage image(table);
    overview::Builder builder(image, 900);
    for (int i = 0; i < 100000; ++i) {
        image.setValue(0, QPlcValue(qint32(i)));
        image.setQuality(0, QPlcQuality::Good);
        builder.add(quint64(i), 0, image.data());
    }
    builder.add(10'000'000'000, 0, image.data());  // after a long pause
    const QByteArray bytes = builder.bytes();
    QVERIFY2(bytes.size() < 1200, qPrintable(QString::number(bytes.size())));
    overview::File file;
    QVERIFY(file.open(bytes, image));
    std::vector<overview::Bucket> buckets;
    QVERIFY(file.read(file.levels().front(), 0, 0, ~quint64(0), &buckets));
    QCOMPARE(buckets.front().minimum, 0.0);
    QCOMPARE(buckets.front().maximum, 99999.0);
    QCOMPARE(buckets.back().maximum, 99999.0);
    QCOMPARE(int(buckets.at(1).flags), 0);
}

/// Values of all types side by side, some of them at the ends of their type, or no numbers.
void tst_Recording::theOverviewHasEachKindOfValueAndQuality_data()
{
    QTest::addColumn<int>("kinds");  // of qualities: 0: all are good
    QTest::newRow("good") << 0;
    QTest::newRow("all") << 1;
}

void tst_Recording::theOverviewHasEachKindOfValueAndQuality()
{
    QFETCH(int, kinds);
    const QPlcSignalTable table = QPlcSignalTable::fromIni(
        "[a]\ntype = Real32[37]\n[b]\ntype = UInt8\n[c]\ntype = Int16[5]\n[text]\ntype = String(3)\n"
        "[d]\ntype = Real64\n[e]\ntype = Real64[20]\n[f]\ntype = UInt64\n[g]\ntype = Int8[17]\n");
    ProcessImage image(table);
    const std::vector<overview::Column> columns = overview::columnsOf(image);
    overview::Builder builder(image);
    std::vector<std::vector<overview::Bucket>> wanted(columns.size(), std::vector<overview::Bucket>(7));
    auto bits = [state = quint64(1)]() mutable {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return quint32(state >> 33);
    };
    const float reals[] = {std::nanf(""), INFINITY, -INFINITY, 0.0F, -1.5F};
    for (quint64 cycle = 0; cycle < 64 * 7; ++cycle) {
        for (std::uint32_t at = 0; at < image.size(); ++at)
            image.data()[at] = char(bits());
        for (const overview::Column &column : columns) {
            if (column.scalar == QPlcSignalType::Real32 && bits() % 3 == 0)
                storeLittle(reals[bits() % 5], image.data() + column.offset);
        }
        for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(table.size()); ++i)
            image.data()[image.qualityOffset(i)] = char(kinds == 0 || bits() % 2 ? 0 : bits() % 255);
        builder.add(cycle, 0, image.data());
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double number = overview::numberAt(columns[i].scalar, image.data() + columns[i].offset);
            overview::Bucket bucket{number, number, 0};
            bucket.flags = overview::flagOf(QPlcQuality::fromByte(quint8(image.data()[columns[i].quality])));
            if (std::isnan(number))
                bucket.flags &= quint8(~overview::HasValue);
            wanted[i][std::size_t(cycle / 64)].add(bucket);
        }
    }
    overview::File file;
    QVERIFY(file.open(builder.bytes(), image));
    QVERIFY(file.open(builder.bytes(), image));  // to ask does not change it
    QCOMPARE(int(file.levels().front().length), 64);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::vector<overview::Bucket> buckets;
        QVERIFY(file.read(file.levels().front(), int(i), 0, 7, &buckets));
        QVERIFY2(areSame(buckets, wanted[i]), qPrintable(QString::number(i)));
    }
}

QTEST_GUILESS_MAIN(tst_Recording)
#include "tst_Recording.moc"
