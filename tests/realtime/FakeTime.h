// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "realtime/TimeSource.h"

#include <algorithm>
#include <cstdint>
#include <utility>

/// A clock that a test moves: a sleep ends at its deadline, later by `overshoot`, or before it when
/// it is interrupted.
class FakeTime : public qplc::TimeSource
{
public:
    std::int64_t now() noexcept override
    {
        ++looks;
        return time;
    }

    bool sleepUntil(std::int64_t deadline) noexcept override
    {
        ++sleeps;
        longestSleep = std::max(longestSleep, deadline - time);
        if (interruptions > 0) {
            --interruptions;
            time += (deadline - time) / 3;
            return false;
        }
        time = std::max(time, deadline);
        if (time >= target)
            time += std::exchange(overshoot, 0);
        return true;
    }

    std::int64_t time = 0;            ///< [ns]
    std::int64_t overshoot = 0;       ///< [ns] by which the sleep that reaches the target ends too late, once
    std::int64_t target = INT64_MIN;  ///< [ns] see overshoot
    int interruptions = 0;            ///< sleeps that will be interrupted
    int sleeps = 0;
    int looks = 0;
    std::int64_t longestSleep = 0;  ///< [ns] that was asked for
};
