// SPDX-License-Identifier: Apache-2.0
// recorder_load [SECONDS]: a master writes cycles of 420 signals at 100 Hz, and then of 10 000 at
// 1 kHz, into its ring. `qtplc record`, a process of its own, writes them into a folder. Prints
// which share of a core the recorder takes by its own processor time, its resident memory, and the
// bytes of a cycle. Exit code 1: a cycle is missing.
//
// recorder_load stall: a master in real time has 10 000 signals at 1 kHz, and the disk of its
// recorder stalls for 10 s. Prints what a cycle takes before and meanwhile. Exit code 1: a cycle is
// neither in the files nor in a gap.
#include "node/cycle/MasterCycle.h"
#include "node/cycle/RingDescription.h"
#include "protocol/LittleEndian.h"
#include "recording/Disk.h"
#include "recording/RecordedPhases.h"
#include "recording/RecorderThread.h"
#include "recording/Verification.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

namespace {

using namespace qplc;
using Clock = std::chrono::steady_clock;

constexpr double WarmUp = 3.0;  // [s]
constexpr int Stall = 10;       // [s], as long as statistics look back

struct Load
{
    int signalCount;
    double rate;  // [1/s]
};

/// A master whose cycles the program turns.
class Master
{
public:
    explicit Master(const Load &load)
        : m_rate(load.rate)
        , m_table(QPlcSignalTable::fromIni(ini(load.signalCount)))
        , m_cycle(m_table, m_hub, false)
    {
        for (std::size_t i = 0; i < m_noise.size(); ++i)
            m_noise[i] = float(std::sin(double(i)) + 0.01 * double(i * 2654435761U >> 22 & 1023U));
    }
    bool begin(QString *error, QPlcClock clock = QPlcClock::external())
    {
        RingDescription description;
        description.plant = QStringLiteral("load");
        description.version = QStringLiteral("benchmark");
        description.session = 1;
        description.phase = 1;
        description.period = std::int64_t(1e9 / m_rate);
        description.clock = clock.isTimed() ? QStringLiteral("real-time") : QStringLiteral("external");
        description.table = m_table.toIni();
        MasterCycle::Phase phase;
        phase.period = std::chrono::nanoseconds(description.period);
        phase.clock = clock;
        phase.ring = std::make_shared<RecordRing>();
        const std::size_t size = CycleTap::usualSize(m_cycle.image(), 0);
        m_ringBytes = RecordRing::capacityFor(m_rate, 60.0, size, RingMemory::folder());
        if (!phase.ring->create(ringFile(), m_ringBytes, description.toText(), error))
            return false;
        m_begin = Clock::now();
        return m_cycle.start(phase);
    }
    void run(double seconds)
    {
        const auto last = m_number + std::uint64_t(seconds * m_rate);
        for (; m_number < last; ++m_number) {
            std::this_thread::sleep_until(m_begin
                                          + std::chrono::nanoseconds(std::int64_t(double(m_number) * 1e9 / m_rate)));
            m_cycle.step(m_number, [this](ProcessImage &image) { fill(&image); });
        }
    }
    void end() { m_cycle.stop(); }
    static QByteArray ringFile() { return RingMemory::folder() + "/qtplc-ring-load"; }
    const MasterCycle &cycle() const { return m_cycle; }
    std::uint64_t cycles() const { return m_number; }
    std::size_t ringBytes() const { return m_ringBytes; }

private:
    static QByteArray ini(int count)
    {
        QByteArray text;
        for (int i = 0; i < count; ++i)
            text += "[s" + QByteArray::number(i) + "]\ntype = Real32\n";
        return text;
    }
    /// Noise upon slow waves, as sensors have it.
    void fill(ProcessImage *image)
    {
        for (int i = 0; i < m_table.size(); ++i) {
            const auto signal = QPlcSignalIndex(i);
            const float value = m_noise[(m_number / 64 + std::size_t(i) * 37) % m_noise.size()]
                + 0.001F * m_noise[(m_number * 7 + std::size_t(i)) % m_noise.size()];
            storeLittle(value, image->data() + image->offset(signal));
            image->setQuality(signal, QPlcQuality::Good);
        }
    }

    const double m_rate;
    QPlcSignalTable m_table;
    CyclicHub m_hub;
    MasterCycle m_cycle;
    std::vector<float> m_noise = std::vector<float>(4096);
    std::uint64_t m_number = 0;
    std::size_t m_ringBytes = 0;
    Clock::time_point m_begin;
};

QByteArray contentOf(const QString &file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? opened.readAll() : QByteArray();
}

/// [s] that all threads of a process have computed
double processorTime(qint64 process)
{
    const QDir tasks(QStringLiteral("/proc/%1/task").arg(process));
    double sum = 0.0;
    const QStringList names = tasks.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    for (const QString &name : names)
        sum += contentOf(tasks.filePath(name + QStringLiteral("/schedstat"))).split(' ').value(0).toDouble() * 1e-9;
    return sum;
}

/// [byte], without the ring, which the master has, too
double residentMemory(qint64 process)
{
    const QByteArray text = contentOf(QStringLiteral("/proc/%1/status").arg(process));
    const auto valueOf = [&](const char *name) {
        const int at = text.indexOf(name);
        return at < 0 ? 0.0 : text.mid(at + int(qstrlen(name)), 20).trimmed().split(' ').value(0).toDouble() * 1024.0;
    };
    return valueOf("RssAnon:") + valueOf("RssFile:");
}

/// \return whether all cycles are in the recording
bool isWhole(const QString &folder, std::uint64_t cycles, double *bytesOfCycle)
{
    RecordedPhase phase;
    QStringList unreadable;
    QString error;
    if (!findPhase(folder, &phase, &unreadable, &error)) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return false;
    }
    const VerifiedPhase verified = verifyPhase(phase);
    double bytes = 0.0;
    for (const QString &file : phase.files)
        bytes += double(QFileInfo(file).size());
    *bytesOfCycle = bytes / double(cycles);
    if (verified.isComplete() && verified.cycles == cycles)
        return true;
    std::fprintf(stderr, "%llu of %llu cycles were recorded; %s\n", static_cast<unsigned long long>(verified.cycles),
                 static_cast<unsigned long long>(cycles), qPrintable(verified.problems.join(QLatin1Char('\n'))));
    return false;
}

bool measure(const Load &load, double seconds)
{
    const QTemporaryDir folder;
    QString error;
    Master master(load);
    if (!master.begin(&error)) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return false;
    }
    QProcess recorder;
    recorder.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    recorder.setStandardOutputFile(QProcess::nullDevice());
    const QString target = folder.filePath(QStringLiteral("recordings/"));
    recorder.start(QCoreApplication::applicationDirPath() + QStringLiteral("/qtplc"),
                   {QStringLiteral("record"), target, QStringLiteral("--free-gib"), QStringLiteral("0")});
    if (!recorder.waitForStarted())
        return false;
    master.run(WarmUp);
    const double before = processorTime(recorder.processId());
    const auto begin = Clock::now();
    master.run(seconds);
    const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
    const double used = processorTime(recorder.processId()) - before;
    const double memory = residentMemory(recorder.processId());
    master.end();
    std::this_thread::sleep_for(std::chrono::seconds(2));  // it writes once in a second
    recorder.terminate();
    recorder.waitForFinished();
    double bytes = 0.0;
    const bool isGood = isWhole(target, master.cycles(), &bytes);
    // A busy machine may slow the master down: the share is that of cycles that come in time.
    std::printf("%d signals at %.0f Hz (seen: %.0f Hz): recorder %.2f %% of a core, %.1f MiB resident beside a ring of "
                "%.1f MiB, %.0f bytes for each cycle\n",
                load.signalCount, load.rate, seconds * load.rate / elapsed, 100.0 * used / seconds, memory / 1048576.0,
                double(master.ringBytes()) / 1048576.0, bytes);
    return isGood;
}

/// That of the machine, but for one write that takes some seconds.
class StallingDisk final : public Disk
{
public:
    std::unique_ptr<mcap::FileSink> create(const QString &file, QString *error) override
    {
        std::unique_ptr<mcap::FileSink> sink = machine().create(file, error);
        return sink ? std::make_unique<Sink>(std::move(sink), &m_stall) : nullptr;
    }
    std::uint64_t freeBytes(const QString &folder) override { return machine().freeBytes(folder); }
    void stallOnce() { m_stall = true; }

private:
    class Sink final : public mcap::FileSink
    {
    public:
        Sink(std::unique_ptr<mcap::FileSink> sink, std::atomic<bool> *stall)
            : m_sink(std::move(sink))
            , m_stall(stall)
        {
        }
        bool append(const QByteArray &bytes, QString *error) override
        {
            if (m_stall->exchange(false))
                std::this_thread::sleep_for(std::chrono::seconds(Stall));
            return m_sink->append(bytes, error);
        }
        bool reserve(std::uint64_t bytes, QString *error) override { return m_sink->reserve(bytes, error); }
        bool sync(QString *error) override { return m_sink->sync(error); }
        std::uint64_t size() const override { return m_sink->size(); }

    private:
        std::unique_ptr<mcap::FileSink> m_sink;
        std::atomic<bool> *m_stall;
    };

    std::atomic<bool> m_stall{false};
};

/// Each cycle of the master is in the files or in a gap, and the rest is that of the flight.
bool isExact(const QString &folder, const Master &master)
{
    RecordedPhase phase;
    QStringList unreadable;
    QString error;
    if (!findPhase(folder, &phase, &unreadable, &error)) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return false;
    }
    const VerifiedPhase verified = verifyPhase(phase);
    const quint64 missing = master.cycle().tap().missing();
    const quint64 computed = master.cycle().cycleStatistics().read(QPlcDistribution::FiguresOnly).cycles;
    if (verified.problems.isEmpty() && verified.hasEnd && verified.missing == missing
        && verified.cycles + verified.missing == computed && missing > 0)
        return true;
    std::fprintf(stderr, "%llu cycles in files and %llu in gaps, of %llu with %llu in no record; %s\n",
                 static_cast<unsigned long long>(verified.cycles), static_cast<unsigned long long>(verified.missing),
                 static_cast<unsigned long long>(computed), static_cast<unsigned long long>(missing),
                 qPrintable(verified.problems.join(QLatin1Char('\n'))));
    return false;
}

bool measureStall()
{
    const QTemporaryDir folder;
    QString error;
    StallingDisk disk;
    RecorderLoop::Settings settings;
    settings.folder = folder.filePath(QStringLiteral("recordings"));
    settings.limits.leastFree = 0;
    RecorderThread recorder(settings, disk);
    Master master({10'000, 1000.0});
    if (!recorder.start(&error) || !master.begin(&error, QPlcClock::realTime())
        || !recorder.add(Master::ringFile(), &error)) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return false;
    }
    const auto wait = [](int seconds) { std::this_thread::sleep_for(std::chrono::seconds(seconds)); };
    const auto execution
        = [&master] { return master.cycle().cycleStatistics().read(QPlcDistribution::FiguresOnly).execution.last10s; };
    wait(int(WarmUp) + Stall);
    const QPlcDistribution before = execution();
    disk.stallOnce();
    wait(Stall);
    const QPlcDistribution meanwhile = execution();
    wait(2);
    master.end();
    recorder.waitForEnds(std::chrono::seconds(30));
    const bool isGood = recorder.stop(&error) && isExact(settings.folder, master);
    std::printf(
        "disk stalled for %d s, 10000 signals at 1000 Hz: a cycle takes %.1f us (p50) and %.1f us (p99) before, "
        "%.1f us and %.1f us meanwhile; %llu cycles in gaps\n",
        Stall, double(before.p50) * 1e-3, double(before.p99) * 1e-3, double(meanwhile.p50) * 1e-3,
        double(meanwhile.p99) * 1e-3, static_cast<unsigned long long>(master.cycle().tap().missing()));
    return isGood;
}

}  // namespace

int main(int argc, char **argv)
{
    const QTemporaryDir rings(QStringLiteral("/dev/shm/qtplc-load-XXXXXX"));  // those of others are not recorded
    qputenv("QTPLC_RING_DIR", rings.path().toUtf8());
    const QCoreApplication application(argc, argv);
    if (argc == 2 && qstrcmp(argv[1], "stall") == 0)
        return measureStall() ? 0 : 1;
    const double seconds = argc > 1 ? QByteArray(argv[1]).toDouble() : 20.0;
    if (argc > 2 || !(seconds >= 1.0 && seconds <= 3600.0)) {
        std::fprintf(stderr, "usage: recorder_load [SECONDS], from 1 to 3600; or recorder_load stall\n");
        return 2;
    }
    bool isGood = true;
    for (const Load &load : {Load{420, 100.0}, Load{10'000, 1000.0}})
        isGood = measure(load, seconds) && isGood;
    return isGood ? 0 : 1;
}
