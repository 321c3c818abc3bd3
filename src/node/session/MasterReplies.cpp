// SPDX-License-Identifier: Apache-2.0
#include "MasterReplies.h"

#include "QPlcMessage.h"
#include "node/state/MasterStates.h"

#include <QtCore/QJsonArray>

#include <numeric>

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

/// All of \a names are looked at before an answer is made: a short question that names one signal again and again would have an endless one.
bool readNames(const QPlcSignalTable &table, const QStringList &names, std::vector<QPlcSignalIndex> *wanted,
               Refusal *refusal)
{
    if (names.size() > table.size()) {
        *refusal = {QStringLiteral("MalformedMessage"),
                    QStringLiteral("%1 names are wanted, and the table has %2 signals; name each signal once")
                        .arg(names.size())
                        .arg(table.size())};
        return false;
    }
    std::vector<bool> isWanted(std::size_t(table.size()));
    for (const QString &name : names) {
        const QPlcSignalIndex index = table.indexOf(name);
        if (index == QPlcInvalidSignalIndex)
            *refusal = {QStringLiteral("UnknownSignal"), table.unknownSignalText(name)};
        else if (isWanted[index])
            *refusal = {QStringLiteral("MalformedMessage"),
                        QStringLiteral("'%1' is named twice; name each signal once").arg(name)};
        if (!refusal->error.isEmpty())
            return false;
        isWanted[index] = true;
        wanted->push_back(index);
    }
    return true;
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

QJsonObject stateFields(const QPlcMasterNode &master, const ChosenProfile &profile, quint64 session)
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
                       {QStringLiteral("profile"), QPlcProfile::name(profile.value)},
                       {QStringLiteral("profileReason"), profile.reason},
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
                  const QStringList &names, QJsonObject *fields, Refusal *refusal)
{
    const QPlcSignalTable &table = cycle.table();
    std::vector<QPlcSignalIndex> wanted;
    if (!readNames(table, names, &wanted, refusal))
        return false;
    if (names.isEmpty()) {
        wanted.resize(std::size_t(table.size()));
        std::iota(wanted.begin(), wanted.end(), QPlcSignalIndex(0));
    }
    const std::vector<char> values = cycle.values();
    QJsonArray signalArray;
    for (const QPlcSignalIndex index : wanted) {
        const QPlcSignalDefinition &definition = table.at(index);
        QJsonObject signal{{QStringLiteral("name"), definition.name},
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
