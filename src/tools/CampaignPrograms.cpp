// SPDX-License-Identifier: Apache-2.0
#include "CampaignPrograms.h"

#include "realtime/Distributions.h"

#include <QtCore/QProcess>
#include <QtCore/QStandardPaths>

#include <csignal>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace tools {

namespace {

constexpr int longestProgramStart = 5'000;  // [ms]
constexpr int longestProgramEnd = 3'000;    // [ms] after a signal
constexpr int mostOutput = 1 << 20;         // [byte] of each of its two channels
constexpr int histogramRows = 20'000;       // of the histogram of cyclictest [us]

QString quoted(const QString &path)
{
    return QLatin1Char('\'') + QString(path).replace(QLatin1Char('\''), QLatin1String("'\\''")) + QLatin1Char('\'');
}

void append(const QByteArray &bytes, QByteArray *kept)
{
    *kept += bytes.left(mostOutput - kept->size());
}

}  // namespace

QVector<CampaignLoad> CampaignLoad::known(const QString &folder)
{
    return {{QStringLiteral("idle"), QString()},
            {QStringLiteral("cpu"), QStringLiteral("exec stress-ng --quiet --cpu 0")},
            {QStringLiteral("memory"), QStringLiteral("exec stress-ng --quiet --vm 1 --vm-bytes 256M --stream 1")},
            {QStringLiteral("disk"),
             QStringLiteral("exec stress-ng --quiet --hdd 1 --hdd-bytes 256M --temp-path %1").arg(quoted(folder))},
            {QStringLiteral("network"), QStringLiteral("exec stress-ng --quiet --sock 1 --udp 1")}};
}

// ---- programs ----

class CampaignProgram::Process : public QProcess
{
public:
    explicit Process(const QString &command)
    {
        connect(this, &QProcess::readyReadStandardOutput, this, [this] { append(readAllStandardOutput(), &output); });
        connect(this, &QProcess::readyReadStandardError, this, [this] { append(readAllStandardError(), &errors); });
        // What it has left behind ends at once: later, its number may be that of another program.
        connect(this, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this, [this] {
            signalAll(SIGKILL);
            m_group = 0;
        });
        setStandardInputFile(nullDevice());
        start(QStringLiteral("/bin/sh"), {QStringLiteral("-c"), command});
        if (waitForStarted(longestProgramStart))
            m_group = pid_t(processId());
    }
    ~Process() override
    {
        for (const int signal : {SIGTERM, SIGKILL}) {
            if (state() != NotRunning) {
                signalAll(signal);
                waitForFinished(longestProgramEnd);
            }
        }
        blockSignals(true);
    }

    QByteArray output;
    QByteArray errors;

protected:
    /// A load with the priority of a cycle would stop the computer: "chrt qtplc" hands it on.
    void setupChildProcess() override
    {
        ::setsid();
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);
        const sched_param ordinary{};
        ::sched_setscheduler(0, SCHED_OTHER, &ordinary);
    }

private:
    void signalAll(int signal)
    {
        if (m_group > 0)
            ::kill(-m_group, signal);
    }

    pid_t m_group = 0;
};

CampaignProgram::CampaignProgram(const QString &command)
    : m_process(std::make_unique<Process>(command))
{
}

CampaignProgram::~CampaignProgram() = default;

bool CampaignProgram::isRunning() const
{
    return m_process->state() != QProcess::NotRunning;
}

QString CampaignProgram::endText() const
{
    if (m_process->error() == QProcess::FailedToStart)
        return m_process->errorString();
    if (isRunning())
        return {};
    const QString said = QString::fromUtf8(m_process->errors).simplified().left(200);
    const QString how = m_process->exitStatus() == QProcess::CrashExit
        ? QStringLiteral("it was killed")
        : QStringLiteral("exit code %1").arg(m_process->exitCode());
    return said.isEmpty() ? how : QStringLiteral("%1: %2").arg(how, said);
}

QByteArray CampaignProgram::output() const
{
    return m_process->output;
}

// ---- cyclictest ----

QString cyclictestCommand(std::chrono::nanoseconds period, int priority, std::chrono::seconds duration)
{
    QString program = QStandardPaths::findExecutable(QStringLiteral("cyclictest"));
    if (program.isEmpty())
        program = QStandardPaths::findExecutable(QStringLiteral("cyclictest"), {QStringLiteral("/usr/sbin")});
    if (program.isEmpty())
        return {};
    return QStringLiteral("exec %1 --quiet --default-system --threads=1 --interval=%2 --duration=%3 --histogram=%4 %5")
        .arg(quoted(program))
        .arg(period.count() / 1000)
        .arg(duration.count())
        .arg(histogramRows)
        .arg(priority > 0 ? QStringLiteral("--mlockall --priority=%1").arg(priority)
                          : QStringLiteral("--policy=other"));
}

QPlcDistribution cyclictestResult(const QByteArray &output)
{
    QVector<QPlcDistribution::Bin> bins;
    qplc::ExactFigures exact;
    const auto add = [&](qint64 latency, quint64 count) {
        if (count == 0)
            return;
        bins.append({latency, count});
        exact.add({latency, latency, latency * qint64(count)});
    };
    qint64 maximum = 0;
    quint64 beyond = 0;
    const QList<QByteArray> lines = output.split('\n');
    for (const QByteArray &line : lines) {
        const QList<QByteArray> words = line.simplified().split(' ');
        if (line.startsWith("# Max Latencies:"))
            maximum = words.last().toLongLong() * 1000;
        else if (line.startsWith("# Histogram Overflows:"))
            beyond = words.last().toULongLong();
        if (!line.startsWith('#') && words.size() == 2)
            add(words.first().toLongLong() * 1000, words.last().toULongLong());
    }
    add(maximum, beyond);
    return qplc::distributionOf(bins, exact);
}

}  // namespace tools
