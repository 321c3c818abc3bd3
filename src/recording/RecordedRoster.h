// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RosterText.h"

namespace qplc {

/// Reads a message of the channel /rosters.
/// \param signalCount  of the table: all indices are less
/// \return false when it is not such a message, or its roster was too long for the ring
bool readRoster(const QByteArray &message, int signalCount, RosterContent *content);

}  // namespace qplc
