// SPDX-License-Identifier: Apache-2.0
#include "MasterReplies.h"

#include "node/cycle/Roster.h"
#include "node/state/MasterStates.h"
#include "node/state/SlaveStates.h"
#include "protocol/ControlFrame.h"
#include "protocol/messages/Vocabulary.h"

#include <QtCore/QMetaEnum>

#include <utility>

namespace qplc {

namespace {

constexpr std::size_t shortestLink = 58;  // [byte] {"age":0,"from":"","sameCycle":true,"signal":"a","to":"b"}

/// All of \a names are looked at before an answer is made: a short question that names one signal
/// again and again would have an endless one.
bool readNames(const QPlcSignalTable &table, const QStringList &names, std::vector<QPlcSignalIndex> *wanted,
               Refusal *refusal)
{
    if (names.size() > table.size()) {
        *refusal = {messages::errorWord::malformedMessage,
                    QStringLiteral("%1 names are wanted, and the table has %2 signals; name each signal once")
                        .arg(names.size())
                        .arg(table.size())};
        return false;
    }
    std::vector<bool> isWanted(std::size_t(table.size()));
    for (const QString &name : names) {
        const QPlcSignalIndex index = table.indexOf(name);
        if (index == QPlcInvalidSignalIndex)
            *refusal = {messages::errorWord::unknownSignal, table.unknownSignalText(name)};
        else if (isWanted[index])
            *refusal = {messages::errorWord::malformedMessage,
                        QStringLiteral("'%1' is named twice; name each signal once").arg(name)};
        if (!refusal->error.isEmpty())
            return false;
        isWanted[index] = true;
        wanted->push_back(index);
    }
    return true;
}

}  // namespace

QPlcNodeInfo infoOf(const NodeSession &node)
{
    const NodeSlot &slot = *node.slot();
    QPlcNodeInfo info;
    info.name = slot.name;
    info.id = slot.id;
    info.policy
        = QString::fromLatin1(QMetaEnum::fromType<QPlcSlaveNode::RealTimeViolationPolicy>().valueToKey(slot.policy));
    info.listener = slot.listener;
    info.critical = slot.critical;
    info.state = QString::fromLatin1(nameOf(node.state()));
    info.every = slot.interval.cycles();
    info.inputs = int(slot.inputLayout.fields().size());
    info.outputs = int(slot.outputLayout.fields().size());
    info.lateAnswers = slot.statistics.late;
    info.duplicates = slot.statistics.duplicated + slot.statistics.reordered;
    info.rejected = slot.statistics.rejected;
    info.forged = slot.statistics.forged;
    info.resent = slot.statistics.resent;
    info.faultPlan = slot.faultPlan;
    info.transport = node.transportName();
    info.fallback = node.usesFallback();
    info.address = node.address();
    info.watchdog = slot.watchdog;
    info.identity = node.identity();
    return info;
}

messages::MasterState messageStateOf(QPlcMasterNode::State state)
{
    const QString name = QLatin1String(nameOf(state));
    return messages::valueNamed<messages::MasterState>(name).value_or(messages::MasterState::Unknown);
}

bool isLatched(QPlcMasterNode::State state)
{
    return messages::isLatched(messageStateOf(state));
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
    case QPlcClock::External:
        return messages::ClockKind::External;
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
    reply.missing = master.missingNodes();
    reply.armed = master.isArmed();
    reply.armingRequired = master.isArmingRequired();
    reply.cycle = master.cycle();
    reply.period = master.interval();
    reply.clock = clockKindOf(master.clock());
    reply.scale = master.clock().scale();
    reply.profile = QPlcProfile::name(profile.value);
    reply.profileReason = profile.reason;
    reply.session = session;
    reply.nodes = master.nodes();
    reply.counters = messages::countersOf(statistics);
    reply.digest = statistics.imageDigest;
    reply.faults = master.faultPlan();
    return reply;
}

messages::Events eventReply(const std::vector<JournalEvent> &events)
{
    messages::Events reply;
    for (const JournalEvent &event : events)
        reply.events.push_back(toEntry(event));
    return reply;
}

static messages::SignalEntry entryOf(QPlcSignalIndex index, const std::vector<char> &values, const MasterCycle &cycle,
                                     const NodeRegistry &registry, const Leases &leases)
{
    const QPlcSignalDefinition &definition = cycle.table().at(index);
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
        entry.lease = lease->state();
    }
    return entry;
}

std::unique_ptr<messages::ListAnswer> signalReply(const MasterCycle &cycle, const NodeRegistry &registry,
                                                  const Leases &leases, const QStringList &names, Refusal *refusal)
{
    std::vector<QPlcSignalIndex> wanted;
    if (!readNames(cycle.table(), names, &wanted, refusal))
        return nullptr;
    const std::size_t count = names.isEmpty() ? std::size_t(cycle.table().size()) : wanted.size();
    const auto entry = [&, wanted, values = cycle.values()](std::size_t i) {
        return entryOf(wanted.empty() ? QPlcSignalIndex(i) : wanted[i], values, cycle, registry, leases);
    };
    return messages::makeListAnswer(messages::Signals(), &messages::Signals::signals, count, entry,
                                    QStringLiteral("too many signals for one answer; ask for some of them by name"));
}

/// Listeners may read each signal of a large table again: what cannot fit is not even made.
std::unique_ptr<messages::ListAnswer> scheduleReply(const NodeRegistry &registry, const QPlcSignalTable &table,
                                                    Refusal *refusal)
{
    std::size_t links = 0;
    for (const std::shared_ptr<NodeSlot> &slot : registry.nodes())
        links += slot->isThere() ? slot->inputLayout.fields().size() : 0;
    const QString tooLong = QStringLiteral("the schedule has %1 links, too many for one answer; the program of the "
                                           "master has it: QPlcMasterNode::schedule()")
                                .arg(links);
    if (links > UsualControlFrame / shortestLink) {
        *refusal = {messages::errorWord::tooLong, tooLong};
        return nullptr;
    }
    messages::Schedule schedule{describeSchedule(registry, table)};
    const QVector<QPlcSchedule::Link> made = std::exchange(schedule.links, {});
    return messages::makeListAnswer(
        schedule, &messages::Schedule::links, std::size_t(made.size()), [made](std::size_t i) { return made[int(i)]; },
        tooLong);
}

}  // namespace qplc
