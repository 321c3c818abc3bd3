// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace soak {

namespace {

constexpr qint64 LongestRecovery = 2'000'000'000;  // [ns]
constexpr qint64 LongestSilence
    // [ns] more: until connections are given up of which no kernel tells, and the longest pause
    // before the next attempt
    = 11'000'000'000;
constexpr qint64 Settled = 250'000'000;  // [ns] after a fault, what it did has been counted

QString nameOf(const DoneFault &fault)
{
    const QString name = QString::fromLatin1(FaultNames[std::size_t(fault.kind)]);
    return fault.node < 0 ? name : QStringLiteral("%1 (%2)").arg(name, nodeName(fault.node));
}

/// The cycles of one real-time phase, and the counters at its end.
struct Phase
{
    std::vector<const Record *> cycles;
    const Record *counters = nullptr;
    bool hasEnded = false;  // by a stop: the counters are those of all its cycles
};

/// By their numbers.
std::map<quint64, Phase> phasesOf(const History &master)
{
    std::map<quint64, Phase> phases;
    for (const Record &record : master.records) {
        if (record.kind == Record::Cycle) {
            phases[record.numbers[Record::CyclePhase]].cycles.push_back(&record);
        } else if (record.kind == Record::Counters) {
            const auto phase = phases.find(record.numbers[Record::MasterPhase]);
            if (phase != phases.end())
                phase->second.counters = &record;
        } else if (record.kind == Record::State && !phases.empty()) {
            phases.rbegin()->second.hasEnded = record.numbers[0] == Record::Off || record.numbers[0] == Record::Ready;
        }
    }
    return phases;
}

/// Whether the master was stopped on purpose when it wrote this: then it did so as long after its
/// cycle as it was stopped.
bool wasStopped(const Evidence &evidence, const Record &cycle)
{
    return std::any_of(evidence.faults.begin(), evidence.faults.end(), [&](const DoneFault &fault) {
        return fault.kind == FaultKind::StopMaster && fault.begin <= cycle.time
            && cycle.time <= fault.end + evidence.period;
    });
}

/// Of a phase that ended with a stop of the master, the last cycle that was written down in time.
const Record &lastInTime(const Evidence &evidence, const Phase &phase)
{
    const auto found = std::find_if(phase.cycles.rbegin(), phase.cycles.rend(),
                                    [&](const Record *cycle) { return !wasStopped(evidence, *cycle); });
    return found == phase.cycles.rend() ? *phase.cycles.front() : **found;
}

void lookAtGrid(const Evidence &evidence, const History &master, const Phase &phase, Gate *gate)
{
    const Record &first = *phase.cycles.front();
    const Record &last = lastInTime(evidence, phase);
    const double periods = double(last.time - first.time) / double(evidence.period);
    const double ahead = double(last.cycle - first.cycle) - periods;
    const double stalled = double(std::max<qint64>(0, last.waited - first.waited)) / double(evidence.period);
    gate->largest(QStringLiteral("away from the grid [cycles]"), std::abs(ahead));
    if (std::abs(ahead) > 1.0) {
        if (std::abs(ahead) <= 1.0 + std::min(stalled, 1.0))
            ++gate->excused;
        else
            gate->fail(QStringLiteral("%1: %2 cycles in the time of %3")
                           .arg(master.name)
                           .arg(last.cycle - first.cycle)
                           .arg(periods));
    }
}

void lookAtPhase(const Evidence &evidence, const History &master, const Phase &phase, Gate *gate)
{
    const Record &last = *phase.cycles.back();
    ++gate->looked;
    gate->figures[QStringLiteral("cycles")] += double(phase.cycles.size());
    gate->figures[QStringLiteral("skipped")] += double(last.cycle + 1 - phase.cycles.size());
    lookAtGrid(evidence, master, phase, gate);
    if (!phase.hasEnded || !phase.counters)
        return;
    const quint64 computed = phase.counters->numbers[Record::Cycles];
    const quint64 skipped = phase.counters->numbers[Record::Skipped];
    gate->figures[QStringLiteral("overruns")] += double(phase.counters->numbers[Record::Overruns]);
    if (computed != phase.cycles.size() || computed + skipped != last.cycle + 1)
        gate->fail(QStringLiteral("%1 counts %2 cycles and %3 skipped ones; there were %4 and %5")
                       .arg(master.name)
                       .arg(computed)
                       .arg(skipped)
                       .arg(phase.cycles.size())
                       .arg(last.cycle + 1 - phase.cycles.size()));
}

/// How many cycles \a master computed from \a begin to \a end.
qint64 cyclesBetween(const History &master, qint64 begin, qint64 end)
{
    return qint64(recordsOf(master, Record::Cycle, -1, begin, end).size());
}

/// The event by which a master tells people of a fault.
Record::Kind eventOf(FaultKind kind)
{
    switch (kind) {
    case FaultKind::KillNode:
        return Record::Lost;
    case FaultKind::StopNode:
    case FaultKind::CutLink:
        return Record::Late;
    default:
        return Record::Refused;
    }
}

/// [ns] from the end of the cause until all works again.
qint64 longestRecoveryOf(const DoneFault &fault)
{
    switch (fault.kind) {
    case FaultKind::PowerNode:
    case FaultKind::PowerMaster:
    case FaultKind::CutRoad:
    case FaultKind::CutRoadToNode:
    case FaultKind::EvictNode:
        return LongestRecovery + LongestSilence;
    default:
        return fault.isAlone ? LongestRecovery : LongestRecovery + LongestSilence;
    }
}

bool isToldByAnEvent(FaultKind kind)
{
    return kind == FaultKind::KillNode || kind == FaultKind::StopNode || kind == FaultKind::CutLink
        || kind == FaultKind::GarbageControl;
}

/// [ns] that the thread of the master that tells of events was kept from running between two times.
qint64 waitedBetween(const History &master, const Record &event, qint64 begin)
{
    auto record = firstFrom(master, begin + 1);
    while (record != master.records.begin()) {
        --record;
        if (record->thread == event.thread)
            return std::max<qint64>(0, event.waited - record->waited);
    }
    return 0;
}

/// Whether the plant may have gone safe for a stall of the machine just before a fault: what is not
/// there cannot be hit.
bool fellBefore(const Evidence &evidence, const DoneFault &fault)
{
    constexpr qint64 before = 500'000'000;  // [ns]
    return evidence.stalls.within(fault.begin - before, fault.end) >= evidence.period;
}

/// The time of the last step before the link of a node was cut. The life before that with the link
/// had a good one.
qint64 cutOf(const Evidence &evidence, const DoneFault &fault)
{
    const Record *last = nullptr;
    for (const History &history : evidence.nodes) {
        if (history.node != fault.node || history.records.empty() || history.records.front().time < fault.begin)
            continue;
        for (const Record &record : history.records) {
            if (record.kind != Record::Step || record.time < fault.begin || record.time > fault.end)
                continue;
            if (last && record.time - last->time > 100'000'000)
                return last->time;
            last = &record;
        }
    }
    return last ? last->time : fault.begin;
}

void lookAtEvent(const Evidence &evidence, const DoneFault &fault, Gate *gate)
{
    const History *master = evidence.masterAt(fault.begin);
    if (!master)
        return;
    ++gate->looked;
    const qint64 begin = fault.kind == FaultKind::CutLink ? cutOf(evidence, fault) : fault.begin;
    const std::vector<const Record *> events
        = recordsOf(*master, eventOf(fault.kind), fault.node, begin, fault.recovered);
    if (events.empty() && fellBefore(evidence, fault)) {
        ++gate->excused;
        return;
    }
    if (events.empty()) {
        gate->fail(QStringLiteral("nobody was told of: %1").arg(nameOf(fault)));
        return;
    }
    const Record &event = *events.front();
    const qint64 limit = evidence.shape.hold + 2;
    const qint64 from = std::min(std::max(begin, fault.effect), event.time);
    const qint64 cycles = cyclesBetween(*master, from, event.time);
    const qint64 stalled = evidence.stalls.within(from, event.time) + waitedBetween(*master, event, from);
    gate->largest(QString::fromLatin1(FaultNames[std::size_t(fault.kind)]) + QStringLiteral(" [cycles]"),
                  double(cycles));
    if (cycles <= limit)
        return;
    if (cycles <= limit + 1 + stalled / evidence.period)
        ++gate->excused;
    else
        gate->fail(
            QStringLiteral("%1: told after %2 cycles, the limit is %3").arg(nameOf(fault)).arg(cycles).arg(limit));
}

/// When what belongs to \a fault works again; 0: never.
qint64 recoveryOf(const Evidence &evidence, const DoneFault &fault)
{
    if (fault.isOfMaster())
        return fault.recovered;
    for (const History &history : evidence.nodes) {
        if (history.node != fault.node)
            continue;
        const std::vector<const Record *> steps
            = recordsOf(history, Record::Step, fault.node, fault.end, fault.recovered + longestRecoveryOf(fault));
        if (!steps.empty())
            return steps.front()->time;
    }
    return 0;
}

}  // namespace

Gate cyclesAddUp(const Evidence &evidence)
{
    Gate gate("cycles add up");
    for (const History &master : evidence.masters) {
        const std::map<quint64, Phase> phases = phasesOf(master);
        for (const auto &[number, phase] : phases)
            lookAtPhase(evidence, master, phase, &gate);
    }
    return gate;
}

Gate faultsAreSeen(const Evidence &evidence)
{
    Gate gate("faults are seen");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        if (!isToldByAnEvent(fault.kind) || !fault.isAlone)
            continue;
        gate.isAsked = true;
        lookAtEvent(evidence, fault, &gate);
    }
    return gate;
}

Gate plantRecovers(const Evidence &evidence)
{
    Gate gate("the plant recovers");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        if (!hasNode(fault.kind) && !fault.isOfMaster())
            continue;
        gate.isAsked = true;
        ++gate.looked;
        const qint64 end = recoveryOf(evidence, fault);
        const qint64 took = end - fault.end;
        if (end == 0 || fault.recovered == std::numeric_limits<qint64>::max()) {
            gate.fail(QStringLiteral("%1: never recovered").arg(nameOf(fault)));
            continue;
        }
        gate.largest(QStringLiteral("longest [ms]"), double(took) * 1e-6);
        const qint64 longest = longestRecoveryOf(fault);
        if (took <= longest)
            continue;
        if (took <= longest + evidence.stalls.within(fault.end, end))
            ++gate.excused;
        else
            gate.fail(QStringLiteral("%1: took %2 ms").arg(nameOf(fault)).arg(double(took) * 1e-6));
    }
    return gate;
}

namespace {

/// When the phase began that the master was in at \a time; 0: in none.
qint64 beginOfPhase(const History &master, qint64 time)
{
    qint64 begin = 0;
    for (const Record &record : master.records) {
        if (record.kind != Record::State || record.time > time)
            continue;
        const bool isRunning
            = record.numbers[0] == Record::RealTime || record.numbers[0] == Record::WaitingForLateSlaves;
        begin = !isRunning ? 0 : begin > 0 ? begin : record.time;
    }
    return begin;
}

/// By how much a counter of the master has grown from the last look before a fault to the first one
/// after it, or since its phase began, when nobody has looked since; -1 when nobody can tell.
qint64 growth(const Evidence &evidence, const DoneFault &fault, Record::MasterNumber number)
{
    const History *master = evidence.masterAt(fault.begin);
    const Record *before = nullptr;
    const Record *after = nullptr;
    if (!master)
        return -1;
    for (const Record &record : master->records) {
        if (record.kind != Record::Counters)
            continue;
        if (record.time < fault.begin)
            before = &record;
        else if (!after && record.time >= fault.end + Settled / 2)
            after = &record;
    }
    if (!after)
        return -1;
    if (before && before->numbers[Record::MasterPhase] == after->numbers[Record::MasterPhase])
        return qint64(after->numbers[number] - before->numbers[number]);
    const qint64 begin = beginOfPhase(*master, fault.begin);
    const bool isSincePhase
        = begin > 0 && (!before || before->time < begin) && beginOfPhase(*master, after->time) == begin;
    return isSincePhase ? qint64(after->numbers[number]) : -1;  // counters begin at 0
}

/// What the product counts of a fault, and what was done; -1: it does not count such a thing.
qint64 countedOf(const Evidence &evidence, const DoneFault &fault)
{
    const History *master = evidence.masterAt(fault.begin);
    switch (fault.kind) {
    case FaultKind::GarbageDatagrams:
        return growth(evidence, fault, Record::Strangers);
    case FaultKind::GarbageControl:
        return master ? qint64(recordsOf(*master, Record::Refused, -1, fault.begin, fault.end + Settled).size()) : 0;
    case FaultKind::KillNode:
        return master ? qint64(recordsOf(*master, Record::Lost, fault.node, fault.begin, fault.recovered).size()) : 0;
    default:
        return -1;
    }
}

bool isCounted(FaultKind kind)
{
    return kind == FaultKind::GarbageDatagrams || kind == FaultKind::GarbageControl || kind == FaultKind::KillNode;
}

}  // namespace

Gate faultsAreCounted(const Evidence &evidence)
{
    Gate gate("faults are counted");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        if (!isCounted(fault.kind) || !fault.isAlone)
            continue;
        gate.isAsked = true;
        ++gate.looked;
        const qint64 counted = countedOf(evidence, fault);
        const QString name = QString::fromLatin1(FaultNames[std::size_t(fault.kind)]);
        gate.figures[name + QStringLiteral(" done")] += double(fault.amount);
        gate.figures[name + QStringLiteral(" counted")] += double(counted);
        if (counted == fault.amount)
            continue;
        const bool isUnknown = counted < 0 || (fault.kind == FaultKind::KillNode && counted == 0);
        if (isUnknown && fellBefore(evidence, fault))
            ++gate.excused;
        else
            gate.fail(QStringLiteral("%1: %2 were done, %3 counted").arg(nameOf(fault)).arg(fault.amount).arg(counted));
    }
    return gate;
}

}  // namespace soak
