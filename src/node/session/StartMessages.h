// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSessions.h"
#include "PhaseCycles.h"
#include "PhaseProfile.h"
#include "PhaseSettings.h"

namespace qplc {

/// What nodes are told when a phase begins for them, and their places in frames that go to several
/// nodes.
class StartMessages
{
public:
    StartMessages(const PhaseSettings &settings, const PhaseProfile &profile, const PhaseCycles &cycles,
                  const CyclicHub &hub, quint64 session);

    /// A phase begins: all places are forgotten.
    void restart() { m_parts.restart(m_session, m_hub); }
    /// Gives \a nodes places of their own: those that know theirs keep them.
    void place(const NodeSessions::List &nodes);
    /// What \a node is told; its cycles count from here on.
    messages::RealTimeStarted begin(const NodeSession &node) const;

private:
    const PhaseSettings &m_settings;
    const PhaseProfile &m_profile;
    const PhaseCycles &m_cycles;
    const CyclicHub &m_hub;
    const quint64 m_session;
    MulticastParts m_parts;
};

}  // namespace qplc
