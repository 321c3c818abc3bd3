// SPDX-License-Identifier: Apache-2.0
#include "NodeSession.h"

namespace qplc {

NodeSession::NodeSession(std::shared_ptr<NodeSlot> slot, Answers answers)
    : m_slot(std::move(slot))
    , m_answers(answers)
{
}

NodeSession::~NodeSession() = default;

bool NodeSession::owes(QPlcMessage::Kind kind) const
{
    return (m_stage == GivingOutputs && kind == QPlcMessage::ReceiveMyInitialOutputStates)
        || (m_stage == Initializing && kind == QPlcMessage::Initialized)
        || (m_stage == Starting && kind == QPlcMessage::RealTimeReady);
}

}  // namespace qplc
