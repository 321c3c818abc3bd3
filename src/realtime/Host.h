// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <cstdint>
#include <functional>
#include <memory>

namespace qplc {

class ControlNetwork;

/// What runs the cycles of a master or node on a host without threads. See CycleThread for the
/// meaning of its functions.
class Strand
{
public:
    virtual ~Strand();

    virtual void start(const QString &name, std::function<void()> body) = 0;
    virtual void interrupt() = 0;
    virtual void join() = 0;
    /// As InterruptibleWaits::interruptAt(). By the body itself.
    virtual void interruptAt(std::int64_t instant, std::int64_t period) noexcept = 0;
};

/// The computer on which a master, a node or a tool runs: its clocks, random numbers, wake-ups and
/// threads.
///
/// There is one real computer, machine(). A simulator has hosts of its own, as many as it likes in
/// one thread, and enters one of them before it runs code that belongs to it. So the code of
/// masters and nodes is the same in both. See docs/design/simulation.md.
class Host
{
public:
    virtual ~Host();

    /// That of the calling thread: machine(), unless a simulator has entered another one.
    static Host &current() noexcept;
    static Host &machine() noexcept;
    /// The calling thread is on \a host from now on; null: on machine(). \return as it was before
    static Host *enter(Host *host) noexcept;

    // ---- clocks: see TimeSource, which is what the code uses ----

    virtual std::int64_t now() noexcept = 0;
    virtual std::int64_t slept() noexcept = 0;
    virtual bool sleepUntil(std::int64_t deadline) noexcept = 0;
    /// [ns since 1970-01-01 UTC]
    virtual std::int64_t wallClock() noexcept = 0;
    /// Whether descriptors and signals of the kernel keep time like this clock.
    virtual bool hasKernelTimers() const noexcept = 0;

    // ---- random numbers ----

    /// Cannot be guessed.
    virtual std::uint64_t random() = 0;

    // ---- wake-ups: see WakeUp ----

    /// A descriptor for QSocketNotifier. \return -1, with the errno value in \a error, when there
    /// is none
    virtual int openWakeUp(int *error) noexcept = 0;
    virtual void closeWakeUp(int descriptor) noexcept = 0;
    /// From now on \a descriptor is readable.
    virtual void wake(int descriptor) noexcept = 0;
    /// The contrary. \return whether it was readable
    virtual bool consumeWakeUp(int descriptor) noexcept = 0;

    // ---- threads ----

    /// Whether a program on this host may make threads: see Worker.
    virtual bool hasThreads() const noexcept { return true; }

    // ---- cycles ----

    /// What runs cycles in place of a thread. Null: threads do.
    virtual std::unique_ptr<Strand> makeStrand() { return nullptr; }
    /// The strand whose body is running. Null: there is none.
    virtual Strand *runningStrand() noexcept { return nullptr; }

    // ---- the network ----

    /// Null: that of the kernel. See transport/ControlNetwork.h.
    virtual ControlNetwork *controlNetwork() noexcept { return nullptr; }
};

/// A new name that nothing else in the world has: "6f3c0f4e-...".
QString newUuid();
/// Random, 0 <= x < 1.
double randomFraction();

}  // namespace qplc
