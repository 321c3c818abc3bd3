// SPDX-License-Identifier: Apache-2.0
// The statistics of a master for its owner, its signals and the control channel.
#include "QPlcMasterNodePrivate.h"
#include "node/statistics/StatisticsReply.h"

namespace {

bool isSingleNumber(QPlcSignalType type)
{
    return type.isNumeric() && !type.isArray();
}

bool isSingleReal(QPlcSignalType type)
{
    return type.isReal() && !type.isArray();
}

}  // namespace

QPlcCycleStatistics QPlcMasterNodePrivate::cycleStatistics(QPlcDistribution::Detail detail) const
{
    if (!cycle)
        return {};
    QPlcCycleStatistics statistics = cycle->cycleStatistics().read(detail);
    for (const std::shared_ptr<qplc::NodeSlot> &slot : registry->nodes()) {
        if (!slot->local && !slot->peer)
            continue;  // its cyclic channel is not there yet
        statistics.nodes.append(slot->statistics.read(cycle->cycleStatistics().newest(), detail));
        QPlcNodeStatistics &node = statistics.nodes.last();
        node.name = slot->name;
        for (const qplc::PayloadLayout::Field &field : slot->outputLayout.fields()) {
            node.nonFinite += cycle->signalGuard().nonFinite(field.signal);
            node.outOfRange += cycle->signalGuard().outOfRange(field.signal);
        }
    }
    return statistics;
}

bool QPlcMasterNodePrivate::activateStatisticSignal(QPlcStatisticFigure figure, const QString &signalName,
                                                    const QString &nodeName)
{
    if (nodeName.isEmpty() ? !figure.isOfMaster() : !figure.isOfNode())
        return setError(
            QPlcMasterNode::SignalError,
            nodeName.isEmpty()
                ? QStringLiteral("master: signal '%1': this figure belongs to a node; give its name").arg(signalName)
                : QStringLiteral("master: signal '%1': this figure belongs to the master; leave out '%2'")
                      .arg(signalName, nodeName));
    QPlcSignalIndex signal = QPlcInvalidSignalIndex;
    const bool claimed = figure.isDuration()
        ? claimSignal(signalName, &signal, &isSingleReal, QStringLiteral("Real"))
        : claimSignal(signalName, &signal, &isSingleNumber, QStringLiteral("Real, Int or UInt"));
    if (claimed)
        statisticSignals.add(figure, signal, nodeName);
    return claimed;
}
