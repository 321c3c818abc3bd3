// SPDX-License-Identifier: Apache-2.0
#include "InitialValues.h"

#include <algorithm>
#include <iterator>

namespace qplc {

InitialValues::InitialValues(MasterCycle &cycle, const NodeRegistry &registry, const Leases &leases,
                             StatisticSignals &statistics)
    : m_cycle(cycle)
    , m_registry(registry)
    , m_leases(leases)
    , m_statistics(statistics)
{
}

void InitialValues::forget(std::int64_t usualHold)
{
    m_cycle.forgetOutputs(usualHold);
    m_statistics.reset(&m_cycle);
}

QString InitialValues::faultOf(const NodeSlot &slot, const QByteArray &outputs) const
{
    for (const SignalGuard::Frame::Field &field : slot.outputs.fields) {
        const ValueFault fault = slot.outputs.fault(field, outputs.constData());
        const QPlcSignalDefinition &signal = m_cycle.table().at(QPlcSignalIndex(field.place));
        if (fault)
            return QStringLiteral("the initial value of signal '%1': %2").arg(signal.name, faultText(signal, fault));
    }
    return {};
}

bool InitialValues::hasSize(NodeSession &node, const QByteArray &outputs) const
{
    const auto size = node.slot()->outputLayout.size();
    if (outputs.size() == int(size))
        return true;
    node.drop(QStringLiteral("it sent %1 bytes of initial outputs instead of %2").arg(outputs.size()).arg(size));
    return false;
}

void InitialValues::store(NodeSlot &slot, const QByteArray &outputs)
{
    m_cycle.storeInitialOutputs(slot, outputs.constData(), m_leases.mask());
}

void InitialValues::allTaken()
{
    Roster roster;
    std::copy_if(m_registry.nodes().begin(), m_registry.nodes().end(), std::back_inserter(roster.nodes),
                 [](const std::shared_ptr<NodeSlot> &slot) { return slot->isThere(); });
    roster.held = m_leases.mask();
    m_cycle.initialOutputsTaken(roster);
}

QByteArray InitialValues::inputsFor(NodeSlot &slot) const
{
    const bool isRecorded = !m_recorded.isEmpty() && std::uint32_t(m_recorded.size()) == slot.inputLayout.size();
    const QByteArray inputs = isRecorded ? m_recorded : m_cycle.gather(slot.inputRuns, slot.inputLayout.size());
    slot.initialInputs.assign(inputs.begin(), inputs.end());
    return inputs;
}

}  // namespace qplc
