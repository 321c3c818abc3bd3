// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Leases.h"
#include "NodeSession.h"
#include "QPlcMasterNode.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"
#include "node/cycle/ProfileDefaults.h"
#include "node/statistics/EventLog.h"
#include "protocol/messages/ListAnswer.h"
#include "protocol/messages/MessageTable.h"

#include <memory>

namespace qplc {

/// What a master answers to those who ask: reading only.

QPlcNodeInfo infoOf(const NodeSession &node);
messages::MasterState messageStateOf(QPlcMasterNode::State state);
/// Whether only a reset leads on.
bool isLatched(QPlcMasterNode::State state);
messages::ClockKind clockKindOf(QPlcClock clock);
messages::State stateReply(const QPlcMasterNode &master, const ChosenProfile &profile, quint64 session);
/// For \a names or, when empty, all signals; the values are those of one cycle. All other arguments
/// outlive the answer.
/// \return null with the first name that is unknown, or comes twice, in \a refusal
std::unique_ptr<messages::ListAnswer> signalReply(const MasterCycle &cycle, const NodeRegistry &registry,
                                                  const Leases &leases, const QStringList &names, Refusal *refusal);
/// \return null, with \a refusal, if it has too many links for one answer
std::unique_ptr<messages::ListAnswer> scheduleReply(const NodeRegistry &registry, const QPlcSignalTable &table,
                                                    Refusal *refusal);
messages::Events eventReply(const std::vector<JournalEvent> &events);

}  // namespace qplc
