// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCycleStatistics.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"
#include "protocol/messages/ListAnswer.h"
#include "protocol/messages/Statistics.h"

#include <memory>

namespace qplc {

/// The statistics of a master and of all nodes whose cyclic channel is there; also while cycles
/// run.
QPlcCycleStatistics statisticsOf(const MasterCycle &cycle, const NodeRegistry &registry,
                                 QPlcDistribution::Detail detail);
/// What a master answers to GetStatistics. \a cycle outlives it.
std::unique_ptr<messages::ListAnswer> statisticsReply(const MasterCycle &cycle, const NodeRegistry &registry,
                                                      QPlcDistribution::Detail detail);

}  // namespace qplc
