// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include <algorithm>
#include <limits>

namespace soak {

namespace {

double milliseconds(qint64 time)
{
    return double(time) * 1e-6;
}

/// Whether the node itself was stopped by a fault at some time from \a begin to \a end, or just
/// after.
bool wasStopped(const Evidence &evidence, int node, qint64 begin, qint64 end)
{
    for (const DoneFault &fault : evidence.faults) {
        if (fault.kind == FaultKind::StopNode && fault.node == node && fault.begin <= end && begin <= fault.end)
            return true;
    }
    return false;
}

/// What a node does when nothing more comes: from the last step of a phase to what is recorded
/// next.
void lookAtSilence(const Evidence &evidence, const History &history, const Record &step, const Record &next, Gate *gate)
{
    // A quarter of a period is what the reference clock bears without a word.
    const qint64 limit = (evidence.shape.hold + 1) * evidence.period + evidence.period / 4;
    const qint64 silence = next.time - step.time;
    const bool isSafe = next.kind == Record::Safe;
    if (wasStopped(evidence, history.node, step.time, next.time) || (!isSafe && silence <= limit))
        return;
    const qint64 stalled = evidence.stalls.within(step.time, next.time)
        + std::max<qint64>(0, next.thread == step.thread ? next.waited - step.waited : 0);
    ++gate->looked;
    if (isSafe)
        gate->largest(QStringLiteral("longest until safe [ms]"), milliseconds(silence));
    if (silence <= limit)
        return;
    if (silence <= limit + stalled)
        ++gate->excused;
    else
        gate->fail(QStringLiteral("%1: %2 %3 ms after the last frame, cycle %4; the limit is %5 ms")
                       .arg(history.name, isSafe ? QStringLiteral("safe only") : QStringLiteral("not safe at all,"))
                       .arg(milliseconds(silence))
                       .arg(step.cycle)
                       .arg(milliseconds(limit)));
}

/// Whether a node went safe by itself, or left its master, not long before: then that is what has
/// to have a cause.
bool wasAloneBefore(const Evidence &evidence, int node, qint64 time)
{
    constexpr qint64 longestEcho = 2'000'000'000;  // [ns] until a busy master has heard of it
    const auto isUnwanted = [](const Record *safe) { return safe->numbers[Record::IsWanted] == 0; };
    return std::any_of(evidence.nodes.begin(), evidence.nodes.end(), [&](const History &history) {
        if (history.node != node)
            return false;
        const auto safe = recordsOf(history, Record::Safe, node, time - longestEcho, time);
        return std::any_of(safe.begin(), safe.end(), isUnwanted)
            || !recordsOf(history, Record::MasterLost, node, time - longestEcho, time).empty();
    });
}

bool isOfPhase(const Record &record)
{
    return record.kind == Record::Step || record.kind == Record::Safe || record.kind == Record::PhaseEnded
        || record.kind == Record::MasterLost;
}

}  // namespace

Gate silentWritersBecomeSafe(const Evidence &evidence)
{
    Gate gate("silent writers become safe");
    const qint64 longestHold = (evidence.shape.hold + 1) * evidence.period;
    const bool wasSilent = std::any_of(evidence.faults.begin(), evidence.faults.end(), [&](const DoneFault &fault) {
        return fault.kind == FaultKind::StopNode && fault.end - fault.begin > longestHold;
    });
    bool hasQualities = false;
    for (const History &history : evidence.nodes) {
        const Record *fresh = nullptr;  // the step that brought something new
        for (const Record &record : history.records) {
            if (record.kind == Record::Phase)
                fresh = nullptr;
            if (record.kind != Record::Step || record.numbers[Record::Quality] == Record::NoQuality)
                continue;
            hasQualities = true;
            const bool isNews = !fresh || record.numbers[Record::SeenLife] != fresh->numbers[Record::SeenLife]
                || record.numbers[Record::SeenCounter] != fresh->numbers[Record::SeenCounter];
            const double drive = fromBits(record.numbers[Record::Drive]);
            if (isNews && record.numbers[Record::SeenLife] != 0) {
                fresh = &record;
            } else if (!fresh || record.cycle - fresh->cycle > quint64(evidence.shape.hold)) {
                ++gate.looked;
                if (drive != SafeDrive)
                    gate.fail(QStringLiteral("%1, cycle %2: the drive is %3, its writer was silent since cycle %4")
                                  .arg(history.name)
                                  .arg(record.cycle)
                                  .arg(drive)
                                  .arg(fresh ? fresh->cycle : 0));
            }
        }
    }
    gate.isAsked = hasQualities && (wasSilent || gate.looked > 0);  // who is back soon is held all the time
    return gate;
}

Gate nodesAloneBecomeSafe(const Evidence &evidence)
{
    Gate gate("nodes alone become safe");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults)
        gate.isAsked = gate.isAsked || fault.isOfMaster();
    for (const History &history : evidence.nodes) {
        const Record *step = nullptr;
        for (const Record &record : history.records) {
            if (step && isOfPhase(record))
                lookAtSilence(evidence, history, *step, record, &gate);
            if (record.kind == Record::Step)
                step = &record;
            else if (isOfPhase(record) || record.kind == Record::Phase)
                step = nullptr;
        }
    }
    return gate;
}

namespace {

/// A time in which a master was in SafeStop.
struct SafeSpan
{
    const History *master;
    qint64 begin, end;
    quint64 cycle;  // that ran when it began, at the latest: frames of all later ones say so
};

bool hasCycles(const Record &state)
{
    return state.numbers[0] == Record::RealTime || state.numbers[0] == Record::WaitingForLateSlaves
        || state.numbers[0] == Record::SafeStop;
}

/// The cycle that ran when \a safeStop was recorded, at the latest. It may have begun many numbers
/// after the newest complete one: a master that stood still skips cycles.
/// \param begun  the newest cycle of the phase that has recorded its begin
quint64 cycleInProgress(const Record &safeStop, quint64 begun)
{
    return begun > safeStop.cycle ? begun : safeStop.cycle + 1;
}

/// In order, of all masters.
std::vector<SafeSpan> safeSpans(const Evidence &evidence)
{
    std::vector<SafeSpan> spans;
    for (const History &master : evidence.masters) {
        bool isSafe = false;
        quint64 begun = 0;
        for (const Record &record : master.records) {
            if (record.kind == Record::Cycle)
                begun = record.cycle;
            if (record.kind != Record::State)
                continue;
            if (isSafe)
                spans.back().end = record.time;
            if (!hasCycles(record))
                begun = 0;
            isSafe = record.numbers[0] == Record::SafeStop;
            if (isSafe)
                spans.push_back({&master, record.time, master.records.back().time, cycleInProgress(record, begun)});
        }
    }
    return spans;
}

void lookAtSafeNodes(const History &history, Gate *gate)
{
    const Record *safe = nullptr;
    for (const Record &record : history.records) {
        if (record.kind == Record::Safe) {
            safe = &record;
            if (fromBits(record.numbers[Record::SafeDriveBits]) != SafeDrive)
                gate->fail(QStringLiteral("%1: its safe state has a drive of %2")
                               .arg(history.name)
                               .arg(fromBits(record.numbers[Record::SafeDriveBits])));
        }
        if (record.kind == Record::Phase)
            safe = nullptr;
        if (record.kind != Record::Step)
            continue;
        ++gate->looked;
        if (safe)
            gate->fail(QStringLiteral("%1 computes cycle %2, %3 ms after it went safe")
                           .arg(history.name)
                           .arg(record.cycle)
                           .arg(milliseconds(record.time - safe->time)));
    }
}

void lookAtSafeStop(const Evidence &evidence, const SafeSpan &span, Gate *gate)
{
    for (const History &history : evidence.nodes) {
        for (const Record *step : recordsOf(history, Record::Step, history.node, span.begin, span.end)) {
            if (step->cycle > span.cycle)
                gate->fail(QStringLiteral("%1 computes cycle %2, and %3 has been in SafeStop since cycle %4")
                               .arg(history.name)
                               .arg(step->cycle)
                               .arg(span.master->name)
                               .arg(span.cycle));
        }
    }
}

void lookAtCommands(const Evidence &evidence, const History &master, Gate *gate)
{
    // A command that is later than this allows the next entry.
    qint64 allowed = master.records.empty() ? 0 : master.records.front().time;
    PhaseBegins begins;
    for (const Record &record : master.records) {
        if (!begins.isOne(record))
            continue;
        ++gate->looked;
        if (recordsOf(evidence.runner, Record::Command, -1, allowed, record.time).empty())
            gate->fail(QStringLiteral("%1 goes to RealTime, and nobody has told it to").arg(master.name));
        allowed = record.time;
    }
}

}  // namespace

Gate nothingMovesByItself(const Evidence &evidence)
{
    Gate gate("nothing moves by itself");
    for (const History &history : evidence.nodes)
        lookAtSafeNodes(history, &gate);
    for (const SafeSpan &span : safeSpans(evidence))
        lookAtSafeStop(evidence, span, &gate);
    for (const History &master : evidence.masters)
        lookAtCommands(evidence, master, &gate);
    return gate;
}

Gate safeStopsAreTold(const Evidence &evidence)
{
    constexpr qint64 longest = 1'000'000'000;  // [ns] between what a node does and what the master says
    Gate gate("safe stops are told");
    gate.isAsked = false;
    const std::vector<SafeSpan> spans = safeSpans(evidence);
    const auto isTold = [&](qint64 time) {
        const auto isBefore = [](const SafeSpan &span, qint64 begin) { return span.end < begin; };
        const auto span = std::lower_bound(spans.begin(), spans.end(), time - longest, isBefore);
        return span != spans.end() && span->begin <= time + longest;
    };
    for (const History &history : evidence.nodes) {
        for (const Record &record : history.records) {
            if (record.kind != Record::Safe || record.numbers[Record::IsOrdered] == 0)
                continue;
            gate.isAsked = true;
            ++gate.looked;
            const History *master = evidence.masterAt(record.time);
            const bool wasKilled = !master || master->records.back().time < record.time + longest;
            if (!isTold(record.time) && !wasKilled)  // who is killed at once may not have come to say it
                gate.fail(QStringLiteral("%1 is told to be safe, and the master does not say that it stops")
                              .arg(history.name));
        }
    }
    return gate;
}

namespace {

/// A time in which a node was evicted.
struct EvictedSpan
{
    int node;
    qint64 begin, end;
};

/// A master that is started again keeps nobody out.
std::vector<EvictedSpan> evictedSpans(const Evidence &evidence)
{
    std::vector<EvictedSpan> spans;
    for (const Record &record : evidence.runner.records) {
        if (record.kind == Record::Evicted)
            spans.push_back({record.subject, record.time, std::numeric_limits<qint64>::max()});
        else if (record.kind == Record::Admitted && !spans.empty() && spans.back().node == record.subject)
            spans.back().end = std::min(spans.back().end, record.time);
        else if (record.kind == Record::Started && record.subject == Record::Nobody && !spans.empty())
            spans.back().end = std::min(spans.back().end, record.time);
    }
    return spans;
}

void lookAtEvicted(const Evidence &evidence, const EvictedSpan &span, Gate *gate)
{
    const QString name = nodeName(span.node);
    const History *master = evidence.masterAt(span.begin);
    const qint64 alone = span.begin + (evidence.shape.hold + 2) * evidence.period;  // it knows by then
    ++gate->looked;
    for (const History &history : evidence.nodes) {
        if (history.node == span.node && !recordsOf(history, Record::Step, span.node, alone, span.end).empty())
            gate->fail(QStringLiteral("%1 computes although %2 is evicted").arg(history.name, name));
    }
    if (!master)
        return;
    if (!recordsOf(*master, Record::Registered, span.node, span.begin, span.end).empty())
        gate->fail(QStringLiteral("%1 registers %2, which is evicted").arg(master->name, name));
    for (const Record *state : recordsOf(*master, Record::State, -1, span.begin, span.end)) {
        if (state->numbers[0] == Record::RealTime)
            gate->fail(QStringLiteral("%1 starts without %2, which is needed").arg(master->name, name));
    }
}

}  // namespace

Gate evictedNodesStayOut(const Evidence &evidence)
{
    Gate gate("evicted nodes stay out");
    const std::vector<EvictedSpan> spans = evictedSpans(evidence);
    gate.isAsked = !spans.empty();
    for (const EvictedSpan &span : spans)
        lookAtEvicted(evidence, span, &gate);
    return gate;
}

Gate noFalseAlarms(const Evidence &evidence)
{
    Gate gate("no false alarms");
    ++gate.looked;
    qint64 end = 0;  // what comes later is the end of the plant
    for (const Record &record : evidence.runner.records)
        end = record.kind == Record::Recovered ? record.time : end;
    const auto look = [&](const History &history, const Record &record, int node, const char *what) {
        ++gate.looked;
        if (evidence.isExplained(record.time, node) || record.time > end)
            return;
        if (evidence.stalls.within(record.time - 100'000'000, record.time) >= evidence.period)
            ++gate.excused;
        else
            gate.fail(QStringLiteral("%1: %2 without a cause at %3 ms")
                          .arg(history.name, QString::fromLatin1(what))
                          .arg(milliseconds(record.time)));
    };
    for (const History &history : evidence.nodes) {
        for (const Record &record : history.records) {
            if (record.kind == Record::Safe && record.numbers[Record::IsWanted] == 0)
                look(history, record, -1, "a safe state");  // the whole plant goes safe for one node
            else if (record.kind == Record::MasterLost)
                look(history, record, history.node, "the master is lost");
        }
    }
    for (const History &master : evidence.masters) {
        for (const Record &record : master.records) {
            const int node = record.subject == Record::Nobody ? -1 : record.subject;
            if (record.kind == Record::Lost && !wasAloneBefore(evidence, node, record.time))
                look(master, record, node, "a node is lost");
            else if (record.kind == Record::State && record.numbers[0] == Record::SafeStop)
                look(master, record, -1, "SafeStop");
        }
    }
    return gate;
}

}  // namespace soak
