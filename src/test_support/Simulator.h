// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SimulatedNetwork.h"

#include <QtCore/QAbstractEventDispatcher>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace qplc {

class ControlWire;
class FrameWire;
class OutsideHost;
class SimulatedHost;
class Simulator;

/// Random numbers that follow from a seed alone (SplitMix64).
class SeededRandom
{
public:
    explicit SeededRandom(std::uint64_t seed)
        : m_state(seed)
    {
    }
    std::uint64_t next() noexcept
    {
        std::uint64_t mixed = (m_state += 0x9E3779B97F4A7C15);
        mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9;
        mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EB;
        return mixed ^ mixed >> 31;
    }
    /// 0 <= x < \a limit; 0 when that is 0.
    std::uint64_t below(std::uint64_t limit) noexcept { return limit == 0 ? 0 : next() % limit; }
    /// 0 <= x < 1
    double fraction() noexcept { return double(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t m_state;
};

/// What events happen to. An event whose target has been destroyed meanwhile does not happen.
class SimulatedTarget
{
public:
    /// \param host  on which events happen; null: beside all hosts
    SimulatedTarget(Simulator &simulator, SimulatedHost *host);
    virtual ~SimulatedTarget();
    SimulatedTarget(const SimulatedTarget &) = delete;
    SimulatedTarget &operator=(const SimulatedTarget &) = delete;

    virtual void happen(std::uint32_t what, std::uint64_t data) = 0;
    /// Whether \a what happens to a program, which may have been stopped, and not to the kernel or
    /// the network.
    virtual bool isOfProgram(std::uint32_t /*what*/) const { return true; }

protected:
    Simulator &m_simulator;
    SimulatedHost *const m_host;

private:
    friend class Simulator;
    std::uint32_t m_slot;
};

struct SimulatedEvent
{
    std::int64_t time = 0;    // [ns] of the simulator
    std::uint64_t order = 0;  // of those at the same time
    std::uint64_t data = 0;
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;  // of the slot
    std::uint32_t what = 0;
};

/// Virtual time, and all that happens in it, one event after the other, in one thread. With the
/// same seed the same happens.
///
/// It is the event dispatcher of its thread: timers, posted events and socket notifiers of Qt live
/// in virtual time, too. run() makes such a thread. See docs/design/simulation.md.
class Simulator final : public QAbstractEventDispatcher
{
    Q_OBJECT
public:
    /// Runs \a scenario in a thread of its own with a simulator, and returns when it has ended.
    static void run(std::uint64_t seed, const std::function<void(Simulator &)> &scenario);

    explicit Simulator(std::uint64_t seed);
    ~Simulator() override;

    /// [ns] since the begin
    std::int64_t now() const noexcept { return m_now; }
    std::uint64_t seed() const noexcept { return m_seed; }
    /// Of all that has travelled on the network so far, and when.
    std::uint64_t digest() const noexcept { return m_digest; }
    std::uint64_t eventCount() const noexcept { return m_eventCount; }

    /// Lets \a duration [ns] pass.
    void runFor(std::int64_t duration);
    /// Until \a isReached, which is asked each millisecond. \return false when \a longest [ns] have
    /// passed before
    bool runUntil(const std::function<bool()> &isReached, std::int64_t longest);

    SimulatedNetwork &network() noexcept { return m_network; }
    /// What decides by chance on the network.
    SeededRandom &fate() noexcept { return m_fate; }
    ControlWire &controlWire() noexcept { return *m_controlWire; }
    FrameWire &frameWire() noexcept { return *m_frameWire; }

    // ---- for hosts and the network ----

    void schedule(const SimulatedTarget &target, std::int64_t time, std::uint32_t what, std::uint64_t data = 0);
    /// \a event, which did not happen when it was due, happens now.
    void repeat(SimulatedEvent event);
    /// Calls \a code as Qt calls what receives an event: objects that it deletes later end after
    /// it.
    void deliver(const std::function<void()> &code);
    /// Adds to the digest.
    void trace(std::uint64_t what) noexcept
    {
        m_digest = (m_digest ^ what) * 0x9FB21C651E98DF25;
        m_digest ^= m_digest >> 29;
    }
    void trace(const char *bytes, std::size_t size) noexcept;

    int openDescriptor(SimulatedHost *host);
    void closeDescriptor(int descriptor);
    void setReadable(int descriptor, bool readable);
    /// From now on \a descriptor is not readable. \return whether it was
    bool consumeReadable(int descriptor);

    // ---- QAbstractEventDispatcher ----

    bool processEvents(QEventLoop::ProcessEventsFlags flags) override;
    bool hasPendingEvents() override;
    void registerSocketNotifier(QSocketNotifier *notifier) override;
    void unregisterSocketNotifier(QSocketNotifier *notifier) override;
    void registerTimer(int id, int interval, Qt::TimerType type, QObject *object) override;
    bool unregisterTimer(int id) override;
    bool unregisterTimers(QObject *object) override;
    QList<TimerInfo> registeredTimers(QObject *object) const override;
    int remainingTime(int id) override;
    void wakeUp() override {}
    void interrupt() override {}
    void flush() override {}

private:
    friend class SimulatedTarget;
    class Own;
    struct Slot
    {
        SimulatedTarget *target = nullptr;
        std::uint32_t generation = 0;
    };
    struct Timer
    {
        int interval = 0;  // [ms]
        Qt::TimerType type = Qt::CoarseTimer;
        QObject *object = nullptr;
        SimulatedHost *host = nullptr;
        std::int64_t due = 0;  // [ns] on the clock of the host
        std::uint32_t generation = 0;
        std::unique_ptr<SimulatedTarget> target;
    };
    struct Descriptor
    {
        QSocketNotifier *notifier = nullptr;
        bool isReadable = false;
        bool isScheduled = false;
        std::unique_ptr<SimulatedTarget> target;
    };

    std::uint32_t enter(SimulatedTarget *target);
    void leave(std::uint32_t slot);
    bool step();
    void timerDue(int id, std::uint32_t generation);
    void descriptorReady(int descriptor);
    void tellOf(int descriptor);
    void scheduleTimer(int id, const Timer &timer);

    const std::uint64_t m_seed;
    SimulatedNetwork m_network;
    SeededRandom m_fate;
    std::int64_t m_now = 0;
    std::uint64_t m_order = 0;
    std::uint64_t m_digest = 0;
    std::uint64_t m_eventCount = 0;
    std::vector<SimulatedEvent> m_events;  // a heap
    std::vector<Slot> m_slots;
    std::vector<std::uint32_t> m_freeSlots;
    std::map<int, Timer> m_timers;
    std::uint32_t m_timerGeneration = 0;
    std::map<int, Descriptor> m_descriptors;
    int m_nextDescriptor = 1 << 24;                           // none of the kernel
    int m_depth = 0;                                          // of events that happen in nested loops
    std::vector<std::unique_ptr<SimulatedTarget>> m_retired;  // until no event happens
    std::unique_ptr<QObject> m_receiver;
    std::unique_ptr<OutsideHost> m_outside;
    std::unique_ptr<ControlWire> m_controlWire;
    std::unique_ptr<FrameWire> m_frameWire;
};

}  // namespace qplc
