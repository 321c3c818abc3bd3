// SPDX-License-Identifier: Apache-2.0
#include "ProcessUsage.h"

#include <QtCore/QDir>
#include <QtCore/QFile>

#include <ctime>

namespace {

/// The number behind \a label in a text of "label: number" lines, all of them added.
double numberBehind(const QByteArray &text, const char *label)
{
    double sum = 0.0;
    for (int at = text.indexOf(label); at >= 0; at = text.indexOf(label, at + 1)) {
        const int begin = at + int(qstrlen(label));
        sum += text.mid(begin, 32).trimmed().split('\n').first().split(' ').first().toDouble();
    }
    return sum;
}

QByteArray contents(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

ProcessUsage ProcessUsage::of(pid_t process)
{
    ProcessUsage usage;
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) == 0)
        ::clock_gettime(clock, &time);
    usage.cpuUs = double(time.tv_sec) * 1e6 + double(time.tv_nsec) * 1e-3;
    const QDir tasks(QStringLiteral("/proc/%1/task").arg(process));
    const QStringList names = tasks.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    for (const QString &name : names) {
        const QByteArray status = contents(tasks.filePath(name) + QStringLiteral("/status"));
        usage.contextSwitches += numberBehind(status, "ctxt_switches:");
        usage.residentKb = numberBehind(status, "VmRSS:");
        ++usage.threads;
    }
    return usage;
}

ProcessUsage ProcessUsage::sumOf(const QVector<qint64> &processes)
{
    ProcessUsage sum;
    for (const qint64 process : processes) {
        const ProcessUsage usage = of(pid_t(process));
        sum.cpuUs += usage.cpuUs;
        sum.contextSwitches += usage.contextSwitches;
        sum.residentKb += usage.residentKb;
        sum.threads += usage.threads;
    }
    return sum;
}

LoopbackUsage LoopbackUsage::now()
{
    const QList<QByteArray> lines = contents(QStringLiteral("/proc/net/dev")).split('\n');
    for (const QByteArray &line : lines) {
        const QList<QByteArray> columns = line.simplified().split(' ');
        if (columns.size() > 2 && columns.at(0) == "lo:")
            return {columns.at(1).toDouble(), columns.at(2).toDouble()};
    }
    return {};
}
