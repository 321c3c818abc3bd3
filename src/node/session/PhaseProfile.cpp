// SPDX-License-Identifier: Apache-2.0
#include "PhaseProfile.h"
#include "protocol/messages/Vocabulary.h"

namespace qplc {

PhaseProfile::PhaseProfile(Journal &journal, std::function<ProfileFacts()> facts)
    : m_journal(journal)
    , m_facts(std::move(facts))
{
}

void PhaseProfile::fix()
{
    const ChosenProfile chosen = choice();
    const bool isNew = !(chosen == m_fixed);
    m_fixed = chosen;
    if (isNew)
        m_journal.tell(JournalEvent::Info, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("profile %1: %2").arg(QPlcProfile::name(chosen.value), chosen.reason));
}

Refusal PhaseProfile::objectionTo(const NodeDeclaration &node) const
{
    if (!node.hardware || m_fixed.value != QPlcProfile::Simulation)
        return {};
    return {messages::errorWord::profileMismatch,
            QStringLiteral("node '%1' drives real devices, and the phase at hand has the profile Simulation (%2); stop "
                           "it and start again with this node")
                .arg(node.name, m_fixed.reason)};
}

}  // namespace qplc
