// SPDX-License-Identifier: Apache-2.0
#include "Gates.h"

#include <algorithm>

namespace soak {

namespace {

bool stopsSafely(const History &master, qint64 begin, qint64 end)
{
    const std::vector<const Record *> states = recordsOf(master, Record::State, -1, begin, end);
    return std::any_of(states.begin(), states.end(),
                       [](const Record *state) { return state->numbers[0] == Record::SafeStop; });
}

/// A node as its master knows it.
enum class Presence { NeverSeen, There, Gone };

/// Whether no phase may begin without a node: all are in the manifest; without one, the critical
/// nodes are needed that the master has seen.
bool isNeeded(const Evidence &evidence, int node, Presence presence)
{
    return evidence.hasManifest || (isCritical(node) && presence != Presence::NeverSeen);
}

/// Each phase begins with the nodes that it needs.
void lookAtBegins(const Evidence &evidence, const History &master, Gate *gate)
{
    std::vector<Presence> nodes(std::size_t(evidence.shape.nodes), Presence::NeverSeen);
    PhaseBegins begins;
    for (const Record &record : master.records) {
        if (record.kind == Record::Registered || record.kind == Record::Lost) {
            if (record.subject < nodes.size())
                nodes[record.subject] = record.kind == Record::Registered ? Presence::There : Presence::Gone;
        }
        if (!begins.isOne(record))
            continue;
        ++gate->looked;
        for (int node = 0; node < evidence.shape.nodes; ++node) {
            const Presence presence = nodes[std::size_t(node)];
            if (presence != Presence::There && isNeeded(evidence, node, presence))
                gate->fail(QStringLiteral("%1 starts without %2").arg(master.name, nodeName(node)));
        }
    }
}

/// The operator tries to initialize and to start, and gets an answer to each.
void lookAtTries(const Evidence &evidence, const DoneFault &fault, Gate *gate)
{
    const QString name = nodeName(fault.node);
    const auto tries = recordsOf(evidence.runner, Record::Tried, fault.node, fault.begin, fault.end);
    if (tries.empty())
        gate->fail(QStringLiteral("nobody tried to start without %1").arg(name));
    for (const Record *tried : tries) {
        ++gate->looked;
        if (tried->numbers[Record::IsRefused] == 0)
            gate->fail(QStringLiteral("the plant is told to begin without %1, and obeys").arg(name));
        else if (tried->numbers[Record::IsNamed] == 0)
            gate->fail(QStringLiteral("a start without %1 is refused, and does not name it").arg(name));
    }
}

quint64 editionOf(const History &history)
{
    const auto born = std::find_if(history.records.begin(), history.records.end(),
                                   [](const Record &record) { return record.kind == Record::Born; });
    return born == history.records.end() ? 0 : born->numbers[Record::Edition];
}

/// A node takes part with the parameters of its master, and its safe values are those.
void lookAtParameters(const Evidence &evidence, const History &node, Gate *gate)
{
    const History *master = nullptr;  // of the phase
    for (const Record &record : node.records) {
        if (record.kind == Record::Phase) {
            master = evidence.masterAt(record.time);
            ++gate->looked;
            if (master && hasOwnTable(node.node) && editionOf(node) != editionOf(*master))
                gate->fail(QStringLiteral("%1 takes part at %2, whose safety parameters are other ones")
                               .arg(node.name, master->name));
        }
        if (record.kind != Record::Safe || !master)
            continue;
        const double limit = fromBits(record.numbers[Record::SafeLimitBits]);
        ++gate->looked;
        if (limit != safeLimit(editionOf(*master)))
            gate->fail(QStringLiteral("%1: its safe state has a limit of %2; that of %3 is %4")
                           .arg(node.name)
                           .arg(limit)
                           .arg(master->name)
                           .arg(safeLimit(editionOf(*master))));
    }
}

}  // namespace

Gate silentJoinersAreDropped(const Evidence &evidence)
{
    Gate gate("silent joiners are dropped");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        if (fault.kind != FaultKind::SilentJoiner || !fault.isAlone)
            continue;
        gate.isAsked = true;
        ++gate.looked;
        if (fault.amount == 0)
            gate.fail(QStringLiteral("a node that answers nothing keeps the plant from running, from %1 ms on")
                          .arg(double(fault.begin) * 1e-6));
    }
    return gate;
}

Gate safetyParametersAgree(const Evidence &evidence)
{
    Gate gate("safety parameters agree");
    gate.isAsked = std::any_of(evidence.faults.begin(), evidence.faults.end(),
                               [](const DoneFault &fault) { return fault.kind == FaultKind::OtherParameters; });
    if (!gate.isAsked)
        return gate;
    for (const History &node : evidence.nodes)
        lookAtParameters(evidence, node, &gate);
    return gate;
}

Gate startsHaveTheirNodes(const Evidence &evidence)
{
    Gate gate("starts have their nodes");
    for (const History &master : evidence.masters)
        lookAtBegins(evidence, master, &gate);
    for (const DoneFault &fault : evidence.faults) {
        if (fault.kind == FaultKind::MissingNode && fault.isAlone)
            lookAtTries(evidence, fault, &gate);
    }
    return gate;
}

Gate friendsGetIn(const Evidence &evidence)
{
    Gate gate("friends get in");
    gate.isAsked = false;
    for (const DoneFault &fault : evidence.faults) {
        const History *master = evidence.masterAt(fault.begin);
        if (fault.kind != FaultKind::Siege || !fault.isAlone || !master)
            continue;
        gate.isAsked = true;
        ++gate.looked;
        if (recordsOf(*master, Record::Registered, fault.node, fault.begin, fault.end).empty())
            gate.fail(QStringLiteral("%1 does not get in beside strangers").arg(nodeName(fault.node)));
        if (!isCritical(fault.node) && stopsSafely(*master, fault.begin, fault.end))
            gate.fail(QStringLiteral("strangers stop the plant at %1 ms").arg(double(fault.begin) * 1e-6));
    }
    return gate;
}

}  // namespace soak
