// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include <algorithm>
#include <limits>

namespace soak {

namespace {

/// By how much a counter of the masters has grown from the first attempt on.
qint64 counted(const Evidence &evidence, qint64 begin, Record::MasterNumber number)
{
    qint64 sum = 0;
    for (const History &master : evidence.masters) {
        quint64 before = 0;
        quint64 last = 0;
        for (const Record &record : master.records) {
            if (record.kind != Record::Counters)
                continue;
            last = record.numbers[number];
            if (record.time < begin)
                before = last;
        }
        sum += qint64(last - before);
    }
    return sum;
}

qint64 refusedIn(const Evidence &evidence, qint64 begin)
{
    qint64 sum = 0;
    for (const History &master : evidence.masters)
        sum += qint64(recordsOf(master, Record::Refused, -1, begin, std::numeric_limits<qint64>::max()).size());
    return sum;
}

/// Attempts of nodes to come in that may have failed: on a busy machine a handshake takes longer
/// than a stranger's may.
qint64 failuresOfNodes(const Evidence &evidence, qint64 begin)
{
    qint64 sum = 0;
    for (const History &node : evidence.nodes)
        sum += qint64(recordsOf(node, Record::KeptOut, node.node, begin, std::numeric_limits<qint64>::max()).size());
    return sum;
}

/// The first and the last record of attempts; null: there were none.
std::pair<const Record *, const Record *> attemptsIn(const Evidence &evidence)
{
    const Record *first = nullptr;
    const Record *last = nullptr;
    for (const Record &record : evidence.runner.records) {
        if (record.kind != Record::Attempts)
            continue;
        first = first ? first : &record;
        last = &record;
    }
    return {first, last};
}

/// \param others  of those that were told, at most so many were not tried by intruders
void compare(quint64 done, quint64 refused, qint64 told, qint64 others, Gate *gate)
{
    gate->looked = qint64(done);
    gate->isAsked = done > 0;
    gate->figures[QStringLiteral("done")] = double(done);
    gate->figures[QStringLiteral("refused")] = double(refused);
    gate->figures[QStringLiteral("counted")] = double(told);
    gate->excused = std::clamp<qint64>(told - qint64(done), 0, others);
    if (refused != done || told - gate->excused != qint64(done))
        gate->fail(QStringLiteral("%1 were tried, %2 refused, %3 counted").arg(done).arg(refused).arg(told));
}

}  // namespace

Gate attemptsAreRefused(const Evidence &evidence)
{
    constexpr qint64 longestAttempt = 200'000'000;  // [ns] what comes first is recorded a little later
    Gate gate("attempts are refused");
    const auto [first, last] = attemptsIn(evidence);
    gate.isAsked = last;
    if (!last)
        return gate;
    const qint64 begin = first->time - longestAttempt;
    // Who is not let in is a failed handshake; garbage that looks like the cyclic connection of a
    // node gets one step further.
    const qint64 told = counted(evidence, begin, Record::FailedHandshakes) + refusedIn(evidence, begin);
    compare(last->numbers[Record::Made], last->numbers[Record::Ended], told, failuresOfNodes(evidence, begin), &gate);
    return gate;
}

Gate commandsAreDenied(const Evidence &evidence)
{
    Gate gate("forbidden commands are denied");
    const auto [first, last] = attemptsIn(evidence);
    gate.isAsked = last;
    if (last)
        compare(last->numbers[Record::Commands], last->numbers[Record::Denials],
                counted(evidence, 0, Record::DeniedMessages), 0, &gate);
    return gate;
}

}  // namespace soak
