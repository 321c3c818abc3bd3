// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "RecordedFlight.h"
#include "node/session/RemoteRecorder.h"
#include "protocol/messages/MessageTable.h"
#include "protocol/messages/Vocabulary.h"
#include "recording/RingCopy.h"
#include "recording/Verification.h"

#include <QtTest/QtTest>

#include <random>

using namespace qplc;
namespace words = qplc::messages::errorWord;

namespace {

constexpr std::int64_t Millisecond = 1'000'000;
constexpr std::int64_t Second = 1000 * Millisecond;

/// A recorder on another computer, and the network between it and the master.
struct Ground
{
    explicit Ground(const QString &file)
        : file(file)
    {
    }
    /// \return false: it cannot go on
    bool record(QString *error)
    {
        if (copy->state() == RingCopy::Ready && !plant) {
            plant = std::make_unique<PlantRecorder>();
            if (!plant->attach(copy->file(), error))
                return false;
            plant->goOnFrom(begin);
            if (!plant->begin(mcap::FileSink::create(file, error), error))
                return false;
        }
        if (!plant || isStalled || progress == PlantRecorder::Ended || progress == PlantRecorder::Abandoned)
            return true;
        progress = plant->proceed(error);
        if (progress == PlantRecorder::Ended || progress == PlantRecorder::Abandoned) {
            const bool isFinished = plant->finish(error);
            plant->detach();
            plant->removeRing();
            return isFinished;
        }
        return progress != PlantRecorder::Failed && plant->save(false, error);
    }

    QObject connection;
    QString key = "uuid of the ground";
    QString name = "'ground' at 10.0.0.2";
    QString file;
    PlantRecorder::Position begin;
    std::unique_ptr<RingCopy> copy = std::make_unique<RingCopy>("ground");
    std::unique_ptr<PlantRecorder> plant;
    PlantRecorder::Progress progress = PlantRecorder::Waiting;
    bool isStalled = false;
};

/// A flight whose recorder is on another computer. Time is what the test says.
struct RemoteFlight : RecordedFlight
{
    explicit RemoteFlight(std::size_t capacity = 1 << 20, const QByteArray &more = {})
        : RecordedFlight(capacity, 1 << 16, more)
    {
        recorder.detach();
        file = folder.filePath("ground.mcap");
        server.begin(QFile::decodeName(ringFile), now);
        ground = std::make_unique<Ground>(file);
    }
    RemoteRecorder::Asker asker() const { return {&ground->connection, ground->key, ground->name}; }
    std::optional<messages::Records> ask(const messages::GetRecords &question, const RemoteRecorder::Asker &who)
    {
        refusal = {};
        return server.answer(question, who, now, &refusal);
    }
    /// 5 ms on the way there, and 5 ms back.
    bool pass(std::int64_t duration)
    {
        for (const std::int64_t end = now + duration; now < end; now += 10 * Millisecond) {
            while (const auto question = ground->copy->question(now)) {
                if (loss(random) < lost) {
                    ground->copy->forgetQuestion();
                    break;
                }
                const auto answer = ask(*question, asker());
                if (!answer) {
                    ground->copy->forgetQuestion();
                    break;
                }
                received += answer->bytes.size();
                if (!ground->copy->take(*answer, now, &error) || !ground->record(&error))
                    return false;
                if (answer->bytes.isEmpty())
                    break;
            }
            if (!ground->record(&error))
                return false;
            server.look(now);
        }
        return true;
    }
    /// A second of 100 cycles at a time.
    bool fly(int seconds)
    {
        for (int i = 0; i < seconds; ++i) {
            step(100);
            if (!pass(Second))
                return false;
        }
        return true;
    }
    bool land(std::int64_t patience = 10 * Second)
    {
        cycle.stop();
        ring->endTexts();
        isOver = true;
        return pass(patience) && ground->copy->state() == RingCopy::Ended;
    }
    VerifiedFile verified()
    {
        VerifiedFile result;
        if (!verifyRecording(file, &result, &error))
            result.problems << error;
        return result;
    }

    std::int64_t now = 1000 * Second;
    bool isOver = false;
    RemoteRecorder server{[this] { return isOver ? QString() : QFile::decodeName(ringFile); }};
    std::unique_ptr<Ground> ground;
    Refusal refusal;
    std::mt19937 random{7};
    std::uniform_real_distribution<double> loss{0.0, 1.0};
    double lost = 0.0;
    qint64 received = 0;
};

messages::GetRecords questionAbout(messages::RingPart part, quint64 from, quint64 saved = 0)
{
    messages::GetRecords question;
    question.part = part;
    question.from = from;
    question.saved = saved;
    return question;
}

}  // namespace

// A recorder on another computer has every cycle that one here would have.
class tst_RemoteRecorder : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theFileHasTheWholeFlight();
    void theRingKeepsWhatIsNotInTheFileThere();
    void theRingIsDeletedWhenAllIsInTheFile();
    void recordsAndTablesMayBeLongerThanAnAnswer();
    void lostAnswersLoseNoCycle();
    void whoComesBackInTimeMissesNothing();
    void whoWasAwayForTooLongHasAnExactGap();
    void aRingThatIsFullMakesAnExactGap();
    void aKilledRecorderIsContinuedWithoutAGap();
    void aMasterThatIsGoneIsRecordedAsFarAsItCame();
    void whoWaitsForAPhaseGetsAllOfIt();
    void whoIsSilentIsNotWaitedFor();
    void theEndOfAPhaseIsWaitedForUntilItIsRecordedOrTheRecorderIsSilent();
    void onlyOneRecordsAndTheOtherIsToldWho();
    void aRecorderOfTheMastersComputerIsToldOf();
    void nonsenseIsRefused();
    void onlyWholeRecordsAreSaved();
    void manyQuestionsGetNoMoreThanTheLimit();
    void theMasterIsToldWhatTheRecorderDoes();
    void answersOfAnotherKindOfMasterAreRefused_data();
    void answersOfAnotherKindOfMasterAreRefused();
};

void tst_RemoteRecorder::theFileHasTheWholeFlight()
{
    RemoteFlight flight;
    QVERIFY(flight.start());
    QVERIFY2(flight.fly(10) && flight.land(), qPrintable(flight.error + flight.refusal.text));
    const VerifiedFile file = flight.verified();
    QCOMPARE(file.problems, QStringList());
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(1000));
    QCOMPARE(file.digest, flight.digest());
    QCOMPARE(file.description.plant, QString("kite"));
}

void tst_RemoteRecorder::theRingKeepsWhatIsNotInTheFileThere()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(1));
    const std::uint64_t before = flight.ring->readPlace();
    QVERIFY(before > 0);
    flight.ground->isStalled = true;
    QVERIFY(flight.fly(3));
    QCOMPARE(flight.ring->readPlace(), before);
    flight.ground->isStalled = false;
    QVERIFY(flight.pass(Second));
    QCOMPARE(flight.ring->readPlace(), flight.ring->head());
}

void tst_RemoteRecorder::theRingIsDeletedWhenAllIsInTheFile()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(1));
    const QString copy = QFile::decodeName(flight.ground->copy->file());
    QVERIFY(QFile::exists(copy));
    QVERIFY(flight.land());
    QVERIFY(!QFile::exists(copy));
    QVERIFY(!QFile::exists(QFile::decodeName(flight.ringFile)));
    QVERIFY(!flight.ring->isRead());
}

void tst_RemoteRecorder::recordsAndTablesMayBeLongerThanAnAnswer()
{
    QByteArray more;
    for (int i = 0; i < 9'000; ++i)
        more += "[more.number" + QByteArray::number(i) + "]\ntype = Real64\n";
    RemoteFlight flight(1 << 20, more);
    QVERIFY(flight.cycle.image().totalSize() > messages::GetRecords::most);
    QVERIFY(flight.description.toText().size() > int(messages::GetRecords::most));
    QVERIFY(flight.start());
    for (int i = 0; i < 4; ++i) {
        flight.step(5);
        QVERIFY2(flight.pass(2 * Second), qPrintable(flight.error));
    }
    QVERIFY(flight.land());
    const VerifiedFile file = flight.verified();
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(20));
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::lostAnswersLoseNoCycle()
{
    RemoteFlight flight;
    flight.lost = 0.5;
    QVERIFY(flight.start());
    QVERIFY2(flight.fly(20) && flight.land(30 * Second), qPrintable(flight.error));
    const VerifiedFile file = flight.verified();
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(2000));
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::whoComesBackInTimeMissesNothing()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(2));
    flight.lost = 1.0;
    QVERIFY(flight.fly(20));
    flight.lost = 0.0;
    QVERIFY(flight.fly(2) && flight.land());
    const VerifiedFile file = flight.verified();
    QVERIFY(file.isComplete());
    QCOMPARE(file.cycles, quint64(2400));
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::whoWasAwayForTooLongHasAnExactGap()
{
    RemoteFlight flight(1 << 16);
    QVERIFY(flight.start() && flight.fly(2));
    flight.lost = 1.0;
    QVERIFY(flight.pass(RemoteRecorder::Silence + Second));  // the master records on without it
    QVERIFY(!flight.ring->isRead());
    flight.step(3000);
    flight.lost = 0.0;
    QVERIFY2(flight.fly(2) && flight.land(), qPrintable(flight.error));
    const VerifiedFile file = flight.verified();
    QCOMPARE(file.gaps.size(), 1);
    QCOMPARE(file.gaps[0].first, quint64(200));
    QCOMPARE(file.cycles + file.gaps[0].last - file.gaps[0].first + 1, quint64(3400));
    QCOMPARE(file.lastCycle, quint64(3399));
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::aRingThatIsFullMakesAnExactGap()
{
    RemoteFlight flight(1 << 16);
    flight.phase.clock = QPlcClock::realTime();
    flight.phase.period = std::chrono::microseconds(100);
    QVERIFY(flight.pass(Second));
    flight.ground->isStalled = true;
    QVERIFY(flight.start());
    QTRY_VERIFY(flight.cycle.tap().missing() > 100);
    flight.cycle.stop();
    flight.ring->endTexts();
    flight.ground->isStalled = false;
    QVERIFY2(flight.pass(10 * Second), qPrintable(flight.error));
    QCOMPARE(flight.ground->progress, PlantRecorder::Ended);
    const VerifiedFile file = flight.verified();
    QCOMPARE(file.problems, QStringList());
    QCOMPARE(file.gaps.size(), 1);
    QCOMPARE(file.missing, flight.cycle.tap().missing());
    QCOMPARE(file.cycles + file.missing + file.skipped, file.gaps[0].last + 1);
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::aKilledRecorderIsContinuedWithoutAGap()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(3));
    const PlantRecorder::Position position = flight.ground->plant->position();
    QVERIFY(flight.ground->plant->finish(&flight.error));  // as the next recorder does with the file
    flight.ground.reset();
    flight.step(500);
    flight.file = flight.folder.filePath("next.mcap");
    flight.ground = std::make_unique<Ground>(flight.file);
    flight.ground->key = "another uuid";
    flight.ground->begin = position;
    QVERIFY2(flight.fly(2) && flight.land(), qPrintable(flight.error + flight.refusal.text));
    const VerifiedFile file = flight.verified();
    QCOMPARE(file.gaps.size(), 0);
    QCOMPARE(file.firstCycle, quint64(300));
    QCOMPARE(file.cycles, quint64(700));
    QCOMPARE(file.digest, flight.digest());
}

void tst_RemoteRecorder::aMasterThatIsGoneIsRecordedAsFarAsItCame()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(2));
    flight.ground->copy->abandon();
    for (int i = 0; i < 100 && flight.ground->progress != PlantRecorder::Abandoned; ++i)
        QVERIFY(flight.ground->record(&flight.error));
    QCOMPARE(flight.ground->progress, PlantRecorder::Abandoned);
    QCOMPARE(flight.verified().cycles, quint64(200));
    flight.cycle.stop();
}

/// Without it, the begin of a fast phase would be replaced before the first question.
void tst_RemoteRecorder::whoWaitsForAPhaseGetsAllOfIt()
{
    RemoteFlight flight;
    RemoteRecorder waiting([] { return QString(); });
    const auto answer = waiting.answer({}, flight.asker(), flight.now, &flight.refusal);
    QVERIFY(answer && answer->ring.isEmpty());
    QVERIFY(!flight.ring->isRead());
    waiting.begin(QFile::decodeName(flight.ringFile), flight.now + Second);
    QVERIFY(flight.ring->isRead());
    RemoteRecorder late([] { return QString(); });
    QVERIFY(late.answer({}, flight.asker(), flight.now, &flight.refusal));
    late.begin(QFile::decodeName(flight.ringFile), flight.now + RemoteRecorder::Attention);
    QVERIFY(late.answer({}, flight.asker(), flight.now, &flight.refusal) == std::nullopt);  // the first one has it
}

void tst_RemoteRecorder::whoIsSilentIsNotWaitedFor()
{
    RemoteFlight flight;
    QVERIFY(flight.ask({}, flight.asker()));
    QVERIFY(flight.ring->isRead());
    flight.server.look(flight.now + RemoteRecorder::Silence - 1);
    QVERIFY(flight.ring->memory().isLocked(RingMemory::RecorderLock));
    flight.server.look(flight.now + RemoteRecorder::Silence);
    QVERIFY(!flight.ring->memory().isLocked(RingMemory::RecorderLock));
}

void tst_RemoteRecorder::theEndOfAPhaseIsWaitedForUntilItIsRecordedOrTheRecorderIsSilent()
{
    RemoteFlight flight;
    QCOMPARE(flight.server.behind(flight.now), QString());
    QVERIFY(flight.start() && flight.fly(1));
    QCOMPARE(flight.server.behind(flight.now), flight.ground->name);
    QCOMPARE(flight.server.behind(flight.now + RemoteRecorder::Attention), QString());
    QVERIFY2(flight.land(), qPrintable(flight.error));
    QCOMPARE(flight.server.behind(flight.now), QString());
}

void tst_RemoteRecorder::onlyOneRecordsAndTheOtherIsToldWho()
{
    RemoteFlight flight;
    QVERIFY(flight.ask({}, flight.asker()));
    Ground other("other");
    const RemoteRecorder::Asker another{&other.connection, "other", "'other' at 10.0.0.3"};
    QVERIFY(!flight.ask({}, another));
    QCOMPARE(flight.refusal.error, QString(words::wrongState));
    QVERIFY2(flight.refusal.text.contains("'ground' at 10.0.0.2 records"), qPrintable(flight.refusal.text));
    QObject again;  // half of the old connection may still be there
    QVERIFY(flight.ask({}, {&again, flight.ground->key, flight.ground->name}));
    QVERIFY(!flight.ask({}, {&other.connection, QString(), "nobody"}));
    flight.now += RemoteRecorder::Silence;
    QVERIFY(flight.ask({}, another));
    {
        QObject gone;
        QVERIFY(flight.ask({}, {&gone, "other", "'other' at 10.0.0.3"}));
    }
    QVERIFY(flight.ask({}, flight.asker()));  // the connection has ended
}

void tst_RemoteRecorder::aRecorderOfTheMastersComputerIsToldOf()
{
    RemoteFlight flight;
    QVERIFY(flight.recorder.attach(flight.ringFile, &flight.error));
    QVERIFY(!flight.ask({}, flight.asker()));
    QVERIFY2(flight.refusal.text.contains("on the computer of the master"), qPrintable(flight.refusal.text));
    flight.recorder.detach();
    QVERIFY(flight.ask({}, flight.asker()));
}

void tst_RemoteRecorder::nonsenseIsRefused()
{
    using messages::RingPart;
    RemoteFlight flight;
    QVERIFY(flight.start());
    flight.step(10);
    const quint64 head = flight.ring->head();
    QVERIFY(!flight.ask(questionAbout(RingPart::Cycles, head + 8), flight.asker()));  // of the future
    QCOMPARE(flight.refusal.error, QString(words::malformedMessage));
    QVERIFY(!flight.ask(questionAbout(RingPart::Cycles, ~quint64(0)), flight.asker()));
    QVERIFY(!flight.ask(questionAbout(RingPart::Cycles, 0, head), flight.asker()));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(0));
    messages::GetRecords question;
    for (const char *ring : {"qtplc-ring-0-kite-1-2", "../../etc/shadow", "\x1b[2J"}) {
        question.ring = ring;
        QVERIFY(!flight.ask(question, flight.asker()));
        QCOMPARE(flight.refusal.error, QString(words::unknownRing));
        QVERIFY(!flight.refusal.text.contains('\x1b'));
    }
    const auto beyond = flight.ask(questionAbout(RingPart::Description, 1 << 30), flight.asker());
    QVERIFY(beyond && beyond->bytes.isEmpty());
    for (const QJsonValue &bytes : {QJsonValue(65537), QJsonValue(1e300), QJsonValue(-1), QJsonValue("7")}) {
        const QPlcMessage message(QPlcMessage::GetRecords, {{"bytes", bytes}});
        QVERIFY(!messages::readAs<messages::GetRecords>(message, &flight.error));
        QVERIFY2(flight.error.contains("'bytes'"), qPrintable(flight.error));
    }
    flight.cycle.stop();
}

/// A recorder that goes on from there finds a record.
void tst_RemoteRecorder::onlyWholeRecordsAreSaved()
{
    RemoteFlight flight;
    QVERIFY(flight.start());
    flight.step(10);
    const quint64 head = flight.ring->head();
    QVERIFY(flight.ask(questionAbout(messages::RingPart::Cycles, head, 8), flight.asker()));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(0));
    QVERIFY(flight.ask(questionAbout(messages::RingPart::Cycles, head, head), flight.asker()));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(head));
    QVERIFY(flight.ask(questionAbout(messages::RingPart::Cycles, head, 0), flight.asker()));
    QCOMPARE(flight.ring->readPlace(), std::uint64_t(head));  // never back
    flight.cycle.stop();
}

void tst_RemoteRecorder::manyQuestionsGetNoMoreThanTheLimit()
{
    RemoteFlight flight;
    QVERIFY(flight.start());
    flight.step(1000);
    const auto askMuch = [&flight] {
        qint64 sum = 0;
        for (int i = 0; i < 10'000; ++i) {
            const auto answer = flight.ask(questionAbout(messages::RingPart::Cycles, 0), flight.asker());
            sum += answer->bytes.size();
            if (quint64(answer->bytes.size()) > messages::GetRecords::most)
                return qint64(-1);
        }
        return sum;
    };
    QCOMPARE(askMuch(), qint64(RemoteRecorder::BytesAtOnce));
    flight.now += Second / 10;
    QCOMPARE(askMuch(), qint64(RemoteRecorder::BytesPerSecond / 10));
    flight.cycle.stop();
}

void tst_RemoteRecorder::theMasterIsToldWhatTheRecorderDoes()
{
    RemoteFlight flight;
    QVERIFY(flight.start() && flight.fly(1));
    flight.ground->plant->report({RecorderReport::DiskFull, 1234, 5678, "/data/ground.mcap", "the disk is full"});
    QVERIFY(flight.fly(2));
    const auto report = flight.ring->memory().header()->report.read();
    QVERIFY(report);
    QCOMPARE(report->state, RecorderReport::DiskFull);
    QCOMPARE(report->bytesPerSecond, std::uint64_t(1234));
    QCOMPARE(report->freeBytes, std::uint64_t(5678));
    QCOMPARE(report->file, QString("ground:/data/ground.mcap"));
    QCOMPARE(report->error, QString("the disk is full"));
    flight.cycle.stop();
}

void tst_RemoteRecorder::answersOfAnotherKindOfMasterAreRefused_data()
{
    QTest::addColumn<int>("step");  // of the answers
    QTest::addColumn<int>("fault");
    QTest::newRow("a name that is a path") << 0 << 0;
    QTest::newRow("a description without an end") << 0 << 1;
    QTest::newRow("no capacity") << 1 << 2;
    QTest::newRow("a capacity without an end") << 1 << 3;
    QTest::newRow("another ring") << 1 << 4;
    QTest::newRow("records of the past") << 3 << 5;
    QTest::newRow("more than was asked for") << 3 << 6;
    QTest::newRow("no records") << 3 << 7;
}

/// Nobody writes beyond the copy, or where a master wants it.
void tst_RemoteRecorder::answersOfAnotherKindOfMasterAreRefused()
{
    QFETCH(int, step);
    QFETCH(int, fault);
    RemoteFlight flight;
    QVERIFY(flight.start());
    flight.step(10);
    RingCopy copy("ground");
    for (int i = 0; i <= step; ++i) {
        PlantRecorder recorder;
        if (copy.state() == RingCopy::Ready)
            QVERIFY(recorder.attach(copy.file(), &flight.error));
        const auto question = copy.question(flight.now);
        QVERIFY(question);
        auto answer = flight.ask(*question, flight.asker());
        QVERIFY(answer);
        if (i == step) {
            const QByteArray junk(int(question->bytes), 'x');
            answer->ring = fault == 0 ? "../../tmp/ring" : fault == 4 ? "another" : answer->ring;
            answer->head = fault == 1 ? ~quint64(0) : answer->head.number;
            answer->capacity = fault == 2 ? 0 : fault == 3 ? quint64(1) << 62 : answer->capacity.number;
            answer->from = fault == 5 ? answer->from - 8 : answer->from.number;
            answer->bytes = fault == 6 ? junk + 'x' : fault == 7 ? junk : answer->bytes;
        }
        QCOMPARE(copy.take(*answer, flight.now, &flight.error), i < step);
    }
    QVERIFY2(flight.error.startsWith("the master does not answer as a ring would"), qPrintable(flight.error));
    flight.cycle.stop();
}

QTEST_GUILESS_MAIN(tst_RemoteRecorder)
#include "tst_RemoteRecorder.moc"
