// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recording/RecordedCycles.h"
#include "recording/RecordedPhases.h"

#include <optional>

namespace qplc {

/// What a recording says of a node from its registration to its end: what it was, with what it
/// began, and which cycles it has computed.
struct NodePassage
{
    RosterNode node;
    std::optional<RecordedStart> start;  // none: it has begun before the recording
    std::uint64_t first = 0;             // cycle
    std::vector<bool> computed;          // from the cycle `first` on
    std::uint64_t lostAtFirst = 0;       // requests before the first one that it has computed
    /// From here on the inputs of some cycle are missing, or the master stops safely.
    std::optional<std::uint64_t> end;
    QString endReason;

    bool hasComputed(std::uint64_t cycle) const
    {
        return cycle >= first && cycle - first < computed.size() && computed[std::size_t(cycle - first)];
    }
    /// Number of cycles that it has computed, until `end`.
    std::uint64_t count() const;
};

/// Reads the passages of the node \a name: each registration makes one, in their order, but
/// for those of a node that goes on after it has lost its connection.
/// \return false when the recording cannot be read, or does not know such a node
bool readPassages(const RecordedPhase &phase, const QString &name, std::vector<NodePassage> *passages, QString *error);

}  // namespace qplc
