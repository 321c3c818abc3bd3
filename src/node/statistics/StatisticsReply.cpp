// SPDX-License-Identifier: Apache-2.0
#include "StatisticsReply.h"

namespace qplc {

namespace {

/// Counters go by their names: another version may have more of them.
messages::NodeMeasures measuresOf(const QPlcNodeStatistics &node)
{
    return {node.name,
            node.execution,
            node.roundTrip,
            node.slack,
            {{QStringLiteral("answers"), double(node.answers)},
             {QStringLiteral("late"), double(node.late)},
             {QStringLiteral("lost"), double(node.lost)},
             {QStringLiteral("duplicated"), double(node.duplicated)},
             {QStringLiteral("reordered"), double(node.reordered)},
             {QStringLiteral("rejected"), double(node.rejected)},
             {QStringLiteral("forged"), double(node.forged)},
             {QStringLiteral("resent"), double(node.resent)},
             {QStringLiteral("nonFinite"), double(node.nonFinite)},
             {QStringLiteral("outOfRange"), double(node.outOfRange)}}};
}

messages::MasterMeasures measuresOf(const QPlcCycleStatistics &statistics)
{
    return {statistics.lateness,
            statistics.execution,
            statistics.roundTrip,
            statistics.slack,
            {{QStringLiteral("cycles"), double(statistics.cycles)},
             {QStringLiteral("overruns"), double(statistics.overruns)},
             {QStringLiteral("skippedCycles"), double(statistics.skippedCycles)},
             {QStringLiteral("caughtUpCycles"), double(statistics.caughtUpCycles)},
             {QStringLiteral("shiftedTime"), double(statistics.shiftedTime)},
             {QStringLiteral("lateAnswers"), double(statistics.lateAnswers)},
             {QStringLiteral("incompleteCycles"), double(statistics.incompleteCycles)},
             {QStringLiteral("strangers"), double(statistics.strangers)},
             {QStringLiteral("floods"), double(statistics.floods)}}};
}

}  // namespace

messages::Statistics statisticsReply(const QPlcCycleStatistics &statistics)
{
    messages::Statistics reply;
    reply.master = measuresOf(statistics);
    for (const QPlcNodeStatistics &node : statistics.nodes)
        reply.nodes.push_back(measuresOf(node));
    reply.worst.assign(statistics.worst.begin(), statistics.worst.end());
    return reply;
}

}  // namespace qplc
