// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Host.h"

namespace qplc {

/// The computer on which the program runs: calls of its kernel.
class Machine final : public Host
{
public:
    std::int64_t now() noexcept override;
    std::int64_t slept() noexcept override;
    bool sleepUntil(std::int64_t deadline) noexcept override;
    std::int64_t wallClock() noexcept override;
    bool hasKernelTimers() const noexcept override { return true; }
    std::uint64_t random() override;
    int openWakeUp(int *error) noexcept override;
    void closeWakeUp(int descriptor) noexcept override;
    void wake(int descriptor) noexcept override;
    bool consumeWakeUp(int descriptor) noexcept override;
};

}  // namespace qplc
