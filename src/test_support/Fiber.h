// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SimulatedHost.h"
#include "StackSwitch.h"

#include <boost/context/fiber.hpp>

namespace qplc {

/// A strand of cycles with a stack of its own, in the thread of the simulator. Where the thread of
/// a cycle would wait, it goes back to the simulator, which comes back when something has happened.
class Fiber final : public Strand, public SimulatedTarget
{
public:
    enum Reason {
        Due,         ///< the time has come
        Woken,       ///< by wake()
        Interrupted  ///< by interrupt(), or at the time of interruptAt()
    };

    explicit Fiber(SimulatedHost &host);
    ~Fiber() override;

    static constexpr std::int64_t Never = INT64_MAX;
    /// Waits until \a deadline [ns] of the clock of the host, or until it is woken. By the body.
    Reason wait(std::int64_t deadline) noexcept;
    /// Ends a wait of the body. From outside of it.
    void wake();

    void start(const QString &name, std::function<void()> body) override;
    void interrupt() override;
    void join() override;
    void interruptAt(std::int64_t instant, std::int64_t period) noexcept override;

    void happen(std::uint32_t what, std::uint64_t data) override;

private:
    enum What : std::uint32_t { Begin, Deadline, Alarm, Wake };

    void resume(Reason reason);

    SimulatedHost &m_own;
    std::function<void()> m_body;
    boost::context::fiber m_inside;
    boost::context::fiber m_outside;
    StackSwitch m_switch;
    Reason m_reason = Due;
    std::uint64_t m_wait = 0;   // number of the wait
    std::uint64_t m_alarm = 0;  // number of the alarm
    std::int64_t m_alarmTime = 0;
    std::int64_t m_alarmPeriod = 0;
    bool m_isWaiting = false;
    bool m_hasBegun = false;
    bool m_hasEnded = false;
};

}  // namespace qplc
