// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "RecordedFlight.h"
#include "gui/plant/PlantPast.h"

#include <QPlcRecorder.h>

#include <QtCore/QDir>

#include <chrono>
#include <thread>

#include <sys/stat.h>
#include <unistd.h>

using namespace qplc;

namespace {

using Time = PlantValues::Time;

constexpr Time period = 10'000'000;  // [ns]
constexpr Time noon = 1'800'000'000 * SignalStore::Second;

/// A flight of a simulation: its times begin at 0, and position_x has the number of the cycle. The
/// ring has the name that a master gives it.
struct Flight : RecordedFlight
{
    explicit Flight(quint64 phase = 1)
    {
        const QByteArray name = RingMemory::folder() + "/qtplc-ring-0-kite-abcdef-" + QByteArray::number(phase);
        link = QFile::decodeName(name);
        if (::link(ringFile.constData(), name.constData()) != 0)
            qFatal("cannot name the ring");
    }
    ~Flight() { QFile::remove(link); }

    /// Of a window that has heard \a cycle first, at noon.
    PastWish wish(quint64 cycle) const
    {
        PastWish wish;
        wish.table = table;
        wish.period = period;
        wish.session = description.session;
        wish.before = noon;
        wish.seam = PastWish::Seam{cycle, noon, 0};
        wish.file = file;
        return wish;
    }

    QString link;
};

Past read(const PastWish &wish)
{
    return readPast(wish, std::atomic<bool>(false));
}

Time rowsOf(const Past &past)
{
    const SignalStore *store = past.values.store();
    return Time(store->endRow() - store->firstRow());
}

/// Whether the rows are the cycles \a first to \a last, each once, and the cycle \a seam is heard
/// at noon: with it come the values of the cycle before. Empty: it is so.
QString defectOf(const Past &past, int first, int last, int seam)
{
    const SignalStore *store = past.values.store();
    const int channel = past.values.channels().channel(past.values.table().indexOf(QStringLiteral("position_x")));
    if (rowsOf(past) != last - first + 1)
        return QStringLiteral("%1 rows in place of %2").arg(rowsOf(past)).arg(last - first + 1);
    for (int cycle = first; cycle <= last; ++cycle) {
        const SignalStore::Row row = store->firstRow() + SignalStore::Row(cycle - first);
        if (store->value(channel, row) != float(cycle) || store->time(row) != noon - (seam - cycle - 1) * period
            || store->beginsAnew(row) != (cycle == first))
            return QStringLiteral("cycle %1 has the value %2 at %3")
                .arg(cycle)
                .arg(double(store->value(channel, row)))
                .arg(store->time(row));
    }
    return {};
}

/// A plant in real time, with a recorder that writes into a folder.
struct RecordedPlant
{
    enum Recording { Recorded, NotRecorded };
    explicit RecordedPlant(std::chrono::seconds segment = std::chrono::hours(1), Recording recording = Recorded)
    {
        recorder.setTarget(folder.path());
        recorder.setSegmentDuration(segment);
        recorder.setLeastFree(0);
        if (recording == NotRecorded)
            return;
        recorder.setMaster(&master);
        if (!recorder.start())
            qFatal("%s", qPrintable(recorder.errorString()));
    }
    bool fly(quint64 cycles) { return master.startRealTime() && master.waitForCycles(cycles); }
    bool waitForCount(double count)
    {
        return waitUntil([&] { return master.signalValue(QStringLiteral("count")).toReal() >= count; });
    }

    QTemporaryDir folder;
    RunningMaster master;
    QPlcRecorder recorder;
};

/// A window's plant, and what it says.
struct Window
{
    explicit Window(const RunningMaster &master)
        : master(master)
        , plant(master.address())
    {
        QObject::connect(&plant, &Plant::eventOccurred, &plant,
                         [this](const PlantEvent &event) { events << event.text; });
        QObject::connect(&plant, &Plant::updated, &plant, [this] {
            const SignalStore *store = plant.store();
            if (heard == 0 && !store->isEmpty())
                heard = store->time(store->firstRow());
            if (lost != 0 && heardAgain == 0 && store->newestTime() > lost)
                heardAgain = store->time(store->rowAt(lost + 1));
        });
        plant.open();
    }
    bool waitFor(const QString &text)
    {
        return waitUntil([&] { return !events.filter(text).isEmpty(); });
    }
    /// What the window has, for people who read why a test fails.
    QString told() const
    {
        const auto &recorder = plant.status().master.recorder;
        return events.join(QLatin1Char('\n')) + QStringLiteral("\nrecorder: ")
            + (recorder ? QString::fromLatin1(messages::nameOf(recorder->state)) + QLatin1Char(' ') + recorder->file
                       + recorder->error
                        : QString());
    }
    bool waitForPast() { return waitFor(QStringLiteral("the curves go back to")); }
    /// \param source  of its rows; empty: any. Before a recorder is told, it is the ring alone
    bool waitForGap(const QString &source = {})
    {
        const QString told = QStringLiteral("which this window had not heard");
        return waitUntil([&] { return !events.filter(told).filter(source).isEmpty(); });
    }
    /// Hears cycles, knows of which phase they are, and loses the connection.
    bool loseConnection()
    {
        const bool isHeard = waitUntil([&] { return plant.values().phase().isTimed(); });
        plant.close();
        lost = plant.newestTime();
        return isHeard;
    }
    bool connectAgain()
    {
        plant.open();
        return waitUntil([&] { return heardAgain != 0; });
    }
    SignalStore::Row rowAt(Time time) const { return plant.store()->rowAt(time); }
    double countOf(SignalStore::Row row) const
    {
        const int channel = plant.values().channels().channel(plant.table().indexOf(QStringLiteral("count")));
        return double(plant.store()->value(channel, row));
    }
    /// Whether the master has left out cycles. The row that was heard behind them has the values of
    /// the row before.
    bool hasLeftOut() const { return master.statistics().skippedCycles > 0; }
    /// The first row that was heard.
    SignalStore::Row seam() const { return plant.store()->rowAt(heard); }
    /// The counter counts each cycle that was computed: up to the first one that was heard, each of
    /// them is there once, in its place on the grid of the phase. Empty: it is so.
    QString defect() const { return defect(plant.store()->firstRow(), seam()); }
    /// The same from a row to another one, which was heard.
    QString defect(SignalStore::Row first, SignalStore::Row last) const
    {
        const SignalStore *store = plant.store();
        for (SignalStore::Row row = first + 1; row <= last; ++row) {
            const Time distance = store->time(row) - store->time(row - 1);
            const double computed = countOf(row) - countOf(row - 1);
            if ((computed != 1.0 && !(computed == 0.0 && row == last && hasLeftOut())) || distance <= 0
                || distance % period != 0)
                return QStringLiteral("%1 at row %2 of %3, behind %4, %5 ns later")
                    .arg(countOf(row))
                    .arg(row)
                    .arg(last)
                    .arg(countOf(row - 1))
                    .arg(distance);
        }
        return {};
    }

    const RunningMaster &master;
    Plant plant;
    QStringList events;
    Time heard = 0;  // of the first row that came from the master
    Time lost = 0;   // of the newest one when the connection was lost
    Time heardAgain = 0;
};

}  // namespace

// What a plant has done before a window was there.
class tst_PlantPast : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void cyclesOfFileAndRingAreThereOnce();
    void theRingAloneIsEnough();
    void onlyCyclesThatWereComputedAreWaitedFor();
    void onlyTheNewestCyclesAreKept();
    void filesOfAnotherPhaseThatIsNotTimedAreNotShown();
    void ofSimulationsThePhaseThatRunsIsShown();
    void aReadingThatIsUnwantedEnds();
    void aRestartedWindowShowsWhatWasBefore();
    void filesThatEndAndAreDeletedStayInTheCurves();
    void formerPhasesComeWithTheNextOne();
    void aWindowWithoutARecorderShowsWhatTheRingHas();
    void ofALostConnectionTheCyclesBetweenAreRead_data();
    void ofALostConnectionTheCyclesBetweenAreRead();
    void aLostConnectionLeavesNoGap_data();
    void aLostConnectionLeavesNoGap();
    void aWindowThatWasTooSlowLeavesNoGap();
    void aPhaseThatBeginsWithoutTheWindowIsThereFromItsBegin();
    void aRecorderThatIsStartedLaterFillsAGap();
    void recordingsThatAreNotHereAreTold();
    void hostileNamesDoNoHarm_data();
    void hostileNamesDoNoHarm();

private:
    QTemporaryDir m_rings{QStringLiteral("/dev/shm/qtplc-test-XXXXXX")};
    std::unique_ptr<RunningMaster> m_unrecorded;  // flies while the tests before its own one run
};

void tst_PlantPast::initTestCase()
{
    QVERIFY(m_rings.isValid());
    qputenv("QTPLC_RING_DIR", m_rings.path().toUtf8());
    m_unrecorded = std::make_unique<RunningMaster>();
    QVERIFY(m_unrecorded->startRealTime());
}

void tst_PlantPast::cyclesOfFileAndRingAreThereOnce()
{
    Flight flight;
    flight.record(100, false);
    flight.step(50);  // which the recorder has not saved
    const Past past = read(flight.wish(130));
    QVERIFY2(past.problem.isEmpty(), qPrintable(past.problem));
    QVERIFY(past.hasFiles);
    QVERIFY(past.isJoined);
    const QString defect = defectOf(past, 0, 128, 130);
    QVERIFY2(defect.isEmpty(), qPrintable(defect));
}

void tst_PlantPast::theRingAloneIsEnough()
{
    Flight flight;
    QVERIFY(flight.start());
    flight.step(150);
    const Past past = read(flight.wish(150));
    QVERIFY(!past.hasFiles);
    QVERIFY(past.isJoined);
    const QString defect = defectOf(past, 0, 148, 150);
    QVERIFY2(defect.isEmpty(), qPrintable(defect));
}

void tst_PlantPast::onlyCyclesThatWereComputedAreWaitedFor()
{
    Flight flight;
    QVERIFY(flight.start());
    flight.step(5);
    for (const quint64 first : {0, 1, 2, 6, 7}) {
        const Past past = read(flight.wish(first));
        QCOMPARE(rowsOf(past), first < 2 ? 0 : std::min<Time>(Time(first) - 1, 5));
        QCOMPARE(past.isJoined, first == 2 || first == 6);
        QCOMPARE(past.isLate, first == 7);  // the cycle 5 will be in the ring
    }
}

/// A store of few rows: as of a plant whose table is very large.
void tst_PlantPast::onlyTheNewestCyclesAreKept()
{
    Flight flight;
    flight.record(150, false);
    PastWish wish = flight.wish(150);
    wish.period = RecordedBudget.history / 64;
    const Past past = read(wish);
    const SignalStore *store = past.values.store();
    QCOMPARE(rowsOf(past), Time(64));
    QCOMPARE(store->newestTime(), noon - period);
    QCOMPARE(store->time(store->firstRow()), noon - 64 * period);
}

/// All times of simulations begin at 0: only the ring tells which phase runs.
void tst_PlantPast::filesOfAnotherPhaseThatIsNotTimedAreNotShown()
{
    Flight flight(2);
    flight.record(100);  // of phase 1
    const Past past = read(flight.wish(130));
    QVERIFY(!past.hasFiles);
    QCOMPARE(rowsOf(past), Time(0));
}

void tst_PlantPast::ofSimulationsThePhaseThatRunsIsShown()
{
    Flight flight;
    const QDir folder(flight.folder.path());
    QVERIFY(QFile::rename(flight.record(150),
                          folder.filePath(QStringLiteral("20270115T080000.000Z_kite_abcdef_phase1.mcap"))));
    Flight next(2);
    next.description.phase = 2;
    next.recorder.detach();
    QVERIFY(next.ring->create(next.ringFile + "-2", 1 << 20, next.description.toText(), &next.error));
    QVERIFY(QFile::remove(next.link));
    QVERIFY(QFile::rename(QFile::decodeName(next.ringFile + "-2"), next.link));
    QVERIFY(next.recorder.attach(QFile::encodeName(next.link), &next.error));
    next.record(100, false);
    QVERIFY(
        QFile::rename(next.file, folder.filePath(QStringLiteral("20270115T080010.000Z_kite_abcdef_phase2.mcap.part"))));
    PastWish wish = next.wish(100);
    wish.file = folder.filePath(QStringLiteral("20270115T080010.000Z_kite_abcdef_phase2.mcap.part"));
    const Past past = read(wish);
    QVERIFY2(past.hasFiles, qPrintable(past.problem));
    const QString defect = defectOf(past, 0, 98, 100);
    QVERIFY2(defect.isEmpty(), qPrintable(defect));
}

void tst_PlantPast::aReadingThatIsUnwantedEnds()
{
    Flight flight;
    flight.record(100, false);
    const Past past = readPast(flight.wish(100), std::atomic<bool>(true));
    QCOMPARE(rowsOf(past), Time(0));
}

void tst_PlantPast::aRestartedWindowShowsWhatWasBefore()
{
    RecordedPlant plant;
    QVERIFY(plant.fly(150));
    Window window(plant.master);
    QVERIFY2(window.waitForPast(), qPrintable(window.told()));
    QVERIFY(window.seam() - window.plant.store()->firstRow() >= 140);
    QCOMPARE(window.countOf(window.plant.store()->firstRow()), 1.0);
    QVERIFY2(window.defect().isEmpty(), qPrintable(window.defect()));
    // The line goes on, unless the master has left out a cycle right there.
    const SignalStore *store = window.plant.store();
    const SignalStore::Row seam = window.seam();
    QCOMPARE(store->beginsAnew(seam), store->time(seam) - store->time(seam - 1) != period);
    // And so do the cycles that come.
    const SignalStore::Row end = store->endRow();
    QTRY_VERIFY(window.plant.store()->endRow() > end + 20);
}

void tst_PlantPast::filesThatEndAndAreDeletedStayInTheCurves()
{
    RecordedPlant plant(std::chrono::seconds(1));
    QVERIFY(plant.fly(250));
    Window window(plant.master);
    QVERIFY2(window.waitForPast(), qPrintable(window.told()));
    const QDir folder(plant.folder.path());
    QTRY_VERIFY(folder.entryList({QStringLiteral("*.mcap")}).size() >= 2);
    const QStringList files = folder.entryList({QStringLiteral("*.mcap")});
    for (const QString &file : files)
        QVERIFY(QFile::remove(folder.filePath(file)));
    QCOMPARE(window.countOf(window.plant.store()->firstRow()), 1.0);
    QVERIFY2(window.defect().isEmpty(), qPrintable(window.defect()));
}

void tst_PlantPast::formerPhasesComeWithTheNextOne()
{
    RecordedPlant plant;
    QVERIFY(plant.fly(50));
    plant.master.stop();
    QVERIFY(plant.master.waitForState(QPlcMasterNode::Off));
    QVERIFY(plant.recorder.waitForFinished(std::chrono::seconds(20)));
    const auto computed = SignalStore::Row(plant.recorder.status().cycles);
    Window window(plant.master);
    QTRY_COMPARE(window.plant.nextAction(), Plant::Start);
    QVERIFY(plant.master.startRealTime());
    QVERIFY2(window.waitForPast(), qPrintable(window.told()));
    const SignalStore *store = window.plant.store();
    const SignalStore::Row first = store->firstRow();
    QCOMPARE(window.countOf(first), 1.0);
    QCOMPARE(window.countOf(first + computed - 1), double(computed));
    QVERIFY(store->beginsAnew(first + computed));
    QVERIFY(store->time(first + computed) > store->time(first + computed - 1));
}

/// A recorder that is started later changes nothing: it has no more than the ring.
void tst_PlantPast::aWindowWithoutARecorderShowsWhatTheRingHas()
{
    const std::unique_ptr<RunningMaster> plant = std::move(m_unrecorded);
    RunningMaster &master = *plant;
    const auto least = quint64(PlantPast::LeastOfRing / period);
    QVERIFY(waitUntil([&] { return master.statistics().cycles > least; }));
    Window window(master);
    QVERIFY2(window.waitForPast(), qPrintable(window.told()));
    QCOMPARE(window.events.filter(QStringLiteral("from the ring of the master")).size(), 1);
    QCOMPARE(window.countOf(window.plant.store()->firstRow()), 1.0);
    QVERIFY2(window.defect().isEmpty(), qPrintable(window.defect()));
    const SignalStore *store = window.plant.store();
    QTemporaryDir folder;
    QPlcRecorder recorder;
    recorder.setTarget(folder.path());
    recorder.setLeastFree(0);
    QVERIFY(recorder.start());
    const QStringList rings = QDir(m_rings.path()).entryList({QStringLiteral("qtplc-ring-*")}, QDir::Files);
    QCOMPARE(rings.size(), 1);
    QVERIFY(recorder.addRing(m_rings.filePath(rings.first())));
    const auto isTold = [&] {
        const auto &status = window.plant.status().master.recorder;
        return status && !status->file.isEmpty();
    };
    QVERIFY(waitUntil(isTold));
    const quint64 rows = window.plant.values().rows();
    QTRY_VERIFY(window.plant.values().rows() > rows + 20);
    QCOMPARE(window.plant.store(), store);
    QCOMPARE(window.events.filter(QStringLiteral("the curves")).size(), 1);
}

void tst_PlantPast::ofALostConnectionTheCyclesBetweenAreRead_data()
{
    QTest::addColumn<quint64>("lastCycle");
    QTest::addColumn<int>("first");
    QTest::newRow("the phase goes on") << quint64(50) << 50;
    QTest::newRow("it was another phase") << quint64(1000) << 0;
}

/// The window has heard nothing for much longer than the cycles took.
void tst_PlantPast::ofALostConnectionTheCyclesBetweenAreRead()
{
    QFETCH(quint64, lastCycle);
    QFETCH(int, first);
    Flight flight;
    flight.record(150, false);
    PastWish wish = flight.wish(130);
    wish.after = noon - 500 * period;
    wish.lost = PastWish::Seam{lastCycle, wish.after, 0};
    const Past past = read(wish);
    QVERIFY2(past.hasFiles, qPrintable(past.problem));
    QVERIFY(past.isJoined);
    QVERIFY(!past.goesOn);
    const QString defect = defectOf(past, first, 128, 130);
    QVERIFY2(defect.isEmpty(), qPrintable(defect));
}

void tst_PlantPast::aLostConnectionLeavesNoGap_data()
{
    QTest::addColumn<bool>("isRecorded");
    QTest::newRow("recorded") << true;
    QTest::newRow("the ring alone") << false;
}

void tst_PlantPast::aLostConnectionLeavesNoGap()
{
    QFETCH(bool, isRecorded);
    RecordedPlant plant(std::chrono::hours(1), isRecorded ? RecordedPlant::Recorded : RecordedPlant::NotRecorded);
    QVERIFY(plant.fly(1));
    Window window(plant.master);
    QVERIFY2(window.loseConnection(), qPrintable(window.told()));
    const double count = window.countOf(window.rowAt(window.lost));
    QVERIFY(plant.waitForCount(count + 80.0));
    QVERIFY2(window.connectAgain(), qPrintable(window.told()));
    QVERIFY2(window.waitForGap(), qPrintable(window.told()));
    const SignalStore *store = window.plant.store();
    const SignalStore::Row first = window.rowAt(window.lost);
    const SignalStore::Row last = window.rowAt(window.heardAgain);
    QCOMPARE(store->time(first), window.lost);
    QCOMPARE(store->time(last), window.heardAgain);
    QVERIFY(last - first >= 80);
    QVERIFY2(window.defect(first, last).isEmpty(), qPrintable(window.defect(first, last)));
    // The line goes on, unless the master has left out a cycle.
    for (SignalStore::Row row = first + 1; row <= last; ++row)
        QCOMPARE(store->beginsAnew(row), store->time(row) - store->time(row - 1) != period);
    QTRY_VERIFY(window.plant.store()->endRow() > last + 20);
}

/// The connection goes on, in threads of its own.
void tst_PlantPast::aWindowThatWasTooSlowLeavesNoGap()
{
    RecordedPlant plant;
    QVERIFY(plant.fly(1));
    Window window(plant.master);
    QVERIFY(waitUntil([&] { return window.plant.values().phase().isTimed(); }));
    const quint64 rows = window.plant.values().rows();
    QTRY_VERIFY(window.plant.values().rows() > rows + 20);
    window.lost = window.plant.newestTime();
    const quint64 cycles = plant.master.statistics().cycles;
    while (plant.master.statistics().cycles < cycles + 700)  // 256 frames wait for a window
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    QVERIFY2(window.waitForGap(), qPrintable(window.told()));
    QVERIFY(window.plant.values().gaps() > 0);
    QVERIFY(window.plant.isConnected());
    const SignalStore *store = window.plant.store();
    const SignalStore::Row first = window.rowAt(window.lost);
    const SignalStore::Row last = store->endRow() - 1;
    QVERIFY(window.countOf(last) - window.countOf(first) >= 700.0);
    // Each cycle is there once; frames that are lost on a loaded computer are counted, and only
    // longer holes are read again.
    quint64 losses = 0;
    int repeated = 0;
    for (SignalStore::Row row = first + 1; row <= last; ++row) {
        const Time distance = store->time(row) - store->time(row - 1);
        const double computed = window.countOf(row) - window.countOf(row - 1);
        QVERIFY(distance > 0 && distance % period == 0 && distance < PlantValues::LeastHole);
        QVERIFY(computed >= 0.0 && computed * double(period) <= double(distance));
        losses += computed > 1.0 ? 1 : 0;
        repeated += computed == 0.0 ? 1 : 0;
    }
    QVERIFY(losses < window.plant.values().gaps());  // one of them was filled
    QVERIFY(repeated == 0 || (repeated == 1 && window.hasLeftOut()));
}

void tst_PlantPast::aPhaseThatBeginsWithoutTheWindowIsThereFromItsBegin()
{
    RecordedPlant plant;
    QVERIFY(plant.fly(1));
    Window window(plant.master);
    QVERIFY2(window.loseConnection(), qPrintable(window.told()));
    QVERIFY(plant.waitForCount(window.countOf(window.rowAt(window.lost)) + 30.0));
    plant.master.stop();
    QVERIFY(plant.master.waitForState(QPlcMasterNode::Off));
    QVERIFY(plant.recorder.waitForFinished(std::chrono::seconds(20)));
    const auto computed = double(plant.recorder.status().cycles);
    // The window may have heard the first phase late: the next one begins where it ends there.
    const double left
        = computed - window.countOf(window.rowAt(window.lost)) + double(plant.master.statistics().skippedCycles) + 2.0;
    const Time end = window.lost + Time(left) * period;
    QVERIFY(waitUntil([&] { return QDateTime::currentMSecsSinceEpoch() * 1'000'000 > end; }));
    QVERIFY(plant.master.startRealTime());
    QVERIFY(plant.waitForCount(30.0));
    QVERIFY2(window.connectAgain(), qPrintable(window.told()));
    QVERIFY2(window.waitForGap(plant.folder.path()), qPrintable(window.told()));
    const SignalStore *store = window.plant.store();
    const SignalStore::Row last = window.rowAt(window.heardAgain);
    const SignalStore::Row first = window.rowAt(window.lost);
    SignalStore::Row second = first + 1;
    while (second < last && window.countOf(second) != 1.0)
        ++second;
    QCOMPARE(window.countOf(second - 1), computed);
    QCOMPARE(window.countOf(second), 1.0);
    QVERIFY(store->beginsAnew(second));
    QVERIFY(window.countOf(last) >= 30.0);
    QVERIFY2(window.defect(first, second - 1).isEmpty(), qPrintable(window.defect(first, second - 1)));
    QVERIFY2(window.defect(second, last).isEmpty(), qPrintable(window.defect(second, last)));
}

/// The window cannot see the ring, and has looked in vain.
void tst_PlantPast::aRecorderThatIsStartedLaterFillsAGap()
{
    RecordedPlant plant(std::chrono::hours(1), RecordedPlant::NotRecorded);
    QString ring;
    connect(&plant.master, &QPlcMasterNode::ringIsReady, this, [&](const QString &file) { ring = file; });
    QVERIFY(plant.fly(1));
    Window window(plant.master);
    QVERIFY2(window.loseConnection(), qPrintable(window.told()));
    QVERIFY(plant.waitForCount(window.countOf(window.rowAt(window.lost)) + 30.0));
    const QTemporaryDir nothing;
    qputenv("QTPLC_RING_DIR", nothing.path().toUtf8());
    const auto restore = qScopeGuard([this] { qputenv("QTPLC_RING_DIR", m_rings.path().toUtf8()); });
    QVERIFY2(window.connectAgain(), qPrintable(window.told()));
    const quint64 rows = window.plant.values().rows();
    QTRY_VERIFY(window.plant.values().rows() > rows + 100);
    const QString told = QStringLiteral("which this window had not heard");
    QVERIFY(window.events.filter(told).isEmpty());
    QVERIFY(plant.recorder.start() && plant.recorder.addRing(ring));
    QVERIFY2(window.waitForGap(), qPrintable(window.told()));
    const SignalStore::Row first = window.rowAt(window.lost);
    const SignalStore::Row last = window.rowAt(window.heardAgain);
    QVERIFY(last - first >= 30);
    QVERIFY2(window.defect(first, last).isEmpty(), qPrintable(window.defect(first, last)));
    QCOMPARE(window.events.filter(told).filter(plant.folder.path()).size(), 1);
}

void tst_PlantPast::recordingsThatAreNotHereAreTold()
{
    RecordedPlant plant;
    QVERIFY(plant.fly(20));
    const QString other = plant.folder.path() + QStringLiteral("-other");
    QVERIFY(QFile::rename(plant.folder.path(), other));
    Window window(plant.master);
    const bool isTold
        = window.waitFor(QStringLiteral("'%1', where this window cannot read them").arg(plant.folder.path()));
    QVERIFY(QFile::rename(other, plant.folder.path()));
    QVERIFY2(isTold, qPrintable(window.told()));
    QVERIFY(window.plant.isConnected());
}

void tst_PlantPast::hostileNamesDoNoHarm_data()
{
    QTest::addColumn<QString>("name");
    QTest::newRow("is not there") << "/nowhere/flight.mcap";
    QTest::newRow("is not a path") << "office:/data/flight.mcap";
    QTest::newRow("is a FIFO") << "%1/fifo.mcap";
    QTest::newRow("is a symbolic link") << "%1/link.mcap";
    QTest::newRow("has another session") << "%1/other.mcap";
    QTest::newRow("is not a recording") << "%1/text.mcap";
    QTest::newRow("is too large") << "%1/huge.mcap";
    QTest::newRow("is a folder") << "%1";
    QTest::newRow("has no end") << "/dev/zero";
    QTest::newRow("belongs to the kernel") << "/proc/self/mem";
}

void tst_PlantPast::hostileNamesDoNoHarm()
{
    QFETCH(QString, name);
    Flight flight;
    const QString recording = flight.record(100, false);
    const QDir folder(flight.folder.path());
    QVERIFY(QFile::copy(recording, folder.filePath(QStringLiteral("other.mcap"))));
    QVERIFY(QFile::link(recording, folder.filePath(QStringLiteral("link.mcap"))));
    QCOMPARE(::mkfifo(QFile::encodeName(folder.filePath(QStringLiteral("fifo.mcap"))).constData(), 0600), 0);
    QFile text(folder.filePath(QStringLiteral("text.mcap")));
    QVERIFY(text.open(QIODevice::WriteOnly) && text.write("hello") == 5);
    QVERIFY(QFile::copy(recording, folder.filePath(QStringLiteral("huge.mcap"))));
    QVERIFY(QFile::resize(folder.filePath(QStringLiteral("huge.mcap")), LargestUnfinishedFile + 1));  // of no blocks
    PastWish wish = flight.wish(100);
    wish.file = name.contains(QStringLiteral("%1")) ? name.arg(folder.path()) : name;
    QFile::remove(flight.link);  // the master runs elsewhere
    wish.seam->cycleZero = 1;
    if (name.endsWith(QStringLiteral("other.mcap")))
        wish.session = 5;
    const Past past = read(wish);
    QCOMPARE(rowsOf(past), Time(0));
    QVERIFY2(past.problem.contains(QStringLiteral("Remedy")), qPrintable(past.problem));
}

QTEST_MAIN(tst_PlantPast)
#include "tst_PlantPast.moc"
