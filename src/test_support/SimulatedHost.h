// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Simulator.h"
#include "realtime/Host.h"
#include "signals/ProgramScope.h"

#include <QtNetwork/QHostAddress>

#include <functional>
#include <memory>
#include <vector>

namespace qplc {

class Fiber;

/// A computer of the simulator with one program on it: a master, a node or a tool.
///
/// \code
/// SimulatedHost host(simulator, "winch", QHostAddress("10.0.0.2"));
/// host.start([] { return std::make_shared<Winch>(); });
/// host.kill();   // its objects end, and nobody on the network hears of it but through its kernel
/// host.start([] { return std::make_shared<Winch>(); });
/// \endcode
class SimulatedHost final : public Host
{
public:
    /// How the clocks of the host differ from the time of the simulator.
    struct Clocks
    {
        std::int64_t offset = 0;                              // [ns] of the monotonic clock
        std::int64_t drift = 0;                               // [ns/s]
        std::int64_t wallOffset = 1'700'000'000'000'000'000;  // [ns] from the monotonic clock
    };
    /// What becomes of the connections of a program that is killed.
    enum class End {
        Program,  ///< the kernel of the host lives on, and tells the other ends
        Power     ///< the other ends hear nothing
    };

    SimulatedHost(Simulator &simulator, const QString &name, const QHostAddress &address);
    /// Kills.
    ~SimulatedHost() override;
    /// That of the calling thread. Null: it is on none.
    static SimulatedHost *current() noexcept;

    const QString &name() const noexcept { return m_name; }
    const QHostAddress &address() const noexcept { return m_address; }
    void setClocks(const Clocks &clocks) { m_clocks = clocks; }
    const Clocks &clocks() const noexcept { return m_clocks; }

    /// Makes the program, on this host; it lives until kill().
    void start(const std::function<std::shared_ptr<void>()> &program);
    bool isRunning() const noexcept { return m_program != nullptr; }
    /// Ends the program; nothing of what its objects do as they end reaches the network.
    void kill(End end = End::Program);
    /// Runs \a code on this host.
    void call(const std::function<void()> &code);
    /// Begins \a code on a strand of its own, where it may wait. kill() waits for its end.
    void startThread(const std::function<void()> &code);
    /// From now on the program stands still, as after SIGSTOP, while frames come in; or it goes on.
    void setStopped(bool stopped);
    bool isStopped() const noexcept { return m_isStopped; }
    /// Whether what it sends reaches the network.
    bool isMute() const noexcept { return m_isMute; }
    /// What has happened to a program that stands still.
    void keep(const SimulatedEvent &event) { m_kept.push_back(event); }

    /// When now() is \a time, on the clock of the simulator [ns].
    std::int64_t whenIs(std::int64_t time) const noexcept;
    Simulator &simulator() noexcept { return m_simulator; }
    /// A port that is free.
    quint16 newPort() noexcept { return m_nextPort++; }

    // ---- Host ----

    std::int64_t now() noexcept override;
    std::int64_t slept() noexcept override { return 0; }
    bool sleepUntil(std::int64_t deadline) noexcept override;
    std::int64_t wallClock() noexcept override { return now() + m_clocks.wallOffset; }
    bool hasKernelTimers() const noexcept override { return false; }
    bool hasThreads() const noexcept override { return false; }
    std::uint64_t random() override { return m_random.next(); }
    int openWakeUp(int *error) noexcept override;
    void closeWakeUp(int descriptor) noexcept override;
    void wake(int descriptor) noexcept override;
    bool consumeWakeUp(int descriptor) noexcept override;
    std::unique_ptr<Strand> makeStrand() override;
    Strand *runningStrand() noexcept override;
    ControlNetwork *controlNetwork() noexcept override;

    /// What the program has once; new with each life.
    ProgramScope *scope() const noexcept { return m_scope.get(); }
    Fiber *runningFiber() const noexcept { return m_fiber; }
    void setRunningFiber(Fiber *fiber) noexcept { m_fiber = fiber; }

private:
    std::int64_t timeAt(std::int64_t instant) const noexcept;

    Simulator &m_simulator;
    const QString m_name;
    const QHostAddress m_address;
    Clocks m_clocks;
    SeededRandom m_random;
    std::unique_ptr<ProgramScope> m_scope = std::make_unique<ProgramScope>();
    std::shared_ptr<void> m_program;
    std::vector<std::unique_ptr<Strand>> m_threads;  // of the program
    std::vector<SimulatedEvent> m_kept;
    std::unique_ptr<ControlNetwork> m_network;
    Fiber *m_fiber = nullptr;
    quint16 m_nextPort = 40000;
    bool m_isStopped = false;
    bool m_isMute = false;
};

}  // namespace qplc
