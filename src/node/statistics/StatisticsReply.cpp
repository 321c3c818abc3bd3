// SPDX-License-Identifier: Apache-2.0
#include "StatisticsReply.h"

namespace qplc {

messages::Statistics statisticsReply(const QPlcCycleStatistics &statistics)
{
    messages::Statistics reply;
    reply.master = {statistics.lateness, statistics.execution, statistics.roundTrip, statistics.slack,
                    messages::countersOf(statistics)};
    for (const QPlcNodeStatistics &node : statistics.nodes)
        reply.nodes.push_back({node.name, node.execution, node.roundTrip, node.slack, messages::countersOf(node)});
    reply.worst.assign(statistics.worst.begin(), statistics.worst.end());
    return reply;
}

}  // namespace qplc
