// SPDX-License-Identifier: Apache-2.0
#include "Fiber.h"

#include <boost/context/protected_fixedsize_stack.hpp>

#include <utility>

namespace qplc {

namespace {

constexpr std::size_t StackSize = std::size_t(1024) * 1024;  // [byte] the kernel gives pages when they are used

}  // namespace

Fiber::Fiber(SimulatedHost &host)
    : SimulatedTarget(host.simulator(), &host)
    , m_own(host)
{
}

Fiber::~Fiber()
{
    join();
}

void Fiber::start(const QString &, std::function<void()> body)
{
    m_body = std::move(body);
    boost::context::protected_fixedsize_stack allocator(StackSize);
    const boost::context::stack_context stack = allocator.allocate();
    m_switch.create(static_cast<char *>(stack.sp) - stack.size, stack.size);
    m_inside = boost::context::fiber(std::allocator_arg, boost::context::preallocated(stack.sp, stack.size, stack),
                                     std::move(allocator), [this](boost::context::fiber &&outside) {
                                         m_switch.hasEntered();
                                         m_outside = std::move(outside);
                                         m_body();
                                         m_hasEnded = true;
                                         m_switch.leave(true);
                                         return std::move(m_outside);
                                     });
    m_simulator.schedule(*this, m_simulator.now(), Begin);
}

void Fiber::resume(Reason reason)
{
    Q_ASSERT_X(!m_own.runningFiber(), "Fiber::resume", "another fiber of this host is running");
    m_isWaiting = false;
    m_hasBegun = true;
    m_reason = reason;
    ++m_wait;  // what was to end this wait comes too late
    m_own.setRunningFiber(this);
    m_switch.enter();
    m_inside = std::move(m_inside).resume();
    m_switch.hasLeft();
    m_own.setRunningFiber(nullptr);
}

Fiber::Reason Fiber::wait(std::int64_t deadline) noexcept
{
    if (deadline != Never)
        m_simulator.schedule(*this, m_own.whenIs(deadline), Deadline, m_wait);
    m_isWaiting = true;
    m_switch.leave();
    m_outside = std::move(m_outside).resume();
    m_switch.hasEntered();
    return m_reason;
}

void Fiber::wake()
{
    if (!m_isWaiting)
        return;
    if (m_own.runningFiber() || m_own.isStopped())
        m_simulator.schedule(*this, m_simulator.now(), Wake, m_wait);
    else
        resume(Woken);
}

void Fiber::interrupt()
{
    if (m_own.runningFiber())
        return;
    if (m_isWaiting)
        resume(Interrupted);
    else if (m_body && !m_hasBegun)  // who stops it may wait for its end without letting time pass
        resume(Due);
}

void Fiber::join()
{
    if (m_body && !m_hasBegun)
        resume(Due);
    while (m_body && !m_hasEnded)
        resume(Interrupted);
    m_body = nullptr;
}

void Fiber::interruptAt(std::int64_t instant, std::int64_t period) noexcept
{
    m_alarmTime = instant;
    m_alarmPeriod = period;
    ++m_alarm;
    if (instant > 0)
        m_simulator.schedule(*this, m_own.whenIs(instant), Alarm, m_alarm);
}

void Fiber::happen(std::uint32_t what, std::uint64_t data)
{
    if (m_hasEnded)
        return;
    switch (what) {
    case Begin:
        if (!m_hasBegun)
            resume(Due);
        break;
    case Deadline:
    case Wake:
        if (m_isWaiting && data == m_wait)
            resume(what == Wake ? Woken : Due);
        break;
    case Alarm:
        if (data != m_alarm)
            break;
        if (m_alarmPeriod > 0) {
            m_alarmTime += m_alarmPeriod;
            m_simulator.schedule(*this, m_own.whenIs(m_alarmTime), Alarm, m_alarm);
        }
        interrupt();
        break;
    default:
        break;
    }
}

}  // namespace qplc
