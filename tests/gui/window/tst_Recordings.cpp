// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "RecordedFlight.h"
#include "WindowFixtures.h"
#include "gui/plant/PastValue.h"
#include "gui/plant/PlantRecording.h"

#include <QtCore/QMimeData>
#include <QtCore/QUrl>
#include <QtGui/QDropEvent>
#include <QtWidgets/QMenu>

#include <algorithm>

using namespace qplc;

namespace {

constexpr int cycles = 1000;  // of a flight, 10 ms each
constexpr Playback::Time period = 10'000'000;

constexpr int happened = 300;  // cycle in which the winch is hot

RecordedText hotWinch()
{
    RecordedText text;
    text.cycle = happened;
    text.wallTime = 1;
    return text;
}

/// A file with a flight: the signal position_x has the number of the cycle. In the cycle `happened`
/// the winch is hot.
struct FlightFile : RecordedFlight
{
    explicit FlightFile(int count = cycles)
        : RecordedFlight(1 << 20, 1 << 16)
    {
        if (!begin() || !start())
            qFatal("%s", qPrintable(error));
        for (int done = 0; done < count; done += 100) {
            step(100);
            if (done == happened)
                ring->addText(hotWinch(), R"({"severity":"error","kind":"fault","text":"the winch is hot"})");
            recorder.proceed(&error);
        }
        cycle.stop();
        ring->endTexts();
        if (recorder.proceed(&error) != PlantRecorder::Ended || !recorder.finish(&error))
            qFatal("%s", qPrintable(error));
    }
};

/// A window that has read a recording.
struct RecordingWindow : WindowFixture
{
    RecordingWindow()
    {
        QString error;
        name = window.openRecording({flight.file}, &error);
        if (name.isEmpty() || !waitUntil([this] { return !plant()->recording()->isReading(); }))
            qFatal("%s", qPrintable(error));
    }
    Playback &playback() { return *playbackOf; }
    QPlcTimeAxis *axis() { return window.context()->timeAxis(); }
    /// What gauges and tables show.
    double shown(const char *signal)
    {
        const PlantList::Signal found
            = window.context()->plants()->resolve(SignalReference::fromString(QString::fromLatin1(signal)));
        return pastValue(found, axis()->displayTime().value_or(0)).toReal();
    }

    FlightFile flight;
    QString name;
    Playback *playbackOf = part<RecordingTimeline>()->playback();
};

}  // namespace

// Recordings in the window: they stand among the plants, and a bar plays them.
class tst_Recordings : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aRecordingIsShownFromItsBeginToItsEnd();
    void theValuesAreThoseOfTheCycleAtThePlayhead();
    void playingMovesThePlayheadByTheTimeThatPasses();
    void theSpeedIsThatOfTheRecording();
    void playingEndsAtTheEndAndBeginsAgain();
    void aLoopPlaysWhatIsBetweenTheCursors();
    void stepsGoFromCycleToCycle();
    void aClickOnTheLineMovesThePlayhead();
    void anEventIsATickWithItsText();
    void everythingGoesByKeys();
    void nothingInARecordingCanBeCommanded();
    void stopMeansNoRecording();
    void stopMeansTheRunningPlantBesideARecording();
    void aFileThatIsNoRecordingIsRefusedWithAReason();
    void aRecordingThatIsDroppedOnTheWindowIsOpened();
    void aRecentRecordingIsOpenedAgainFromTheMenu();
    void closingTheRecordingHidesTheBar();
    void aRecordingOfOneCycleIsShown();
    void aRecordingThatDoesNotFitIsAnOverviewUntilAPersonLooksCloser();
    void whatIsLeftOutOfAFolderIsTold();
    void recordingsShareTheMemoryOfOne();
    void aRecordingWithLessMemoryBecomesAnOverviewAndComesBack();

private:
    TestSettings m_settings;
};

void tst_Recordings::aRecordingIsShownFromItsBeginToItsEnd()
{
    RecordingWindow fixture;
    QCOMPARE(fixture.name, QStringLiteral("flight"));
    QCOMPARE(fixture.window.plants(), QStringList{QStringLiteral("flight")});
    QVERIFY(!fixture.window.isConnected(fixture.name));
    const SignalStore *store = fixture.plant()->store();
    QCOMPARE(int(store->endRow() - store->firstRow()), cycles);
    QCOMPARE(fixture.axis()->end() - fixture.axis()->begin(), (cycles - 1) * period);
    QVERIFY(fixture.part<PlaybackBar>()->isVisible());
    QTRY_VERIFY(fixture.part<TimeBar>()->stateText().endsWith(QStringLiteral("Recording")));
    QVERIFY2(fixture.plant()->stateText().contains(QLatin1String("6 signals")),
             qPrintable(fixture.plant()->stateText()));
}

void tst_Recordings::theValuesAreThoseOfTheCycleAtThePlayhead()
{
    RecordingWindow fixture;
    for (const int number : {0, 1, 499, 998, 999}) {
        fixture.playback().seek(fixture.playback().begin() + number * period);
        QCOMPARE(fixture.shown("position_x"), double(number));
    }
    fixture.playback().seek(fixture.playback().begin() + 10 * period + period / 2);
    QCOMPARE(fixture.shown("position_x"), 10.0);
}

void tst_Recordings::playingMovesThePlayheadByTheTimeThatPasses()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    playback.seek(playback.begin());
    playback.advance(3 * period);
    QCOMPARE(playback.position(), playback.begin() + 3 * period);
    QCOMPARE(fixture.shown("position_x"), 3.0);
    playback.play();
    QVERIFY(playback.isPlaying());
    const Playback::Time before = playback.position();
    QVERIFY(waitUntil([&] { return playback.position() > before; }));
    playback.pause();
    QVERIFY(!playback.isPlaying());
}

void tst_Recordings::theSpeedIsThatOfTheRecording()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    for (const double speed : {0.1, 2.0, 50.0}) {
        playback.seek(playback.begin());
        playback.setSpeed(speed);
        playback.advance(10 * period);
        QCOMPARE(playback.position() - playback.begin(), Playback::Time(speed * 10.0 * double(period)));
    }
    playback.setSpeed(0.001);
    QCOMPARE(playback.speed(), Playback::SlowestSpeed);
    playback.setSpeed(Playback::AnySpeed);
    playback.seek(playback.begin());
    int frames = 0;
    while (playback.position() < playback.end() && ++frames < 10'000)
        playback.advance(1);
    QVERIFY2(frames < 1000, qPrintable(QString::number(frames)));
}

void tst_Recordings::playingEndsAtTheEndAndBeginsAgain()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    playback.seek(playback.end() - period);
    playback.play();
    playback.advance(5 * period);
    QCOMPARE(playback.position(), playback.end());
    QVERIFY(!playback.isPlaying());
    playback.play();
    QCOMPARE(playback.position(), playback.begin());
    playback.pause();
}

void tst_Recordings::aLoopPlaysWhatIsBetweenTheCursors()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    fixture.axis()->setCursor(QPlcTimeAxis::B, playback.begin() + 100 * period);
    fixture.axis()->setCursor(QPlcTimeAxis::A, playback.begin() + 200 * period);
    fixture.part<PlaybackBar>()->loopButton()->click();
    QVERIFY(playback.isLoop());
    playback.seek(playback.begin() + 199 * period);
    playback.advance(2 * period);
    QCOMPARE(playback.position(), playback.begin() + 100 * period);
    playback.setLoop(false);
    QVERIFY(!fixture.part<PlaybackBar>()->loopButton()->isChecked());
}

void tst_Recordings::stepsGoFromCycleToCycle()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    playback.seek(playback.begin() + 10 * period + 1);
    playback.step(1);
    QCOMPARE(playback.position(), playback.begin() + 11 * period);
    playback.step(-2);
    QCOMPARE(playback.position(), playback.begin() + 9 * period);
    playback.step(-100);
    QCOMPARE(playback.position(), playback.begin());
    playback.step(1'000'000);
    QCOMPARE(playback.position(), playback.end());
}

void tst_Recordings::aClickOnTheLineMovesThePlayhead()
{
    RecordingWindow fixture;
    auto *line = fixture.part<RecordingTimeline>();
    const Playback::Time middle = (fixture.playback().begin() + fixture.playback().end()) / 2;
    QTest::mouseClick(line, Qt::LeftButton, {}, {int(line->xOf(middle)), line->height() / 2});
    const double distance = std::abs(line->xOf(fixture.playback().position()) - line->xOf(middle));
    QVERIFY2(distance <= 1.0, qPrintable(QString::number(distance)));
}

void tst_Recordings::anEventIsATickWithItsText()
{
    RecordingWindow fixture;
    const auto *line = fixture.part<RecordingTimeline>();
    const Playback::Time time = fixture.playback().begin() + happened * period;
    const double x = line->xOf(time);
    QTRY_COMPARE(line->textsAt(x + 2.0), QStringLiteral("the winch is hot"));
    QCOMPARE(line->textsAt(x + 100.0), QString());
    QTest::mouseClick(fixture.part<RecordingTimeline>(), Qt::LeftButton, {}, QPoint(int(x) + 2, 16));
    QCOMPARE(fixture.playback().position(), time);
    const EventLogModel *events = fixture.window.context()->events();
    int told = 0;
    for (int row = 0; row < events->rowCount(); ++row) {
        const PlantEvent &event = events->at(row);
        if (event.text != QLatin1String("the winch is hot"))
            continue;
        ++told;
        QCOMPARE(event.severity, PlantEvent::Error);
        QVERIFY(event.isAcknowledged);  // it is over
    }
    QCOMPARE(told, 1);
}

void tst_Recordings::everythingGoesByKeys()
{
    RecordingWindow fixture;
    Playback &playback = fixture.playback();
    playback.seek(playback.begin());
    fixture.press(Qt::Key_Right, Qt::AltModifier);
    QCOMPARE(playback.position(), playback.begin() + period);
    fixture.press(Qt::Key_Left, Qt::AltModifier);
    QCOMPARE(playback.position(), playback.begin());
    fixture.press(Qt::Key_Up, Qt::AltModifier);
    QCOMPARE(playback.speed(), 2.0);
    fixture.press(Qt::Key_Space, Qt::ControlModifier);
    QVERIFY(playback.isPlaying());
    fixture.press(Qt::Key_Space, Qt::ControlModifier);
    QVERIFY(!playback.isPlaying());
    fixture.part<RecordingTimeline>()->setFocus();
    fixture.press(Qt::Key_End);
    QCOMPARE(playback.position(), playback.end());
}

void tst_Recordings::nothingInARecordingCanBeCommanded()
{
    RecordingWindow fixture;
    QCOMPARE(fixture.plant()->nextAction(), Plant::NoAction);
    QVERIFY(!fixture.action("Start")->isEnabled());
    QVERIFY(!fixture.action("Initialize")->isEnabled());
    fixture.plant()->start();
    QVERIFY(waitUntil([&] { return !fixture.hint().isEmpty(); }));
    QCOMPARE(fixture.hint(), QStringLiteral("'flight' is a recording: nothing can be commanded"));
}

void tst_Recordings::stopMeansNoRecording()
{
    RecordingWindow fixture;
    QVERIFY(PlantSelection(fixture.window.context()->plants()).plantsToStop().isEmpty());
    fixture.press(Qt::Key_Period, Qt::ControlModifier);
    QVERIFY(waitUntil([&] { return !fixture.hint().isEmpty(); }));
    QVERIFY2(fixture.hint().contains(QLatin1String("recording")), qPrintable(fixture.hint()));
}

void tst_Recordings::stopMeansTheRunningPlantBesideARecording()
{
    RecordingWindow fixture;
    PlantList *plants = fixture.window.context()->plants();
    Plant *kite = plants->addFed(QStringLiteral("kite"));
    QCOMPARE(plants->selected(), fixture.plant());
    QCOMPARE(PlantSelection(plants).plantsToStop(), QVector<Plant *>{kite});
    Plant *boat = plants->addFed(QStringLiteral("boat"));
    QCOMPARE(PlantSelection(plants).plantsToStop(), (QVector<Plant *>{kite, boat}));  // the window asks
}

void tst_Recordings::aFileThatIsNoRecordingIsRefusedWithAReason()
{
    WindowFixture fixture;
    QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("letter.mcap")));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("Dear Sir or Madam") > 0);
    file.close();
    QString error;
    QCOMPARE(fixture.window.openRecording({file.fileName()}, &error), QString());
    QVERIFY2(error.contains(QLatin1String("letter.mcap")), qPrintable(error));
    QCOMPARE(fixture.window.openRecording({QStringLiteral("/nowhere/flight.mcap")}, &error), QString());
    QVERIFY2(error.contains(QLatin1String("/nowhere/flight.mcap")), qPrintable(error));
    QCOMPARE(fixture.window.openRecording({folder.filePath(QStringLiteral("."))}, nullptr), QString());
    QCOMPARE(fixture.window.plants(), QStringList());
}

void tst_Recordings::aRecordingThatIsDroppedOnTheWindowIsOpened()
{
    WindowFixture fixture;
    const FlightFile flight;
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(flight.file)});
    QDragEnterEvent enter({100, 100}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&fixture.window, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop({100, 100}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&fixture.window, &drop);
    QCOMPARE(fixture.window.plants(), QStringList{QStringLiteral("flight")});
    QMimeData text;
    text.setUrls({QUrl::fromLocalFile(QStringLiteral("/etc/hostname"))});
    QDragEnterEvent other({100, 100}, Qt::CopyAction, &text, Qt::LeftButton, Qt::NoModifier);
    other.ignore();
    QCoreApplication::sendEvent(&fixture.window, &other);
    QVERIFY(!other.isAccepted());
}

void tst_Recordings::aRecentRecordingIsOpenedAgainFromTheMenu()
{
    RecordingWindow fixture;
    fixture.action("Close flight")->trigger();
    QCOMPARE(fixture.window.plants(), QStringList());
    const QString title = QStringLiteral("&Recent recordings");
    const auto menus = fixture.window.findChildren<QMenu *>();
    const auto recent
        = std::find_if(menus.begin(), menus.end(), [&](const QMenu *menu) { return menu->title() == title; });
    QVERIFY(recent != menus.end());
    Q_EMIT(*recent)->aboutToShow();
    QVERIFY(!(*recent)->actions().isEmpty());
    QCOMPARE((*recent)->actions().first()->text(), QFileInfo(fixture.flight.file).fileName());
    (*recent)->actions().first()->trigger();
    QCOMPARE(fixture.window.plants(), QStringList{QStringLiteral("flight")});
}

void tst_Recordings::closingTheRecordingHidesTheBar()
{
    RecordingWindow fixture;
    fixture.playback().play();
    fixture.action("Close flight")->trigger();
    QCOMPARE(fixture.window.plants(), QStringList());
    QVERIFY(!fixture.part<PlaybackBar>()->isVisible());
    QVERIFY(!fixture.playback().isPlaying());
    QVERIFY(!fixture.axis()->playhead());
}

void tst_Recordings::aRecordingOfOneCycleIsShown()
{
    WindowFixture fixture;
    RecordedFlight flight;
    QVERIFY(flight.begin() && flight.start());
    flight.step(1);
    flight.cycle.stop();
    QCOMPARE(flight.recorder.proceed(&flight.error), PlantRecorder::Ended);
    QVERIFY(flight.recorder.finish(&flight.error));
    QVERIFY2(!fixture.window.openRecording({flight.file}, &flight.error).isEmpty(), qPrintable(flight.error));
    QVERIFY(waitUntil([&] { return !fixture.plant()->recording()->isReading(); }));
    QCOMPARE(fixture.plant()->store()->endRow() - fixture.plant()->store()->firstRow(), SignalStore::Row(1));
    auto *playback = fixture.part<RecordingTimeline>()->playback();
    playback->play();
    playback->advance(1);
    QVERIFY(!playback->isPlaying());
}

void tst_Recordings::aRecordingThatDoesNotFitIsAnOverviewUntilAPersonLooksCloser()
{
    const FlightFile flight(20'000);
    auto recording = std::make_unique<Recording>();
    QString error;
    QVERIFY2(recording->open({flight.file}, &error), qPrintable(error));
    constexpr std::int64_t memory = 2000 * PlantValues::bytesOfRow(6);
    Plant plant{QString(), QStringLiteral("flight")};
    auto *read = new PlantRecording(&plant, std::move(recording), memory);
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    const int channel = plant.values().channels().channel(plant.table().indexOf(QStringLiteral("position_x")));
    const auto extremes
        = [&] { return plant.store()->range(channel, plant.store()->firstRow(), plant.store()->endRow()); };
    QCOMPARE(extremes().minimum, 0.0F);
    QCOMPARE(extremes().maximum, 19'999.0F);
    read->see(read->begin() + 10'000 * period, read->begin() + 10'100 * period);
    QVERIFY(read->isReading());
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    const SignalStore &store = *plant.store();
    const std::optional<SignalStore::Row> row = store.rowUpTo(read->begin() + 10'050 * period);
    QVERIFY(row);
    QCOMPARE(store.value(channel, *row), 10'050.0F);
    QCOMPARE(store.time(*row), read->begin() + 10'050 * period);
    read->see(read->begin() + 10'010 * period, read->begin() + 10'110 * period);  // it is there
    QVERIFY(!read->isReading());
    read->see(read->begin(), read->end());
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    QCOMPARE(extremes().maximum, 19'999.0F);
}

void tst_Recordings::whatIsLeftOutOfAFolderIsTold()
{
    const FlightFile flight(20);
    QFile odd(flight.folder.filePath("odd.mcap"));
    QVERIFY(odd.open(QIODevice::WriteOnly) && odd.write("odd") == 3);
    odd.close();
    WindowFixture fixture;
    QString error;
    QVERIFY2(!fixture.window.openRecording({flight.folder.path()}, &error).isEmpty(), qPrintable(error));
    QVERIFY(waitUntil([&] { return !fixture.plant()->recording()->isReading(); }));
    QVERIFY2(fixture.plant()->stateText().contains("not all files"), qPrintable(fixture.plant()->stateText()));
    const EventLogModel *events = fixture.window.context()->events();
    const auto isTold = [&] {
        for (int row = 0; row < events->rowCount(); ++row) {
            if (events->at(row).text.contains("odd.mcap' is not a recording"))
                return events->at(row).severity == PlantEvent::Warning;
        }
        return false;
    };
    QVERIFY(isTold());
}

void tst_Recordings::recordingsShareTheMemoryOfOne()
{
    PlantList plants;
    const FlightFile flight(20);
    QString error;
    Plant *first = plants.addRecording({flight.file}, {}, &error);
    QVERIFY2(first, qPrintable(error));
    QCOMPARE(first->recording()->memory(), PlantRecording::UsualMemory);
    Plant *second = plants.addRecording({flight.file}, {}, &error);
    QVERIFY2(second, qPrintable(error));
    QCOMPARE(first->recording()->memory(), PlantRecording::UsualMemory / 2);
    QCOMPARE(second->recording()->memory(), PlantRecording::UsualMemory / 2);
    plants.remove(first);
    QCOMPARE(second->recording()->memory(), PlantRecording::UsualMemory);
}

void tst_Recordings::aRecordingWithLessMemoryBecomesAnOverviewAndComesBack()
{
    const FlightFile flight(20'000);
    auto recording = std::make_unique<Recording>();
    QString error;
    QVERIFY2(recording->open({flight.file}, &error), qPrintable(error));
    Plant plant{QString(), QStringLiteral("flight")};
    auto *read = new PlantRecording(&plant, std::move(recording), 40'000 * PlantValues::bytesOfRow(6));
    const auto rows = [&] { return plant.store()->endRow() - plant.store()->firstRow(); };
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    QCOMPARE(rows(), SignalStore::Row(20'000));
    read->setMemory(2000 * PlantValues::bytesOfRow(6));
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    QVERIFY(rows() <= 2000);
    read->setMemory(40'000 * PlantValues::bytesOfRow(6));
    QVERIFY(waitUntil([&] { return !read->isReading(); }));
    QCOMPARE(rows(), SignalStore::Row(20'000));
    read->setMemory(50'000 * PlantValues::bytesOfRow(6));  // it is there
    QVERIFY(!read->isReading());
}

QTEST_MAIN(tst_Recordings)
#include "tst_Recordings.moc"
