// SPDX-License-Identifier: Apache-2.0
#include "StartMessages.h"

#include "MasterReplies.h"

namespace qplc {

StartMessages::StartMessages(const PhaseSettings &settings, const PhaseProfile &profile, const PhaseCycles &cycles,
                             const CyclicHub &hub, quint64 session)
    : m_settings(settings)
    , m_profile(profile)
    , m_cycles(cycles)
    , m_hub(hub)
    , m_session(session)
{
}

void StartMessages::place(const NodeSessions::List &nodes)
{
    for (const auto &node : nodes) {
        if (node->slot()->isInGroup())
            m_parts.add(*node->slot());
    }
    m_parts.finish();
}

messages::RealTimeStarted StartMessages::begin(const NodeSession &node) const
{
    messages::RealTimeStarted message;
    message.period = m_settings.interval;
    message.clock = clockKindOf(m_settings.clock);
    message.scale = m_settings.clock.scale();
    message.profile = QPlcProfile::name(m_profile.fixed().value);
    message.cycleZero = m_cycles.cycleZero();
    message.firstCycle = m_cycles.cycleZero() + (m_cycles.isRunning() ? m_cycles.cycle() : 0);
    NodeSlot &slot = *node.slot();
    slot.sentCycles.restart(message.firstCycle);
    if (!slot.multicast)
        return message;
    slot.multicast->sentCycles.restart(message.firstCycle);
    message.group = messages::GroupPlace{int(slot.multicast->number), int(slot.multicastOffset),
                                         int(slot.multicast->payloadSize), slot.multicast->hash};
    return message;
}

}  // namespace qplc
