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

struct Sample
{
    qint64 time;    // [ns]
    double memory;  // [kB]
};

using Samples = std::vector<Sample>;

Samples residentMemory(const std::vector<const Record *> &usages, qint64 begin)
{
    Samples samples;
    for (const Record *usage : usages) {
        if (usage->time >= begin)
            samples.push_back({usage->time, double(usage->numbers[Record::ResidentKb])});
    }
    return samples;
}

/// What a master had in use of its heap, by its own words.
Samples heapInUse(const Evidence &evidence, quint32 life, qint64 begin, qint64 end)
{
    Samples samples;
    for (const History &master : evidence.masters) {
        if (master.life != life)
            continue;
        for (const Record *record : recordsOf(master, Record::Heap, -1, begin, end))
            samples.push_back({record->time, double(record->numbers[Record::HeapInUse]) / 1024.0});
    }
    return samples;
}

/// Slope of the straight line through memory over time [kB/s].
double slopeOf(const Samples &samples)
{
    double n = 0.0, t = 0.0, m = 0.0, tt = 0.0, tm = 0.0;
    for (const Sample &sample : samples) {
        const double time = double(sample.time - samples.front().time) * 1e-9;
        n += 1.0;
        t += time;
        m += sample.memory;
        tt += time * time;
        tm += time * sample.memory;
    }
    const double spread = n * tt - t * t;
    return spread > 0.0 ? (n * tm - t * m) / spread : 0.0;
}

constexpr std::size_t FewestSamples = 10;  // for a slope

/// \param figure  under which the growth is shown \param what  that grows
void judgeGrowth(Gate *gate, const Samples &samples, const QString &figure, const QString &what)
{
    constexpr double mostGrowth = 100.0;  // [kB] in 10 minutes
    const double growth = slopeOf(samples) * 600.0;
    ++gate->looked;
    gate->largest(figure, growth);
    if (growth > mostGrowth)
        gate->fail(QStringLiteral("%1 grows by %2 kB in 10 minutes").arg(what).arg(growth));
}

/// A heap with a reserve hides for hours what leaks: what is in use tells.
void judgeHeap(Gate *gate, const Evidence &evidence, const Process &master, qint64 begin, qint64 end)
{
    const Samples samples = heapInUse(evidence, master.life, begin, end);
    if (samples.size() < FewestSamples) {
        gate->fail(QStringLiteral("%1 has not written what it has in use of its heap").arg(nameOf(master)));
        return;
    }
    gate->largest(QStringLiteral("master heap in use [kB]"), samples.back().memory);
    judgeGrowth(gate, samples, QStringLiteral("growth of the master's heap in use [kB per 10 min]"),
                QStringLiteral("the heap in use of %1").arg(nameOf(master)));
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
        // A connection that was just being made again may be seen in one look. What leaks is in all
        // that follow.
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
    constexpr qint64 shortest = 120'000'000'000;  // [ns] below this a slope says nothing
    constexpr qint64 warmUp = 30'000'000'000;     // [ns] of each life
    Gate gate("memory stays");
    const auto all = usages(evidence);
    gate.isAsked = profile.judgesMemory && !all.isEmpty()
        && all.begin()->back()->time - all.begin()->front()->time >= warmUp + shortest;
    for (auto process = all.begin(); process != all.end(); ++process) {
        const bool isMaster = process.key().node < 0;
        if (isMaster)
            gate.largest(QStringLiteral("master resident [kB]"), double(process->back()->numbers[Record::ResidentKb]));
        const Samples warm = residentMemory(*process, process->front()->time + warmUp);
        if (warm.size() < FewestSamples || warm.back().time - warm.front().time < shortest)
            continue;
        judgeGrowth(&gate, warm, QStringLiteral("largest growth [kB per 10 min]"), nameOf(process.key()));
        if (isMaster)
            judgeHeap(&gate, evidence, process.key(), warm.front().time, warm.back().time);
    }
    return gate;
}

/// A gate of processes, which a simulated plant does not have.
static Gate ofProcesses(Gate gate, const Profile &profile)
{
    gate.isAsked = gate.isAsked && profile.hasProcesses;
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
            evictedNodesStayOut(evidence),
            ofTime(noFalseAlarms(evidence)),
            ofTime(cyclesAddUp(evidence)),
            ofTime(faultsAreSeen(evidence)),
            ofTime(plantRecovers(evidence)),
            ofTime(faultsAreCounted(evidence)),
            ofTime(linkFaultsAreCounted(evidence)),
            startsHaveTheirNodes(evidence),
            friendsGetIn(evidence),
            silentJoinersAreDropped(evidence),
            safetyParametersAgree(evidence),
            attemptsAreRefused(evidence),
            commandsAreDenied(evidence),
            ofProcesses(nothingLeaks(evidence), profile),
            ofProcesses(ofTime(memoryStays(evidence, profile)), profile)};
}

}  // namespace soak
