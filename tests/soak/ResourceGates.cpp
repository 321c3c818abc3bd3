// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include <algorithm>

namespace soak {

namespace {

struct Process
{
    int node;  // -1: the master
    quint32 life;
    bool operator<(const Process &other) const { return node != other.node ? node < other.node : life < other.life; }
};

/// What the runner has seen of each process at times at which the whole plant ran.
QMap<Process, std::vector<const Record *>> usages(const Evidence &evidence)
{
    QMap<Process, std::vector<const Record *>> found;
    for (const Record &record : evidence.runner.records) {
        if (record.kind != Record::Usage || record.numbers[Record::IsCompared] == 0)
            continue;
        const int node = record.subject == Record::Nobody ? -1 : record.subject;
        found[{node, quint32(record.numbers[Record::UsageLife])}].push_back(&record);
    }
    return found;
}

QString nameOf(const Process &process)
{
    return QStringLiteral("%1, life %2")
        .arg(process.node < 0 ? QStringLiteral("the master") : nodeName(process.node))
        .arg(process.life);
}

using Look = std::vector<const Record *>::const_iterator;

quint64 leastOf(Record::UsageNumber number, Look begin, Look end)
{
    const auto isLess = [number](const Record *a, const Record *b) { return a->numbers[number] < b->numbers[number]; };
    return (*std::min_element(begin, end, isLess))->numbers[number];
}

/// Slope of the straight line through resident memory over time [kB/s].
double slopeOf(const std::vector<const Record *> &usages)
{
    double n = 0.0, t = 0.0, m = 0.0, tt = 0.0, tm = 0.0;
    for (const Record *usage : usages) {
        const double time = double(usage->time - usages.front()->time) * 1e-9;
        const double memory = double(usage->numbers[Record::ResidentKb]);
        n += 1.0;
        t += time;
        m += memory;
        tt += time * time;
        tm += time * memory;
    }
    const double spread = n * tt - t * t;
    return spread > 0.0 ? (n * tm - t * m) / spread : 0.0;
}

}  // namespace

Gate nothingLeaks(const Evidence &evidence)
{
    Gate gate("nothing leaks");
    const auto all = usages(evidence);
    constexpr std::ptrdiff_t Looks = 4;          // of the rest at the end, and as many at the begin
    constexpr qint64 beginning = 1'000'000'000;  // [ns] a new process has not done everything once
    for (auto process = all.begin(); process != all.end(); ++process) {
        const auto isOld = [&](const Record *usage) { return usage->time >= process->front()->time + beginning; };
        const auto oldest = std::find_if(process->cbegin(), process->cend(), isOld);
        if (process->cend() - oldest < 2)
            continue;
        // A connection that was just being made again may be seen in one look. What leaks is in all that follow.
        const auto looks = std::min<std::ptrdiff_t>(Looks, (process->cend() - oldest) / 2);
        ++gate.looked;
        for (const auto &[number, what] :
             {std::pair(Record::Descriptors, "descriptors"), {Record::Threads, "threads"}}) {
            const quint64 first = leastOf(number, oldest, oldest + looks);
            const quint64 last = leastOf(number, process->cend() - looks, process->cend());
            gate.largest(QString::fromLatin1(what), double(last));
            if (first != last)
                gate.fail(QStringLiteral("%1: %2 %3 at first, %4 at last")
                              .arg(nameOf(process.key()))
                              .arg(first)
                              .arg(QString::fromLatin1(what))
                              .arg(last));
        }
    }
    return gate;
}

Gate memoryStays(const Evidence &evidence, const Profile &profile)
{
    constexpr double mostGrowth = 100.0;          // [kB] in 10 minutes
    constexpr qint64 shortest = 120'000'000'000;  // [ns] below this a slope says nothing
    constexpr qint64 warmUp = 30'000'000'000;     // [ns] of each life
    Gate gate("memory stays");
    const auto all = usages(evidence);
    gate.isAsked = profile.judgesMemory && !all.isEmpty()
        && all.begin()->back()->time - all.begin()->front()->time >= warmUp + shortest;
    for (auto process = all.begin(); process != all.end(); ++process) {
        std::vector<const Record *> warm;
        for (const Record *usage : *process) {
            if (usage->time >= process->front()->time + warmUp)
                warm.push_back(usage);
        }
        if (process.key().node < 0)
            gate.largest(QStringLiteral("master resident [kB]"), double(process->back()->numbers[Record::ResidentKb]));
        if (warm.size() < 10 || warm.back()->time - warm.front()->time < shortest)
            continue;
        ++gate.looked;
        const double growth = slopeOf(warm) * 600.0;
        gate.largest(QStringLiteral("largest growth [kB per 10 min]"), growth);
        if (growth > mostGrowth)
            gate.fail(QStringLiteral("%1 grows by %2 kB in 10 minutes").arg(nameOf(process.key())).arg(growth));
    }
    return gate;
}

/// A gate that a machine which stands still can make fail.
static Gate ofTime(Gate gate)
{
    gate.isOfTime = true;
    return gate;
}

std::vector<Gate> judge(const Evidence &evidence, const Profile &profile)
{
    return {valuesAreWhole(evidence),
            valuesWereWritten(evidence),
            valuesNeverGoBack(evidence),
            stepsComeOnce(evidence),
            ofTime(silentWritersBecomeSafe(evidence)),
            ofTime(nodesAloneBecomeSafe(evidence)),
            nothingMovesByItself(evidence),
            safeStopsAreTold(evidence),
            ofTime(noFalseAlarms(evidence)),
            ofTime(cyclesAddUp(evidence)),
            ofTime(faultsAreSeen(evidence)),
            ofTime(plantRecovers(evidence)),
            ofTime(faultsAreCounted(evidence)),
            ofTime(linkFaultsAreCounted(evidence)),
            attemptsAreRefused(evidence),
            commandsAreDenied(evidence),
            nothingLeaks(evidence),
            ofTime(memoryStays(evidence, profile))};
}

}  // namespace soak
