// SPDX-License-Identifier: Apache-2.0
#include "MasterReplies.h"

#include "node/state/MasterStates.h"

#include <numeric>

namespace qplc {

namespace {

messages::NodeEntry entryOf(const QPlcNodeInfo &node)
{
    messages::NodeEntry entry;
    entry.name = node.name;
    entry.id = quint16(node.id);
    entry.inputs = node.inputs;
    entry.outputs = node.outputs;
    entry.listener = node.listener;
    entry.critical = node.critical;
    entry.state = node.state;
    entry.every = node.every;
    entry.policy = node.policy;
    entry.transport = node.transport;
    entry.address = node.address;
    entry.lateAnswers = node.lateAnswers;
    entry.duplicates = node.duplicates;
    entry.rejected = node.rejected;
    entry.forged = node.forged;
    entry.resent = node.resent;
    entry.faults = node.faultPlan;
    return entry;
}

/// Counters go by their names: another version may have more of them.
QMap<QString, quint64> countersOf(const QPlcMasterStatistics &statistics)
{
    return {{QStringLiteral("cycles"), statistics.cycles},
            {QStringLiteral("overruns"), statistics.overruns},
            {QStringLiteral("skippedCycles"), statistics.skippedCycles},
            {QStringLiteral("lateAnswers"), statistics.lateAnswers},
            {QStringLiteral("strangers"), statistics.strangers},
            {QStringLiteral("floods"), statistics.floods},
            {QStringLiteral("refusedConnections"), statistics.refusedConnections},
            {QStringLiteral("failedHandshakes"), statistics.failedHandshakes},
            {QStringLiteral("deniedMessages"), statistics.deniedMessages}};
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

messages::MasterState messageStateOf(QPlcMasterNode::State state)
{
    const QString name = QLatin1String(nameOf(state));
    return messages::valueNamed<messages::MasterState>(name).value_or(messages::MasterState::Unknown);
}

messages::ClockKind clockKindOf(QPlcClock clock)
{
    switch (clock.kind()) {
    case QPlcClock::RealTime:
        return messages::ClockKind::RealTime;
    case QPlcClock::Scaled:
        return messages::ClockKind::Scaled;
    case QPlcClock::Lockstep:
        return messages::ClockKind::Lockstep;
    }
    return messages::ClockKind::RealTime;
}

messages::State stateReply(const QPlcMasterNode &master, const ChosenProfile &profile, quint64 session)
{
    const QPlcMasterStatistics statistics = master.statistics();
    messages::State reply;
    reply.state = messageStateOf(master.state());
    reply.reason = master.stateReason();
    reply.remains = master.causeThatRemains();
    reply.armed = master.isArmed();
    reply.armingRequired = master.isArmingRequired();
    reply.cycle = master.cycle();
    reply.period = master.interval();
    reply.clock = clockKindOf(master.clock());
    reply.scale = master.clock().scale();
    reply.profile = QPlcProfile::name(profile.value);
    reply.profileReason = profile.reason;
    reply.session = session;
    const QVector<QPlcNodeInfo> nodes = master.nodes();
    for (const QPlcNodeInfo &node : nodes)
        reply.nodes.push_back(entryOf(node));
    reply.counters = countersOf(statistics);
    reply.digest = statistics.imageDigest;
    reply.faults = master.faultPlan();
    return reply;
}

messages::Schedule scheduleReply(const QPlcSchedule &schedule)
{
    messages::Schedule reply;
    for (const QVector<QPlcSchedule::Turn> &stage : schedule.stages) {
        std::vector<messages::TurnEntry> turns;
        for (const QPlcSchedule::Turn &turn : stage)
            turns.push_back({turn.node, QPlcSchedule::phaseName(turn.phase)});
        reply.stages.push_back(turns);
    }
    for (const QPlcSchedule::Link &link : schedule.links)
        reply.links.push_back({link.signal, link.from, link.to, link.age, link.sameCycle});
    return reply;
}

messages::Events eventReply(const std::vector<JournalEvent> &events)
{
    messages::Events reply;
    for (const JournalEvent &event : events) {
        messages::EventEntry entry;
        entry.sequence = event.sequence;
        entry.time = quint64(event.time);
        entry.severity = severityName(event.severity);
        entry.kind = kindName(event.kind);
        entry.source = event.source;
        entry.text = event.text;
        entry.alarm = event.alarm;
        if (!event.alarm.isEmpty())
            entry.active = event.isActive;
        reply.events.push_back(entry);
    }
    return reply;
}

bool signalReply(const MasterCycle &cycle, const NodeRegistry &registry, const Leases &leases, const QStringList &names,
                 messages::Signals *reply, Refusal *refusal)
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
    for (const QPlcSignalIndex index : wanted) {
        const QPlcSignalDefinition &definition = table.at(index);
        messages::SignalEntry entry;
        entry.name = definition.name;
        entry.type = definition.type.name();
        entry.unit = definition.unit;
        entry.description = definition.description;
        entry.value = QPlcValue::fromBytes(definition.type, values.data() + cycle.offset(index)).toString();
        entry.writer = registry.writer(index);
        entry.quality = quint8(values[cycle.qualityOffset(index)]);
        if (definition.writers.size() > 1) {
            const std::shared_ptr<NodeSlot> source = registry.find(cycle.signalGuard().source(index));
            entry.source = source ? source->name : QString();
        }
        if (const Leases::Lease *lease = leases.find(index)) {
            entry.holder = lease->name;
            entry.lease = lease->stateName();
        }
        reply->signals.push_back(entry);
    }
    return true;
}

}  // namespace qplc
