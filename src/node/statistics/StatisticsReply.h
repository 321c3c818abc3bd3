// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCycleStatistics.h"
#include "protocol/messages/Statistics.h"

namespace qplc {

/// What a master answers to GetStatistics.
messages::Statistics statisticsReply(const QPlcCycleStatistics &statistics);

}  // namespace qplc
