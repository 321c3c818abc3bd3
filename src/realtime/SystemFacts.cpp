// SPDX-License-Identifier: Apache-2.0
#include "SystemFacts.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

namespace qplc {

namespace {

/// Reads small files below a folder.
class Reader
{
public:
    explicit Reader(const QString &root)
        : m_root(root)
    {
    }

    /// The text without blanks around it; none when the file cannot be read.
    std::optional<QString> text(const QString &path) const
    {
        QFile file(m_root.filePath(path));
        if (!file.open(QIODevice::ReadOnly))
            return std::nullopt;
        return QString::fromUtf8(file.readAll()).trimmed();
    }
    QStringList words(const QString &path) const
    {
        return text(path).value_or(QString()).simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    }
    QStringList lines(const QString &path) const
    {
        return text(path).value_or(QString()).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    }
    QStringList folders(const QString &path, const QString &filter) const
    {
        return QDir(m_root.filePath(path)).entryList({filter}, QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name);
    }

private:
    QDir m_root;
};

/// What `uname -v` says of preemption, and the file that old real-time kernels have.
QString preemptionOf(const Reader &reader, const QStringList &version)
{
    if (reader.text(QStringLiteral("sys/kernel/realtime")) == QStringLiteral("1"))
        return QStringLiteral("PREEMPT_RT");
    if (version.isEmpty())
        return {};
    for (const char *kind : {"PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT"}) {
        if (version.contains(QLatin1String(kind)))
            return QString::fromLatin1(kind);
    }
    return QStringLiteral("no PREEMPT");
}

QStringList governorsOf(const Reader &reader)
{
    const QString cpus = QStringLiteral("sys/devices/system/cpu");
    QStringList governors;
    for (const QString &cpu : reader.folders(cpus, QStringLiteral("cpu[0-9]*")))
        governors += reader.words(QStringLiteral("%1/%2/cpufreq/scaling_governor").arg(cpus, cpu));
    governors.removeDuplicates();
    return governors;
}

std::optional<int> swapSpaceOf(const Reader &reader)
{
    constexpr int sizeColumn = 2;
    const QString path = QStringLiteral("proc/swaps");
    if (!reader.text(path))
        return std::nullopt;
    int size = 0;
    const QStringList lines = reader.lines(path).mid(1);  // the first one is the title
    for (const QString &line : lines)
        size += line.simplified().section(QLatin1Char(' '), sizeColumn, sizeColumn).toInt();
    return size;
}

/// Runtime of a period, both in us; the runtime -1 has no limit.
std::optional<int> realTimeShareOf(const Reader &reader)
{
    constexpr int all = 100;
    const auto runtime = reader.text(QStringLiteral("proc/sys/kernel/sched_rt_runtime_us"));
    const qint64 period
        = reader.text(QStringLiteral("proc/sys/kernel/sched_rt_period_us")).value_or(QString()).toLongLong();
    if (!runtime || period <= 0)
        return std::nullopt;
    const qint64 us = runtime->toLongLong();
    return us < 0 ? all : int(us * all / period);
}

QVector<SystemFacts::IdleState> idleStatesOf(const Reader &reader)
{
    const QString folder = QStringLiteral("sys/devices/system/cpu/cpu0/cpuidle");
    QVector<SystemFacts::IdleState> states;
    for (const QString &state : reader.folders(folder, QStringLiteral("state*"))) {
        const QString path = QStringLiteral("%1/%2/").arg(folder, state);
        const auto latency = reader.text(path + QLatin1String("latency"));
        if (latency)
            states.append({reader.text(path + QLatin1String("name")).value_or(state), latency->toInt(),
                           reader.text(path + QLatin1String("disable")) != QStringLiteral("1")});
    }
    return states;
}

/// What follows the colon in the first line of this name: "MemTotal:  1024 kB".
QString valueOf(const Reader &reader, const QString &path, const QString &name)
{
    const QStringList lines = reader.lines(path);
    for (const QString &line : lines) {
        if (line.startsWith(name))
            return line.section(QLatin1Char(':'), 1).simplified();
    }
    return {};
}

/// A board tells its model with a zero at the end; others have that of the processor.
QString modelOf(const Reader &reader)
{
    const QString board = reader.text(QStringLiteral("proc/device-tree/model")).value_or(QString());
    return board.isEmpty() ? valueOf(reader, QStringLiteral("proc/cpuinfo"), QStringLiteral("model name"))
                           : QString(board).remove(QChar(0)).simplified();
}

bool isVirtualMachine(const Reader &reader)
{
    const QStringList flags = valueOf(reader, QStringLiteral("proc/cpuinfo"), QStringLiteral("flags"))
                                  .split(QLatin1Char(' '), Qt::SkipEmptyParts);
    const QString vendor = reader.text(QStringLiteral("sys/class/dmi/id/sys_vendor")).value_or(QString());
    return flags.contains(QLatin1String("hypervisor")) || vendor.contains(QLatin1String("QEMU"));
}

/// The soft limit of this name: the names have blanks, columns are at least two blanks apart.
QString limitOf(const Reader &reader, const QString &name)
{
    const QStringList lines = reader.lines(QStringLiteral("proc/self/limits"));
    for (const QString &line : lines) {
        if (line.startsWith(name))
            return line.mid(name.size()).simplified().section(QLatin1Char(' '), 0, 0);
    }
    return {};
}

}  // namespace

SystemFacts SystemFacts::read(const QString &root)
{
    constexpr int releaseWord = 2;  // "Linux version 6.1.0 ..."
    const QString cpus = QStringLiteral("sys/devices/system/cpu/");
    const QString clocks = QStringLiteral("sys/devices/system/clocksource/clocksource0/");
    const Reader reader(root);
    const QStringList version = reader.words(QStringLiteral("proc/version"));
    SystemFacts facts;
    facts.kernel = version.value(releaseWord);
    facts.preemption = preemptionOf(reader, version);
    facts.processors = reader.text(cpus + QLatin1String("online")).value_or(QString());
    facts.isolated = reader.text(cpus + QLatin1String("isolated"));
    facts.governors = governorsOf(reader);
    facts.clockSource = reader.text(clocks + QLatin1String("current_clocksource")).value_or(QString());
    facts.clockSources = reader.words(clocks + QLatin1String("available_clocksource"));
    facts.swapSpace = swapSpaceOf(reader);
    facts.realTimeShare = realTimeShareOf(reader);
    facts.idleStates = idleStatesOf(reader);
    facts.priorityLimit = limitOf(reader, QStringLiteral("Max realtime priority"));
    facts.memoryLimit = limitOf(reader, QStringLiteral("Max locked memory"));
    facts.model = modelOf(reader);
    facts.memory = valueOf(reader, QStringLiteral("proc/meminfo"), QStringLiteral("MemTotal"));
    facts.isVirtual = isVirtualMachine(reader);
    facts.load = reader.words(QStringLiteral("proc/loadavg")).value(0);
    facts.kernelParameters = reader.words(QStringLiteral("proc/cmdline"));
    return facts;
}

}  // namespace qplc
