// SPDX-License-Identifier: Apache-2.0
#include "StatisticsReply.h"

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

std::vector<std::shared_ptr<NodeSlot>> presentNodes(const NodeRegistry &registry)
{
    std::vector<std::shared_ptr<NodeSlot>> nodes;
    std::copy_if(registry.nodes().begin(), registry.nodes().end(), std::back_inserter(nodes),
                 [](const std::shared_ptr<NodeSlot> &slot) { return slot->isThere(); });
    return nodes;
}

QPlcNodeStatistics statisticsOf(const MasterCycle &cycle, const NodeSlot &slot, QPlcDistribution::Detail detail)
{
    QPlcNodeStatistics node = slot.statistics.read(cycle.cycleStatistics().newest(), detail);
    node.name = slot.name;
    for (const PayloadLayout::Field &field : slot.outputLayout.fields()) {
        node.nonFinite += cycle.signalGuard().nonFinite(field.signal);
        node.outOfRange += cycle.signalGuard().outOfRange(field.signal);
    }
    return node;
}

}  // namespace

QPlcCycleStatistics statisticsOf(const MasterCycle &cycle, const NodeRegistry &registry,
                                 QPlcDistribution::Detail detail)
{
    QPlcCycleStatistics statistics = cycle.cycleStatistics().read(detail);
    for (const std::shared_ptr<NodeSlot> &slot : presentNodes(registry))
        statistics.nodes.append(statisticsOf(cycle, *slot, detail));
    return statistics;
}

std::unique_ptr<messages::ListAnswer> statisticsReply(const MasterCycle &cycle, const NodeRegistry &registry,
                                                      QPlcDistribution::Detail detail)
{
    const QPlcCycleStatistics statistics = cycle.cycleStatistics().read(detail);
    messages::Statistics head;
    head.master = {statistics.lateness, statistics.execution, statistics.roundTrip, statistics.slack,
                   messages::countersOf(statistics)};
    head.worst.assign(statistics.worst.begin(), statistics.worst.end());
    const std::vector<std::shared_ptr<NodeSlot>> nodes = presentNodes(registry);
    const auto entry = [&cycle, nodes, detail](std::size_t i) {
        const QPlcNodeStatistics node = statisticsOf(cycle, *nodes[i], detail);
        return messages::NodeMeasures{node.name, node.execution, node.roundTrip, node.slack,
                                      messages::countersOf(node)};
    };
    return messages::makeListAnswer(head, &messages::Statistics::nodes, nodes.size(), entry,
                                    detail == QPlcDistribution::WithBins
                                        ? QStringLiteral("too many nodes for one answer; ask without histograms")
                                        : QStringLiteral("too many nodes for one answer"));
}

}  // namespace qplc
