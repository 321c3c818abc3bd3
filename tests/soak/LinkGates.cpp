// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include "signals/Fnv1a.h"
#include "transport/FaultInjector.h"

#include <algorithm>

namespace soak {

namespace {

using qplc::FaultInjector;

struct Counted
{
    FaultKind fault;
    FaultInjector::Kind done;
    Record::NodeNumber counter;
};
constexpr Counted counters[] = {{FaultKind::LoseFrames, FaultInjector::Lost, Record::AnswersLost},
                                {FaultKind::DuplicateFrames, FaultInjector::Duplicated, Record::Duplicated},
                                {FaultKind::ReorderFrames, FaultInjector::Reordered, Record::Reordered},
                                {FaultKind::CorruptFrames, FaultInjector::Corrupted, Record::Rejected}};

/// How often a link has done something.
struct Done
{
    quint64 all = 0;
    quint64 shown = 0;  // before the last frame that passed: frames are lost when a newer one arrives, not earlier
};

/// The same decisions again, for the first \a frames that the link sent.
Done doneTo(const DoneFault &fault, const Counted &what, qint64 frames)
{
    QString error;
    const auto plan = qplc::FaultPlan::fromText(linkFaultsOf(fault.kind, fault.seed), &error);
    FaultInjector injector(plan->sent, plan->seed, 2 * qplc::fnv1a64(nodeName(fault.node).toUtf8()));
    Done done;
    for (qint64 i = 0; i < frames; ++i) {
        if (injector.decide(0).passes)
            done.shown = injector.count(what.done);
    }
    done.all = injector.count(what.done);
    return done;
}

/// Cycles that a life never saw: there was nothing to be answered.
quint64 missedBy(const History &life)
{
    quint64 missed = 0;
    for (const Record &record : life.records)
        missed += record.kind == Record::Step ? record.numbers[Record::Missed] : 0;
    return missed;
}

qint64 stepsUntil(const History &life, qint64 time)
{
    return qint64(recordsOf(life, Record::Step, life.node, 0, time).size());
}

/// The life of the node whose link had the faults.
const History *lifeOf(const Evidence &evidence, const DoneFault &fault)
{
    for (const History &history : evidence.nodes) {
        if (history.node == fault.node && !history.records.empty() && history.records.front().time >= fault.begin)
            return &history;
    }
    return nullptr;
}

/// When the next life of the same node began, which the master counts from zero; \a otherwise when
/// there was none.
qint64 nextLifeOf(const Evidence &evidence, const History &life, qint64 otherwise)
{
    qint64 begin = otherwise;
    for (const History &history : evidence.nodes) {
        const bool isLater = history.node == life.node && !history.records.empty()
            && history.records.front().time > life.records.front().time;
        if (isLater)
            begin = std::min(begin, history.records.front().time);
    }
    return begin;
}

/// The last counters of the node before its life ended; null when they are those of several phases
/// or registrations, or none.
const Record *countersOf(const Evidence &evidence, const DoneFault &fault, const History &life)
{
    const History *master = evidence.masterAt(fault.begin);
    if (!master)
        return nullptr;
    const std::vector<const Record *> all = recordsOf(*master, Record::NodeCounters, fault.node,
                                                      life.records.front().time, nextLifeOf(evidence, life, fault.end));
    const bool isOnePhase
        = !all.empty() && all.front()->numbers[Record::NodePhase] == all.back()->numbers[Record::NodePhase];
    if (!isOnePhase)
        return nullptr;
    const auto registrations
        = recordsOf(*master, Record::Registered, fault.node, life.records.front().time, all.back()->time);
    return registrations.size() <= 1 ? all.back() : nullptr;
}

void lookAt(const Evidence &evidence, const DoneFault &fault, const Counted &what, Gate *gate)
{
    const QString name = QString::fromLatin1(FaultNames[std::size_t(fault.kind)]);
    const History *life = lifeOf(evidence, fault);
    const Record *record = life ? countersOf(evidence, fault, *life) : nullptr;
    if (!record) {
        gate->figures[name + QStringLiteral(" not judged")] += 1.0;
        return;
    }
    ++gate->looked;
    // Frames under way while the counters were read may be in them or not.
    const bool isLoss = what.fault == FaultKind::LoseFrames;
    const Done least = doneTo(fault, what, stepsUntil(*life, record->time - 3 * evidence.period));
    const quint64 most
        = doneTo(fault, what, stepsUntil(*life, record->time + evidence.period)).all + (isLoss ? missedBy(*life) : 0);
    const quint64 counted = record->numbers[what.counter];
    gate->figures[name + QStringLiteral(" done")] += double(most);
    gate->figures[name + QStringLiteral(" counted")] += double(counted);
    if (counted < least.shown || counted > most)
        gate->fail(QStringLiteral("%1 (%2): %3 ... %4 were done, %5 counted")
                       .arg(name, nodeName(fault.node))
                       .arg(least.shown)
                       .arg(most)
                       .arg(counted));
    else if (isLoss && record->numbers[Record::NodeLate] < least.all)
        gate->fail(QStringLiteral("%1 (%2): %3 were done, %4 counted as late")
                       .arg(name, nodeName(fault.node))
                       .arg(least.all)
                       .arg(record->numbers[Record::NodeLate]));
}

}  // namespace

Gate linkFaultsAreCounted(const Evidence &evidence)
{
    Gate gate("link faults are counted");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        for (const Counted &what : counters) {
            if (fault.kind != what.fault || !fault.isAlone)
                continue;
            gate.isAsked = true;
            lookAt(evidence, fault, what, &gate);
        }
    }
    return gate;
}

}  // namespace soak
