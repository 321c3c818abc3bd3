// SPDX-License-Identifier: Apache-2.0
#include "StatisticsReply.h"

namespace qplc {

QPlcCycleStatistics statisticsOf(const MasterCycle &cycle, const NodeRegistry &registry,
                                 QPlcDistribution::Detail detail)
{
    QPlcCycleStatistics statistics = cycle.cycleStatistics().read(detail);
    for (const std::shared_ptr<NodeSlot> &slot : registry.nodes()) {
        if (!slot->isThere())
            continue;
        statistics.nodes.append(slot->statistics.read(cycle.cycleStatistics().newest(), detail));
        QPlcNodeStatistics &node = statistics.nodes.last();
        node.name = slot->name;
        for (const PayloadLayout::Field &field : slot->outputLayout.fields()) {
            node.nonFinite += cycle.signalGuard().nonFinite(field.signal);
            node.outOfRange += cycle.signalGuard().outOfRange(field.signal);
        }
    }
    return statistics;
}

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
