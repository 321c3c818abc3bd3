// SPDX-License-Identifier: Apache-2.0
// recorder_load [SECONDS]: a master writes cycles of 420 signals at 100 Hz, and then of 10 000 at
// 1 kHz, into its ring. `qtplc record`, a process of its own, writes them into a folder. Prints
// which share of a core the recorder takes by its own processor time, its resident memory, and the
// bytes of a cycle. Exit code 1: a cycle is missing.
#include "node/cycle/MasterCycle.h"
#include "node/cycle/RingDescription.h"
#include "protocol/LittleEndian.h"
#include "recording/RecordedPhases.h"
#include "recording/Verification.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>

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
    bool begin(QString *error)
    {
        RingDescription description;
        description.plant = QStringLiteral("load");
        description.version = QStringLiteral("benchmark");
        description.session = 1;
        description.phase = 1;
        description.period = std::int64_t(1e9 / m_rate);
        description.clock = QStringLiteral("real-time");
        description.table = m_table.toIni();
        MasterCycle::Phase phase;
        phase.period = std::chrono::nanoseconds(description.period);
        phase.clock = QPlcClock::external();
        phase.ring = std::make_shared<RecordRing>();
        const std::size_t size = CycleTap::usualSize(m_cycle.image(), 0);
        m_ringBytes = RecordRing::capacityFor(m_rate, 60.0, size, RingMemory::folder());
        if (!phase.ring->create(RingMemory::folder() + "/qtplc-ring-load", m_ringBytes, description.toText(), error))
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
    QString error;
    if (!findPhase(folder, &phase, &error)) {
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

}  // namespace

int main(int argc, char **argv)
{
    const QTemporaryDir rings(QStringLiteral("/dev/shm/qtplc-load-XXXXXX"));  // those of others are not recorded
    qputenv("QTPLC_RING_DIR", rings.path().toUtf8());
    const QCoreApplication application(argc, argv);
    const double seconds = argc > 1 ? QByteArray(argv[1]).toDouble() : 20.0;
    if (argc > 2 || !(seconds >= 1.0 && seconds <= 3600.0)) {
        std::fprintf(stderr, "usage: recorder_load [SECONDS], from 1 to 3600\n");
        return 2;
    }
    bool isGood = true;
    for (const Load &load : {Load{420, 100.0}, Load{10'000, 1000.0}})
        isGood = measure(load, seconds) && isGood;
    return isGood ? 0 : 1;
}
