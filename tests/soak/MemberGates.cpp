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

/// Each phase begins with all nodes.
void lookAtBegins(const Evidence &evidence, const History &master, Gate *gate)
{
    std::vector<bool> isThere(std::size_t(evidence.shape.nodes));
    quint64 state = Record::Off;
    for (const Record &record : master.records) {
        if (record.kind == Record::Registered || record.kind == Record::Lost) {
            if (record.subject < isThere.size())
                isThere[record.subject] = record.kind == Record::Registered;
        }
        if (record.kind != Record::State)
            continue;
        const bool begins = record.numbers[0] == Record::RealTime && state != Record::WaitingForLateSlaves;
        state = record.numbers[0];
        if (!begins)
            continue;
        ++gate->looked;
        const auto missing = std::find(isThere.begin(), isThere.end(), false);
        if (missing != isThere.end())
            gate->fail(
                QStringLiteral("%1 starts without %2").arg(master.name, nodeName(int(missing - isThere.begin()))));
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

}  // namespace

Gate startsNeedAllNodes(const Evidence &evidence)
{
    Gate gate("starts need all nodes");
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
