// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "ListenerPlant.h"
#include "Program.h"
#include "ThreadCosts.h"

#include <csignal>

// Nobody waits for a listener, and nothing is kept for one: neither in another process that was
// stopped, nor in this one behind a thread that hangs.
class tst_SlowListeners : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aStoppedListenerChangesNothing_data();
    void aStoppedListenerChangesNothing();
    void aListenerThatIsStoppedAtTheStartJoinsLater_data() { aStoppedListenerChangesNothing_data(); }
    void aListenerThatIsStoppedAtTheStartJoinsLater();
    void aListenerBehindAHangingThreadChangesNothing();
    void aHangingEventLoopOfTheMasterChangesNothing();
};

namespace {

constexpr std::chrono::milliseconds Period{2};
constexpr int Pause = 1500;  // [ms]
constexpr double MostMemory
    = 300.0;  // [KiB] by which a process may grow that keeps nothing: a stopped listener misses 1.8 MB

/// Memory of this process [KiB].
double residentMemory()
{
    QFile file("/proc/self/statm");
    return file.open(QIODevice::ReadOnly) ? 4.0 * file.readAll().split(' ').at(1).toDouble() : 0.0;
}

/// Whether the process has not grown since it had \a before. Not judged under a sanitizer, which
/// keeps for a while what was freed.
bool hasKept(double before)
{
    return !ThreadCosts::areCounted() || residentMemory() - before < MostMemory;
}

class Master : public QPlcMasterNode
{
public:
    Master()
    {
        setSignalTable(ListenerPlant::table());
        setTimeSignal("time");
        setClock(QPlcClock::realTime());
        setInterval(Period);
    }
    bool start(int remoteNodes)
    {
        return waitUntil([&] { return nodes().size() == remoteNodes; }) && startRealTime()
            && waitUntil([&] { return statistics().cycles > 100; });
    }
    QPlcNodeInfo info(const QString &name) const
    {
        const QVector<QPlcNodeInfo> all = nodes();
        const auto found
            = std::find_if(all.begin(), all.end(), [&](const QPlcNodeInfo &info) { return info.name == name; });
        return found == all.end() ? QPlcNodeInfo() : *found;
    }
    QString address(const QString &kind) const
    {
        return (kind == "local" ? QString("local://%1") : kind + "://127.0.0.1:%1").arg(serverPort());
    }
};

/// Stops a process, and waits until it is.
bool suspend(Program &program)
{
    program.sendSignal(SIGSTOP);
    return waitUntil([&] {
        QFile file(QString("/proc/%1/stat").arg(program.processId()));
        return file.open(QIODevice::ReadOnly) && file.readAll().contains(") T ");
    });
}

/// Cycles since the start that had at least 0.1 ms left at their end: who waits in vain for an
/// answer has nothing left.
quint64 cyclesWithTimeLeft(const Master &master)
{
    quint64 count = 0;
    for (const QPlcDistribution::Bin &bin : master.cycleStatistics(QPlcDistribution::WithBins).slack.sinceStart.bins)
        count += bin.upperBorder > 100'000 ? bin.count : 0;
    return count;
}

struct Counts
{
    explicit Counts(const Master &master)
        : statistics(master.statistics())
        , withTimeLeft(cyclesWithTimeLeft(master))
    {
    }

    QPlcMasterStatistics statistics;
    quint64 withTimeLeft;
};

/// Cycles go on, many of them (also on a machine that is very busy) have time left, and nobody but
/// the worker was ever late.
void checkCycles(const Master &master, const Counts &countsBefore)
{
    const QPlcMasterStatistics &before = countsBefore.statistics;
    const QPlcMasterStatistics after = master.statistics();
    const double passed = double(after.cycles + after.skippedCycles - before.cycles - before.skippedCycles);
    QVERIFY2(passed >= 0.9 * Pause / double(Period.count()), qPrintable(QString::number(passed)));
    QVERIFY2(double(after.skippedCycles - before.skippedCycles) < 0.9 * passed, "hardly a cycle was not skipped");
    QCOMPARE(after.lateAnswers, master.info("Worker").lateAnswers);
    const quint64 withTimeLeft = cyclesWithTimeLeft(master) - countsBefore.withTimeLeft;
    QVERIFY2(withTimeLeft >= 20, qPrintable(QStringLiteral("%1 cycles had time left").arg(withTimeLeft)));
}

}  // namespace

void tst_SlowListeners::aStoppedListenerChangesNothing_data()
{
    QTest::addColumn<QString>("kind");
    QTest::newRow("udp") << "udp";
    QTest::newRow("tcp") << "tcp";
    QTest::newRow("local") << "local";
}

void tst_SlowListeners::aStoppedListenerChangesNothing()
{
    QFETCH(QString, kind);
    Master master;
    QSignalSpy states(&master, &QPlcMasterNode::stateChanged);
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    Program worker(QTPLC_PLANT_LISTENER, {"--worker", "--master", master.address("udp")});
    Program listener(QTPLC_PLANT_LISTENER, {"--master", master.address(kind)});
    QVERIFY(master.start(2));

    listener.sendSignal(SIGSTOP);
    QTest::qWait(200);  // what the system keeps for it is full
    const double memory = residentMemory();
    const Counts before(master);
    QTest::qWait(Pause);
    checkCycles(master, before);
    QVERIFY2(hasKept(memory), qPrintable(QString::number(residentMemory() - memory)));
    QCOMPARE(master.info("Listener").lateAnswers, quint64(0));

    listener.sendSignal(SIGCONT);
    QTest::qWait(500);
    master.stop();
    QCOMPARE(states.size(), 3);  // Initializing, RealTime, Off: it never waited
    master.stopServer();
    QCOMPARE(listener.waitForEnd(), 0);
    const QJsonObject heard = QJsonDocument::fromJson(listener.output().toUtf8()).object();
    const QByteArray said = listener.output().toUtf8();
    QVERIFY2(heard["pause_ms"].toDouble() >= 0.9 * Pause, said);
    QVERIFY2(heard["stale"].toDouble() <= 3.0, said);
    QVERIFY2(heard["silence_ms"].toDouble() >= 0.0 && heard["silence_ms"].toDouble() < 250.0, said);
    QVERIFY2(heard["missed"].toDouble() >= 0.5 * Pause / double(Period.count()), said);
    QCOMPARE(heard["computed"].toDouble() + heard["missed"].toDouble(), heard["spanned"].toDouble());
}

void tst_SlowListeners::aListenerThatIsStoppedAtTheStartJoinsLater()
{
    QFETCH(QString, kind);
    Master master;
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    Program worker(QTPLC_PLANT_LISTENER, {"--worker", "--master", master.address("udp")});
    Program listener(QTPLC_PLANT_LISTENER, {"--master", master.address(kind)});
    QTRY_COMPARE(master.nodes().size(), 2);
    QVERIFY(suspend(listener));
    for (int phase = 1; phase <= 2; ++phase) {
        QElapsedTimer timer;
        timer.start();
        QVERIFY(master.startRealTime());
        QTRY_COMPARE(master.state(), QPlcMasterNode::RealTime);
        QVERIFY2(timer.elapsed() < 1000, "half of the time that a node has for its answer");
        QTRY_VERIFY(master.statistics().cycles > 100);
        QCOMPARE(master.nodes().size(), 2);
        if (phase == 1)
            master.stop();
    }

    listener.sendSignal(SIGCONT);
    QTest::qWait(500);
    master.stop();
    QCOMPARE(master.error(), QPlcMasterNode::NoError);
    master.stopServer();
    QCOMPARE(listener.waitForEnd(), 0);
    QVERIFY2(!listener.errors().contains("ignores") && !listener.errors().contains("in vain"),
             qPrintable(listener.errors()));
    const QByteArray said = listener.output().toUtf8();
    const QJsonObject heard = QJsonDocument::fromJson(said).object();
    QVERIFY2(heard["computed"].toDouble() > 10.0, said);  // on an idle machine 250
    QVERIFY2(heard["stale"].toDouble() <= 3.0, said);
}

void tst_SlowListeners::aListenerBehindAHangingThreadChangesNothing()
{
    QPlcSignalIndexTable::setCurrent(ListenerPlant::table());
    QPlcIOBufferSlaveNode viewer("Viewer");
    Master master;
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    Program worker(QTPLC_PLANT_LISTENER, {"--worker", "--master", master.address("udp")});
    viewer.setBufferSize(100);
    QPlcSignalIndexList inputs;
    for (int i = 0; i < ListenerPlant::Values; ++i)
        inputs.insert(QString("value%1").arg(i));
    inputs.insert("time");
    viewer.setInputSignalIndices(inputs);
    QVERIFY2(master.addLocalNode(&viewer), qPrintable(master.errorString()));
    QVERIFY(master.start(2));

    // The window: its thread takes a batch and hangs in it.
    QSemaphore hangs;
    QSemaphore goesOn;
    QThread thread;
    auto *limiter = new QPlcFrameRateLimiter(&viewer);
    QObject::connect(&thread, &QThread::finished, limiter, &QObject::deleteLater);
    int batches = 0;
    QObject::connect(
        limiter, &QPlcFrameRateLimiter::realTimeout, limiter,
        [&](const QList<QPlcSignalList> &) {
            if (++batches == 1) {
                hangs.release();
                goesOn.acquire();
            }
        },
        Qt::DirectConnection);
    limiter->moveToThread(&thread);
    thread.start();
    QVERIFY(hangs.tryAcquire(1, 20000));

    QTest::qWait(300);
    const double memory = residentMemory();
    const Counts before(master);
    const quint64 lost = viewer.lostCycles();
    QTest::qWait(Pause);
    checkCycles(master, before);
    QVERIFY2(hasKept(memory), qPrintable(QString::number(residentMemory() - memory)));
    QVERIFY(double(viewer.lostCycles() - lost) >= 0.5 * Pause / double(Period.count()));
    const qint64 now = QDateTime::currentMSecsSinceEpoch();
    const qint64 newest
        = viewer.inputSignals().value(ListenerPlant::table().indexOf("time")).toDateTime().toMSecsSinceEpoch();
    QVERIFY2(now - newest < 500, "the newest values are there, whatever hangs");

    goesOn.release();
    thread.quit();
    thread.wait();
    QVector<quint64> cycles;
    viewer.takeInputSignals(&cycles);
    QVERIFY(cycles.size() <= 128);
    master.stop();
    QPlcSignalIndexTable::setCurrent({});
}

void tst_SlowListeners::aHangingEventLoopOfTheMasterChangesNothing()
{
    Master master;
    QVERIFY(master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)));
    Program worker(QTPLC_PLANT_LISTENER, {"--worker", "--master", master.address("udp")});
    Program listener(QTPLC_PLANT_LISTENER, {"--master", master.address("tcp")});
    QVERIFY(master.start(2));
    const double memory = residentMemory();
    const Counts before(master);
    QThread::msleep(Pause);  // nobody serves the connections and takes the reports
    checkCycles(master, before);
    QVERIFY2(hasKept(memory), qPrintable(QString::number(residentMemory() - memory)));
    QCOMPARE(master.nodes().size(), 2);
    master.stop();
}

QTEST_GUILESS_MAIN(tst_SlowListeners)
#include "tst_SlowListeners.moc"
