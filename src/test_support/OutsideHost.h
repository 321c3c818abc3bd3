// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Simulator.h"
#include "realtime/Host.h"

namespace qplc {

/// Where a scenario is while it is on no SimulatedHost: it has time, but no network and no cycles.
/// The program ends, with a sentence, if a master, a node or a tool is used there.
class OutsideHost final : public Host
{
public:
    explicit OutsideHost(Simulator &simulator)
        : m_simulator(simulator)
        , m_random(simulator.seed())
    {
    }

    std::int64_t now() noexcept override { return m_simulator.now(); }
    std::int64_t slept() noexcept override { return 0; }
    bool sleepUntil(std::int64_t) noexcept override { return true; }
    std::int64_t wallClock() noexcept override { return now(); }
    bool hasKernelTimers() const noexcept override { return false; }
    bool hasThreads() const noexcept override { return false; }
    std::uint64_t random() override { return m_random.next(); }
    int openWakeUp(int *error) noexcept override
    {
        *error = 0;
        return m_simulator.openDescriptor(nullptr);
    }
    void closeWakeUp(int descriptor) noexcept override { m_simulator.closeDescriptor(descriptor); }
    void wake(int descriptor) noexcept override { m_simulator.setReadable(descriptor, true); }
    bool consumeWakeUp(int descriptor) noexcept override { return m_simulator.consumeReadable(descriptor); }
    std::unique_ptr<Strand> makeStrand() override;
    ControlNetwork *controlNetwork() noexcept override;

private:
    Simulator &m_simulator;
    SeededRandom m_random;
};

}  // namespace qplc
