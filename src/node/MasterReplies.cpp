// SPDX-License-Identifier: Apache-2.0
#include "MasterReplies.h"

#include "MasterStates.h"
#include "QPlcMessage.h"

#include <QtCore/QJsonArray>

namespace qplc {

namespace {

QJsonObject nodeFields(const QPlcNodeInfo &node)
{
    QJsonObject fields{{QStringLiteral("name"), node.name},
                       {QStringLiteral("id"), node.id},
                       {QStringLiteral("inputs"), node.inputs},
                       {QStringLiteral("outputs"), node.outputs},
                       {QStringLiteral("listener"), node.listener},
                       {QStringLiteral("critical"), node.critical},
                       {QStringLiteral("state"), node.state},
                       {QStringLiteral("every"), node.every},
                       {QStringLiteral("policy"), node.policy},
                       {QStringLiteral("transport"), node.transport},
                       {QStringLiteral("address"), node.address},
                       {QStringLiteral("lateAnswers"), double(node.lateAnswers)},
                       {QStringLiteral("duplicates"), double(node.duplicates)},
                       {QStringLiteral("rejected"), double(node.rejected)},
                       {QStringLiteral("forged"), double(node.forged)},
                       {QStringLiteral("resent"), double(node.resent)}};
    if (!node.faultPlan.isEmpty())
        fields.insert(QStringLiteral("faults"), node.faultPlan);
    return fields;
}

QJsonObject counterFields(const QPlcMasterStatistics &statistics)
{
    return {{QStringLiteral("cycles"), double(statistics.cycles)},
            {QStringLiteral("overruns"), double(statistics.overruns)},
            {QStringLiteral("skippedCycles"), double(statistics.skippedCycles)},
            {QStringLiteral("lateAnswers"), double(statistics.lateAnswers)},
            {QStringLiteral("strangers"), double(statistics.strangers)},
            {QStringLiteral("floods"), double(statistics.floods)},
            {QStringLiteral("refusedConnections"), double(statistics.refusedConnections)},
            {QStringLiteral("failedHandshakes"), double(statistics.failedHandshakes)},
            {QStringLiteral("deniedMessages"), double(statistics.deniedMessages)}};
}

}  // namespace

QString clockName(QPlcClock clock)
{
    switch (clock.kind()) {
    case QPlcClock::RealTime:
        return QStringLiteral("RealTime");
    case QPlcClock::Scaled:
        return QStringLiteral("Scaled");
    case QPlcClock::Lockstep:
        return QStringLiteral("Lockstep");
    }
    return {};
}

QJsonObject stateFields(const QPlcMasterNode &master, quint64 session)
{
    QJsonArray nodes;
    const QVector<QPlcNodeInfo> infos = master.nodes();
    for (const QPlcNodeInfo &node : infos)
        nodes.append(nodeFields(node));
    const QPlcMasterStatistics statistics = master.statistics();
    QJsonObject fields{{QStringLiteral("state"), QLatin1String(nameOf(master.state()))},
                       {QStringLiteral("reason"), master.stateReason()},
                       {QStringLiteral("remains"), master.causeThatRemains()},
                       {QStringLiteral("armed"), master.isArmed()},
                       {QStringLiteral("armingRequired"), master.isArmingRequired()},
                       {QStringLiteral("cycle"), QPlcMessage::fromHex64(master.cycle())},
                       {QStringLiteral("period"), double(master.interval().count())},
                       {QStringLiteral("clock"), clockName(master.clock())},
                       {QStringLiteral("scale"), master.clock().scale()},
                       {QStringLiteral("session"), QPlcMessage::fromHex64(session)},
                       {QStringLiteral("nodes"), nodes},
                       {QStringLiteral("counters"), counterFields(statistics)},
                       {QStringLiteral("digest"), QPlcMessage::fromHex64(statistics.imageDigest)}};
    if (!master.faultPlan().isEmpty())
        fields.insert(QStringLiteral("faults"), master.faultPlan());
    return fields;
}

QJsonObject scheduleFields(const QPlcSchedule &schedule)
{
    QJsonArray stages;
    for (const QVector<QPlcSchedule::Turn> &stage : schedule.stages) {
        QJsonArray turns;
        for (const QPlcSchedule::Turn &turn : stage)
            turns.append(QJsonObject{{QStringLiteral("node"), turn.node},
                                     {QStringLiteral("phase"), QPlcSchedule::phaseName(turn.phase)}});
        stages.append(turns);
    }
    QJsonArray links;
    for (const QPlcSchedule::Link &link : schedule.links)
        links.append(QJsonObject{{QStringLiteral("signal"), link.signal},
                                 {QStringLiteral("from"), link.from},
                                 {QStringLiteral("to"), link.to},
                                 {QStringLiteral("age"), link.age},
                                 {QStringLiteral("sameCycle"), link.sameCycle}});
    return {{QStringLiteral("stages"), stages}, {QStringLiteral("links"), links}};
}

QJsonObject eventFields(const std::vector<JournalEvent> &events)
{
    QJsonArray array;
    for (const JournalEvent &event : events) {
        QJsonObject fields{{QStringLiteral("sequence"), double(event.sequence)},
                           {QStringLiteral("time"), QPlcMessage::fromHex64(quint64(event.time))},
                           {QStringLiteral("severity"), severityName(event.severity)},
                           {QStringLiteral("kind"), kindName(event.kind)},
                           {QStringLiteral("source"), event.source},
                           {QStringLiteral("text"), event.text}};
        if (!event.alarm.isEmpty()) {
            fields.insert(QStringLiteral("alarm"), event.alarm);
            fields.insert(QStringLiteral("active"), event.isActive);
        }
        array.append(fields);
    }
    return {{QStringLiteral("events"), array}};
}

bool signalFields(const MasterCycle &cycle, const NodeRegistry &registry, const Leases &leases,
                  const QStringList &names, QJsonObject *fields, QString *error)
{
    const QPlcSignalTable &table = cycle.table();
    const std::vector<char> values = cycle.values();
    QStringList wanted = names;
    if (wanted.isEmpty()) {
        for (const QPlcSignalDefinition &definition : table)
            wanted << definition.name;
    }
    QJsonArray signalArray;
    for (const QString &name : qAsConst(wanted)) {
        const QPlcSignalIndex index = table.indexOf(name);
        if (index == QPlcInvalidSignalIndex) {
            *error = table.unknownSignalText(name);
            return false;
        }
        const QPlcSignalDefinition &definition = table.at(index);
        QJsonObject signal{{QStringLiteral("name"), name},
                           {QStringLiteral("type"), definition.type.name()},
                           {QStringLiteral("unit"), definition.unit},
                           {QStringLiteral("description"), definition.description},
                           {QStringLiteral("value"),
                            QPlcValue::fromBytes(definition.type, values.data() + cycle.offset(index)).toString()},
                           {QStringLiteral("writer"), registry.writer(index)},
                           {QStringLiteral("quality"), quint8(values[cycle.qualityOffset(index)])}};
        if (definition.writers.size() > 1) {
            const std::shared_ptr<NodeSlot> source = registry.find(cycle.signalGuard().source(index));
            signal.insert(QStringLiteral("source"), source ? source->name : QString());
        }
        if (const Leases::Lease *lease = leases.find(index)) {
            signal.insert(QStringLiteral("holder"), lease->name);
            signal.insert(QStringLiteral("lease"), lease->stateName());
        }
        signalArray.append(signal);
    }
    fields->insert(QStringLiteral("signals"), signalArray);
    return true;
}

}  // namespace qplc
