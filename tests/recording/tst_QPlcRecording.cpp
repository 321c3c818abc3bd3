// SPDX-License-Identifier: Apache-2.0
#include "RecordedFlight.h"

#include <QPlcRecordedRows.h>
#include <QPlcRecording.h>
#include <QtTest/QtTest>

using namespace qplc;

namespace {

constexpr qint64 Period = 10'000'000;  // [ns]

}  // namespace

// The public reader of recordings.
class tst_QPlcRecording : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aRecordingSaysWhatItIs();
    void rowsHaveAllTypesOfValues();
    void rowsOfATimeAreThoseOfTheTime();
    void columnsGoOnWhereTheyWereCut();
    void messagesAreThoseOfTheirChannel();
    void whatHasHappenedHasItsCycleAndWhoDidIt();
    void theOverviewHasTheExtremesOfTheRows();
    void whatIsNotKnownIsNamed();
    void whatIsNoRecordingIsRefused();
    void aFolderIsOneRecording();
    void anUnfinishedFileIsRead();
    void aDamagedChunkIsLeftOutAndCounted();
    void withoutARecordingAllIsEmpty();
};

void tst_QPlcRecording::aRecordingSaysWhatItIs()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY2(recording.open(flight.record(250)), qPrintable(recording.errorString()));
    QCOMPARE(recording.plant(), QString("kite"));
    QCOMPARE(qint64(recording.period().count()), Period);
    QCOMPARE(recording.begin(), qint64(0));
    QCOMPARE(recording.end(), 249 * Period);
    QVERIFY(!recording.isTimed());
    QCOMPARE(recording.signalTable().at(1).unit, QString("m"));
    QCOMPARE(recording.files().size(), 1);
    const QPlcRecording::File file = recording.files().first();
    QCOMPARE(file.name, flight.file);
    QCOMPARE(file.session, quint64(0xabcdef));
    QCOMPARE(file.phase, quint64(1));
    QVERIFY(file.isFinished && !file.isMarked);
    QCOMPARE(recording.notes(), QStringList());
}

void tst_QPlcRecording::rowsHaveAllTypesOfValues()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(250)));
    QPlcRecordedRows rows(recording, {"position.x", "phase", "position_x", "force", "time"}, 0, recording.end());
    QVERIFY2(rows.isValid(), qPrintable(rows.errorString()));
    quint64 number = 0;
    for (; rows.next(); ++number) {
        QCOMPARE(rows.cycle(), number);
        QCOMPARE(rows.time(), qint64(number) * Period);
        QCOMPARE(rows.wallTime(), rows.time());
        QCOMPARE(rows.skipped(), quint64(0));
        QCOMPARE(rows.number(0), std::sin(0.1 * double(number)));
        QVERIFY(rows.quality(0).isGood());
        QCOMPARE(rows.value(1),
                 QPlcValue(QString(int(number % 7), QLatin1Char('a'))).convertedTo(rows.value(1).type()));
        QVERIFY(std::isnan(rows.number(1)));
        QCOMPARE(rows.value(2), QPlcValue(qint16(number)));
        QCOMPARE(rows.number(3, 2), 0.0);
        QVERIFY(std::isnan(rows.number(3, 3)));
        QCOMPARE(rows.quality(3).kind(), QPlcQuality::Invalid);
        QCOMPARE(qint64(rows.number(4)), rows.time());
        QVERIFY(!rows.hasValue(5) && !rows.value(5).isValid() && std::isnan(rows.number(-1)));
    }
    QCOMPARE(number, quint64(250));
    QCOMPARE(rows.damages(), 0);
    QVERIFY(!rows.hasValue(0));
}

void tst_QPlcRecording::rowsOfATimeAreThoseOfTheTime()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(500)));
    QPlcRecordedRows rows(recording, {"position.x"}, 120 * Period - 1, 240 * Period);
    QVERIFY(rows.next());
    QCOMPARE(rows.cycle(), quint64(120));
    quint64 last = 0;
    while (rows.next())
        last = rows.cycle();
    QCOMPARE(last, quint64(240));
}

void tst_QPlcRecording::columnsGoOnWhereTheyWereCut()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(500)));
    QVector<double> numbers;
    QVector<quint64> cycles;
    qint64 begin = 0;
    for (int piece = 0; piece < 10; ++piece) {
        const QPlcRecording::Columns columns = recording.columns({"position.x", "force"}, begin, recording.end(), 70);
        if (columns.times.isEmpty())
            break;
        QVERIFY(columns.times.size() <= 70);
        QCOMPARE(columns.columns.size(), 2);
        QCOMPARE(columns.columns[1].size, 3);
        QCOMPARE(columns.columns[1].numbers.size(), 3 * columns.times.size());
        QCOMPARE(columns.columns[1].qualities.first(), QPlcQuality(QPlcQuality::Invalid).toByte());
        numbers += columns.columns[0].numbers;
        cycles += columns.cycles;
        begin = columns.times.last() + 1;
    }
    QCOMPARE(numbers.size(), 500);
    for (int i = 0; i < 500; ++i) {
        QCOMPARE(numbers[i], std::sin(0.1 * i));
        QCOMPARE(cycles[i], quint64(i));
    }
}

void tst_QPlcRecording::messagesAreThoseOfTheirChannel()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(300)));
    const QVector<QPlcRecording::Message> digests = recording.messages("/digest", 0, recording.end());
    QVERIFY(digests.size() >= 3);
    for (const QPlcRecording::Message &message : digests)
        QVERIFY2(message.content.contains("\"digest\""), message.content.constData());
    QCOMPARE(recording.messages("/digest", 0, recording.end(), 2).size(), 2);
    QVERIFY(recording.messages("/gaps", 0, recording.end()).isEmpty());
    QVERIFY(recording.messages("/nowhere", 0, recording.end()).isEmpty());
}

void tst_QPlcRecording::whatHasHappenedHasItsCycleAndWhoDidIt()
{
    RecordedFlight flight(1 << 20, 1 << 16);
    const auto tell = [&flight](RecordedText::Topic topic, quint64 cycle, const QByteArray &text) {
        RecordedText head;
        head.topic = topic;
        head.cycle = cycle;
        head.wallTime = 1'700'000'000'123'000'000;
        flight.ring->addText(head, text);
    };
    QVERIFY2(flight.begin(), qPrintable(flight.error));
    tell(RecordedText::Event, RecordedText::BeforePhase, R"({"severity":"info","kind":"state","text":"armed"})");
    QVERIFY(flight.start());
    flight.step(10);
    tell(RecordedText::Event, 9,
         R"({"severity":"warning","kind":"node","source":"Winch","text":"late","alarm":"node Winch","active":true})");
    tell(RecordedText::Event, 9, R"({"kind":"note","source":"anna","address":"10.0.0.7:4711","text":"gust"})");
    tell(RecordedText::Command, 9,
         R"({"by":"anna","role":"Operator","client":"7","signal":"on","from":"0","to":"1","how":"set","count":3})");
    tell(RecordedText::Command, 9, R"({"by":"bert","command":"Stop"})");
    tell(RecordedText::Lease, 9,
         R"({"what":"lost","by":"anna","signals":["on","force"],"from":["bert"],"reason":"gone"})");
    flight.step(10);
    flight.cycle.stop();
    flight.ring->endTexts();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY2(flight.recorder.finish(&flight.error), qPrintable(flight.error));

    QPlcRecording recording;
    QVERIFY2(recording.open(flight.file), qPrintable(recording.errorString()));
    const QVector<QPlcRecording::Event> events = recording.events(0, recording.end());
    QCOMPARE(events.size(), 3);
    QVERIFY(events[0].isBefore && events[0].kind == "state" && events[0].text == "armed" && events[0].alarm.isEmpty());
    QVERIFY(events[1].severity == "warning" && events[1].by == "Winch" && events[1].isActive);
    QCOMPARE(events[1].alarm, QString("node Winch"));
    QCOMPARE(events[2].cycle, quint64(9));
    QCOMPARE(events[2].time, 9 * Period);
    QVERIFY(events[2].kind == "note" && events[2].text == "gust" && events[2].address == "10.0.0.7:4711");
    QCOMPARE(recording.events(0, recording.end(), 1).size(), 1);
    QCOMPARE(recording.events(8 * Period, recording.end()).size(), 2);
    QCOMPARE(recording.events(10 * Period, recording.end()).size(), 0);
    const QVector<QPlcRecording::Command> commands = recording.commands(0, recording.end());
    QCOMPARE(commands.size(), 2);
    QVERIFY(commands[0].by == "anna" && commands[0].role == "Operator" && commands[0].client == "7");
    QVERIFY(commands[0].signalName == "on" && commands[0].from == "0" && commands[0].to == "1");
    QVERIFY(commands[0].how == "set" && commands[0].count == 3 && commands[0].isAdopted);
    QVERIFY(commands[1].command == "Stop" && commands[1].signalName.isEmpty() && commands[1].count == 1);
    const QVector<QPlcRecording::Lease> leases = recording.leases(0, recording.end());
    QCOMPARE(leases.size(), 1);
    QCOMPARE(leases[0].signalNames, (QStringList{"on", "force"}));
    QVERIFY(leases[0].what == "lost" && leases[0].from == QStringList("bert") && leases[0].reason == "gone");
    QCOMPARE(recording.damages(), 0);
}

void tst_QPlcRecording::theOverviewHasTheExtremesOfTheRows()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(512)));
    const QVector<QPlcRecording::Extremes> extremes
        = recording.overview("position.x", 0, 0, recording.end() + Period, 4);
    QCOMPARE(extremes.size(), 4);
    for (int i = 0; i < 4; ++i) {
        double minimum = 2.0;
        double maximum = -2.0;
        for (int cycle = 128 * i; cycle < 128 * (i + 1); ++cycle) {
            minimum = std::min(minimum, std::sin(0.1 * cycle));
            maximum = std::max(maximum, std::sin(0.1 * cycle));
        }
        QVERIFY(extremes[i].hasValue && extremes[i].isGood);
        QCOMPARE(extremes[i].minimum, minimum);
        QCOMPARE(extremes[i].maximum, maximum);
    }
    QVERIFY(!recording.overview("force", 0, 0, recording.end(), 1).first().hasValue);
    QVERIFY(!recording.overview("force", 3, 0, recording.end(), 1).first().hasValue);
    QVERIFY(!recording.overview("phase", 0, 0, recording.end(), 1).first().hasValue);
    QVERIFY(!recording.overview("nothing", 0, 0, recording.end(), 1).first().hasValue);
}

void tst_QPlcRecording::whatIsNotKnownIsNamed()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(10)));
    QPlcRecordedRows rows(recording, {"position.x", "power"}, 0, recording.end());
    QVERIFY(!rows.isValid() && !rows.next());
    QCOMPARE(rows.errorString(), QString("the recording has no signal 'power'"));
    QVERIFY(recording.columns({"power"}, 0, 1).columns.isEmpty());
    QCOMPARE(recording.errorString(), rows.errorString());
    QVERIFY(recording.columns({"phase"}, 0, 1).columns.isEmpty());
    QCOMPARE(recording.errorString(), QString("signal 'phase' is a text; read it with QPlcRecordedRows"));
}

void tst_QPlcRecording::whatIsNoRecordingIsRefused()
{
    QTemporaryDir folder;
    QPlcRecording recording;
    QVERIFY(!recording.open("/nowhere/flight.mcap"));
    QVERIFY2(recording.errorString().contains("/nowhere/flight.mcap"), qPrintable(recording.errorString()));
    QVERIFY(!recording.open(folder.path()));
    QVERIFY2(recording.errorString().contains("no recording"), qPrintable(recording.errorString()));
    QFile file(folder.filePath("text.mcap"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("no recording") > 0);
    file.close();
    QVERIFY(!recording.open(file.fileName()));
    QVERIFY2(recording.errorString().contains(file.fileName()), qPrintable(recording.errorString()));
    QCOMPARE(recording.end(), qint64(0));
}

void tst_QPlcRecording::aFolderIsOneRecording()
{
    QTemporaryDir folder;
    for (const char *name : {"a_marked.mcap", "b.mcap"}) {
        RecordedFlight flight;
        QVERIFY(QFile::copy(flight.record(100), folder.filePath(name)));
    }
    QPlcRecording recording;
    QVERIFY2(recording.open(folder.path()), qPrintable(recording.errorString()));
    QCOMPARE(recording.files().size(), 2);
    QVERIFY(recording.files()[0].isMarked && !recording.files()[1].isMarked);
    QCOMPARE(recording.columns({"on"}, recording.begin(), recording.end()).times.size(), 100);
}

void tst_QPlcRecording::anUnfinishedFileIsRead()
{
    RecordedFlight flight;
    QPlcRecording recording;
    QVERIFY(recording.open(flight.record(300, false)));
    QVERIFY(!recording.files().first().isFinished);
    QVERIFY(recording.columns({"on"}, recording.begin(), recording.end()).times.size() >= 200);
}

void tst_QPlcRecording::aDamagedChunkIsLeftOutAndCounted()
{
    RecordedFlight flight;
    const QString name = flight.record(500);
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadWrite));
    const QByteArray content = file.readAll();
    const int chunk = content.indexOf("zstd", content.indexOf("zstd") + 4);
    QVERIFY(chunk > 0 && file.seek(chunk + 40) && file.write("damaged") > 0);
    file.close();
    QPlcRecording recording;
    QVERIFY2(recording.open(name), qPrintable(recording.errorString()));
    const QPlcRecording::Columns columns = recording.columns({"position.x"}, recording.begin(), recording.end());
    QCOMPARE(columns.times.size(), 400);
    QCOMPARE(recording.damages(), 1);
    for (int i = 0; i < columns.times.size(); ++i)
        QCOMPARE(columns.columns[0].numbers[i], std::sin(0.1 * double(columns.cycles[i])));
}

void tst_QPlcRecording::withoutARecordingAllIsEmpty()
{
    QPlcRecording recording;
    QVERIFY(recording.files().isEmpty() && recording.signalTable().isEmpty() && recording.plant().isEmpty());
    QCOMPARE(recording.begin() + recording.end() + qint64(recording.period().count()), qint64(0));
    QVERIFY(recording.messages("/gaps", 0, 1).isEmpty());
    QCOMPARE(recording.errorString(), QString("no recording is open"));
    QVERIFY(recording.columns({}, 0, 1).times.isEmpty());
    QCOMPARE(recording.overview("power", 0, 0, 1, 3).size(), 3);
    QPlcRecording other = std::move(recording);
    QVERIFY(!other.isTimed());
}

QTEST_GUILESS_MAIN(tst_QPlcRecording)
#include "tst_QPlcRecording.moc"
