// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/NodeRegistry.h"
#include "node/cycle/ProfileDefaults.h"
#include "node/statistics/Journal.h"

#include <functional>

namespace qplc {

/// The profile of a master: chosen by the facts when a phase begins, and kept until it ends.
class PhaseProfile
{
public:
    /// \param facts  as they are now
    PhaseProfile(Journal &journal, std::function<ProfileFacts()> facts);

    /// The phase at hand has the profile that the facts give now; the journal tells a new one.
    void fix();
    /// The one that was fixed last.
    const ChosenProfile &fixed() const { return m_fixed; }
    const ProfileDefaults &defaults() const { return ProfileDefaults::of(m_fixed.value); }
    /// The one that a phase would get now.
    ChosenProfile choice() const { return chooseProfile(m_facts()); }
    /// Why \a node cannot come into a phase with this profile: real devices take no part where late
    /// and lost values are forgiven. No error: it can.
    Refusal objectionTo(const NodeDeclaration &node) const;

private:
    Journal &m_journal;
    const std::function<ProfileFacts()> m_facts;
    ChosenProfile m_fixed;
};

}  // namespace qplc
