// SPDX-License-Identifier: Apache-2.0
#include "StatisticsReply.h"

#include <QtCore/QJsonArray>

namespace qplc {

namespace {

QJsonObject fieldsOf(const QPlcDistribution &distribution)
{
    QJsonObject fields{{QStringLiteral("count"), double(distribution.count)},
                       {QStringLiteral("minimum"), double(distribution.minimum)},
                       {QStringLiteral("mean"), distribution.mean},
                       {QStringLiteral("p001"), double(distribution.p001)},
                       {QStringLiteral("p01"), double(distribution.p01)},
                       {QStringLiteral("p50"), double(distribution.p50)},
                       {QStringLiteral("p99"), double(distribution.p99)},
                       {QStringLiteral("p999"), double(distribution.p999)},
                       {QStringLiteral("maximum"), double(distribution.maximum)}};
    if (distribution.bins.isEmpty())
        return fields;
    QJsonArray bins;
    for (const QPlcDistribution::Bin &bin : distribution.bins)
        bins.append(QJsonArray{double(bin.upperBorder), double(bin.count)});
    fields.insert(QStringLiteral("bins"), bins);
    return fields;
}

QJsonObject fieldsOf(const QPlcDurationStatistics &duration)
{
    return {{QStringLiteral("sinceStart"), fieldsOf(duration.sinceStart)},
            {QStringLiteral("last10s"), fieldsOf(duration.last10s)}};
}

QJsonObject fieldsOf(const QPlcNodeStatistics &node)
{
    const QJsonObject counters{
        {QStringLiteral("answers"), double(node.answers)},     {QStringLiteral("late"), double(node.late)},
        {QStringLiteral("lost"), double(node.lost)},           {QStringLiteral("duplicated"), double(node.duplicated)},
        {QStringLiteral("reordered"), double(node.reordered)}, {QStringLiteral("rejected"), double(node.rejected)},
        {QStringLiteral("forged"), double(node.forged)},       {QStringLiteral("resent"), double(node.resent)},
        {QStringLiteral("nonFinite"), double(node.nonFinite)}, {QStringLiteral("outOfRange"), double(node.outOfRange)}};
    return {{QStringLiteral("name"), node.name},
            {QStringLiteral("execution"), fieldsOf(node.execution)},
            {QStringLiteral("roundTrip"), fieldsOf(node.roundTrip)},
            {QStringLiteral("slack"), fieldsOf(node.slack)},
            {QStringLiteral("counters"), counters}};
}

QJsonObject fieldsOf(const QPlcWorstCycle &cycle)
{
    QJsonArray stages;
    for (const QPlcWorstCycle::Stage &stage : cycle.stages)
        stages.append(
            QJsonObject{{QStringLiteral("name"), stage.name}, {QStringLiteral("duration"), double(stage.duration)}});
    return {{QStringLiteral("cycle"), double(cycle.cycle)},
            {QStringLiteral("skipped"), double(cycle.skipped)},
            {QStringLiteral("lateness"), double(cycle.lateness)},
            {QStringLiteral("roundTrip"), double(cycle.roundTrip)},
            {QStringLiteral("execution"), double(cycle.execution)},
            {QStringLiteral("slack"), double(cycle.slack)},
            {QStringLiteral("stages"), stages}};
}

QJsonObject masterFields(const QPlcCycleStatistics &statistics)
{
    const QJsonObject counters{{QStringLiteral("cycles"), double(statistics.cycles)},
                               {QStringLiteral("overruns"), double(statistics.overruns)},
                               {QStringLiteral("skippedCycles"), double(statistics.skippedCycles)},
                               {QStringLiteral("caughtUpCycles"), double(statistics.caughtUpCycles)},
                               {QStringLiteral("shiftedTime"), double(statistics.shiftedTime)},
                               {QStringLiteral("lateAnswers"), double(statistics.lateAnswers)},
                               {QStringLiteral("incompleteCycles"), double(statistics.incompleteCycles)},
                               {QStringLiteral("strangers"), double(statistics.strangers)},
                               {QStringLiteral("floods"), double(statistics.floods)}};
    return {{QStringLiteral("lateness"), fieldsOf(statistics.lateness)},
            {QStringLiteral("execution"), fieldsOf(statistics.execution)},
            {QStringLiteral("roundTrip"), fieldsOf(statistics.roundTrip)},
            {QStringLiteral("slack"), fieldsOf(statistics.slack)},
            {QStringLiteral("counters"), counters}};
}

}  // namespace

QJsonObject statisticsFields(const QPlcCycleStatistics &statistics)
{
    QJsonArray nodes;
    for (const QPlcNodeStatistics &node : statistics.nodes)
        nodes.append(fieldsOf(node));
    QJsonArray worst;
    for (const QPlcWorstCycle &cycle : statistics.worst)
        worst.append(fieldsOf(cycle));
    return {{QStringLiteral("master"), masterFields(statistics)},
            {QStringLiteral("nodes"), nodes},
            {QStringLiteral("worst"), worst}};
}

}  // namespace qplc
