// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcClock.h"
#include "QPlcOverrunPolicy.h"
#include "QPlcProfile.h"
#include "QPlcRealTimeOptions.h"

#include <chrono>
#include <optional>

namespace qplc {

/// What the program has set for the phases of a master; each phase takes it as it is at its start.
struct PhaseSettings
{
    std::chrono::nanoseconds interval{10'000'000};
    QPlcClock clock;
    QPlcOverrunPolicy overrunPolicy;
    QPlcRealTimeOptions realTimeOptions;
    quint64 cycleLimit = 0;
    quint64 cyclesWanted = 0;  // in the next phase, or the one at hand; 0: cycleLimit
    QPlcProfile::Value profile = QPlcProfile::Automatic;
    std::optional<std::chrono::nanoseconds> longestWait;  // else as the profile says
    std::optional<std::chrono::nanoseconds> gapLimit;     // likewise
    int overrunLimit = 0;
    bool hasRing = true;  // cycles can be recorded
};

}  // namespace qplc
