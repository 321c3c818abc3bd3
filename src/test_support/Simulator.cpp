// SPDX-License-Identifier: Apache-2.0
#include "Simulator.h"

#include "ControlWire.h"
#include "FrameWire.h"
#include "OutsideHost.h"
#include "SimulatedHost.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEventLoop>
#include <QtCore/QSocketNotifier>
#include <QtCore/QThread>
#include <QtCore/QTimerEvent>

#include <algorithm>
#include <cstring>
#include <thread>
#include <utility>

namespace qplc {

namespace {

constexpr std::int64_t Shortest = 1000;  // [ns] of a timer with the interval 0, so that time passes

// An object, so that the compiler can inline it into the functions of heaps.
constexpr auto isLater = [](const SimulatedEvent &left, const SimulatedEvent &right) {
    return left.time != right.time ? left.time > right.time : left.order > right.order;
};

class CodeEvent final : public QEvent
{
public:
    explicit CodeEvent(const std::function<void()> &code)
        : QEvent(QEvent::User)
        , m_code(code)
    {
    }
    void run() const { m_code(); }

private:
    const std::function<void()> &m_code;
};

class Receiver final : public QObject
{
public:
    bool event(QEvent *event) override
    {
        static_cast<CodeEvent *>(event)->run();
        return true;
    }
};

/// A target that is a function.
class Function final : public SimulatedTarget
{
public:
    using Code = std::function<void(std::uint32_t, std::uint64_t)>;
    Function(Simulator &simulator, SimulatedHost *host, Code code)
        : SimulatedTarget(simulator, host)
        , m_code(std::move(code))
    {
    }
    void happen(std::uint32_t what, std::uint64_t data) override { m_code(what, data); }

private:
    Code m_code;
};

}  // namespace

SimulatedTarget::SimulatedTarget(Simulator &simulator, SimulatedHost *host)
    : m_simulator(simulator)
    , m_host(host)
    , m_slot(simulator.enter(this))
{
}

SimulatedTarget::~SimulatedTarget()
{
    m_simulator.leave(m_slot);
}

/// Unlike that of QThread::wait(), the end of join() comes behind all that libraries do when a
/// thread ends.
void Simulator::run(std::uint64_t seed, const std::function<void(Simulator &)> &scenario)
{
    std::thread thread([&] {
        auto *simulator = new Simulator(seed);  // the thread owns it
        QThread::currentThread()->setEventDispatcher(simulator);
        Host::enter(simulator->m_outside.get());
        scenario(*simulator);
        Host::enter(nullptr);
    });
    thread.join();
}

Simulator::Simulator(std::uint64_t seed)
    : m_seed(seed)
    , m_fate(~seed)
    , m_outside(std::make_unique<OutsideHost>(*this))
    , m_controlWire(std::make_unique<ControlWire>(*this))
    , m_frameWire(std::make_unique<FrameWire>(*this))
{
}

Simulator::~Simulator()
{
    m_timers.clear();
    m_descriptors.clear();
    m_controlWire.reset();
    m_frameWire.reset();
}

// ---- events ----

std::uint32_t Simulator::enter(SimulatedTarget *target)
{
    if (m_freeSlots.empty()) {
        m_slots.push_back({target, 0});
        return std::uint32_t(m_slots.size() - 1);
    }
    const std::uint32_t slot = m_freeSlots.back();
    m_freeSlots.pop_back();
    m_slots[slot].target = target;
    return slot;
}

void Simulator::leave(std::uint32_t slot)
{
    m_slots[slot].target = nullptr;
    ++m_slots[slot].generation;
    m_freeSlots.push_back(slot);
}

void Simulator::schedule(const SimulatedTarget &target, std::int64_t time, std::uint32_t what, std::uint64_t data)
{
    m_events.push_back(
        {std::max(time, m_now), m_order++, data, target.m_slot, m_slots[target.m_slot].generation, what});
    std::push_heap(m_events.begin(), m_events.end(), isLater);
}

void Simulator::repeat(SimulatedEvent event)
{
    event.time = m_now;
    event.order = m_order++;
    m_events.push_back(event);
    std::push_heap(m_events.begin(), m_events.end(), isLater);
}

/// \return false when nothing will happen any more
bool Simulator::step()
{
    if (m_events.empty())
        return false;
    std::pop_heap(m_events.begin(), m_events.end(), isLater);
    const SimulatedEvent event = m_events.back();
    m_events.pop_back();
    const Slot slot = m_slots[event.slot];
    if (!slot.target || slot.generation != event.generation)
        return true;
    m_now = event.time;
    ++m_eventCount;
    SimulatedHost *host = slot.target->m_host;
    if (host && host->isStopped() && slot.target->isOfProgram(event.what)) {
        host->keep(event);
        return true;
    }
    ++m_depth;
    Host *before = Host::enter(host ? static_cast<Host *>(host) : m_outside.get());
    slot.target->happen(event.what, event.data);
    QCoreApplication::sendPostedEvents();
    Host::enter(before);
    if (--m_depth == 0)
        m_retired.clear();
    return true;
}

void Simulator::deliver(const std::function<void()> &code)
{
    if (!m_receiver)
        m_receiver = std::make_unique<Receiver>();
    CodeEvent event(code);
    QCoreApplication::sendEvent(m_receiver.get(), &event);
}

void Simulator::trace(const char *bytes, std::size_t size) noexcept
{
    for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), bytes += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes, sizeof word);
        trace(word);
    }
    std::uint64_t rest = size;
    std::memcpy(&rest, bytes, size);
    trace(rest);
}

void Simulator::runFor(std::int64_t duration)
{
    QEventLoop loop;
    const Function end(*this, nullptr, [&loop](std::uint32_t, std::uint64_t) { loop.quit(); });
    schedule(end, m_now + duration, 0);
    loop.exec();
}

bool Simulator::runUntil(const std::function<bool()> &isReached, std::int64_t longest)
{
    const std::int64_t end = m_now + longest;
    constexpr std::int64_t look = 1'000'000;  // [ns]
    while (!isReached()) {
        if (m_now >= end)
            return false;
        runFor(std::min(look, end - m_now));
    }
    return true;
}

bool Simulator::processEvents(QEventLoop::ProcessEventsFlags)
{
    QCoreApplication::sendPostedEvents();
    return step();
}

bool Simulator::hasPendingEvents()
{
    return !m_events.empty();
}

// ---- timers ----

void Simulator::registerTimer(int id, int interval, Qt::TimerType type, QObject *object)
{
    SimulatedHost *host = SimulatedHost::current();
    Timer &timer = m_timers[id];
    timer.interval = interval;
    timer.type = type;
    timer.object = object;
    timer.host = host;
    timer.generation = ++m_timerGeneration;
    timer.due = (host ? host->now() : m_now) + std::max<std::int64_t>(std::int64_t(interval) * 1'000'000, Shortest);
    timer.target = std::make_unique<Function>(
        *this, host, [this, id](std::uint32_t generation, std::uint64_t) { timerDue(id, generation); });
    scheduleTimer(id, timer);
}

void Simulator::scheduleTimer(int, const Timer &timer)
{
    schedule(*timer.target, timer.host ? timer.host->whenIs(timer.due) : timer.due, timer.generation);
}

void Simulator::timerDue(int id, std::uint32_t generation)
{
    const auto found = m_timers.find(id);
    if (found == m_timers.end() || found->second.generation != generation)
        return;
    Timer &timer = found->second;
    const std::int64_t period = std::max<std::int64_t>(std::int64_t(timer.interval) * 1'000'000, Shortest);
    const std::int64_t now = timer.host ? timer.host->now() : m_now;
    timer.due = std::max(timer.due + period, now);
    scheduleTimer(id, timer);
    QTimerEvent event(id);
    QCoreApplication::sendEvent(timer.object, &event);
}

bool Simulator::unregisterTimer(int id)
{
    const auto found = m_timers.find(id);
    if (found == m_timers.end())
        return false;
    m_retired.push_back(std::move(found->second.target));  // its function may be running
    m_timers.erase(found);
    return true;
}

bool Simulator::unregisterTimers(QObject *object)
{
    std::vector<int> ids;
    for (const auto &[id, timer] : m_timers) {
        if (timer.object == object)
            ids.push_back(id);
    }
    for (const int id : ids)
        unregisterTimer(id);
    return !ids.empty();
}

QList<QAbstractEventDispatcher::TimerInfo> Simulator::registeredTimers(QObject *object) const
{
    QList<TimerInfo> list;
    for (const auto &[id, timer] : m_timers) {
        if (timer.object == object)
            list.append(TimerInfo(id, timer.interval, timer.type));
    }
    return list;
}

int Simulator::remainingTime(int id)
{
    const auto found = m_timers.find(id);
    if (found == m_timers.end())
        return -1;
    const Timer &timer = found->second;
    const std::int64_t left = timer.due - (timer.host ? timer.host->now() : m_now);
    return int(std::max<std::int64_t>((left + 999'999) / 1'000'000, 0));
}

// ---- descriptors ----

int Simulator::openDescriptor(SimulatedHost *host)
{
    const int number = m_nextDescriptor++;
    m_descriptors[number].target = std::make_unique<Function>(
        *this, host, [this](std::uint32_t, std::uint64_t data) { descriptorReady(int(data)); });
    return number;
}

void Simulator::closeDescriptor(int descriptor)
{
    const auto found = m_descriptors.find(descriptor);
    if (found == m_descriptors.end())
        return;
    m_retired.push_back(std::move(found->second.target));
    m_descriptors.erase(found);
}

void Simulator::setReadable(int descriptor, bool readable)
{
    const auto found = m_descriptors.find(descriptor);
    if (found == m_descriptors.end())
        return;
    found->second.isReadable = readable;
    tellOf(descriptor);
}

bool Simulator::consumeReadable(int descriptor)
{
    const auto found = m_descriptors.find(descriptor);
    return found != m_descriptors.end() && std::exchange(found->second.isReadable, false);
}

/// Its notifier hears of it once for each time that it looks.
void Simulator::tellOf(int descriptor)
{
    Descriptor &one = m_descriptors[descriptor];
    if (!one.isReadable || !one.notifier || one.isScheduled)
        return;
    one.isScheduled = true;
    schedule(*one.target, m_now, 0, std::uint64_t(descriptor));
}

void Simulator::descriptorReady(int descriptor)
{
    Descriptor &ready = m_descriptors[descriptor];
    ready.isScheduled = false;
    if (!ready.isReadable || !ready.notifier)
        return;
    QEvent event(QEvent::SockAct);
    QCoreApplication::sendEvent(ready.notifier, &event);
    const auto found = m_descriptors.find(descriptor);
    if (found == m_descriptors.end() || !found->second.isReadable || !found->second.notifier
        || found->second.isScheduled)
        return;
    found->second.isScheduled = true;  // it is still readable: in a turn of its own, and time passes
    schedule(*found->second.target, m_now + Shortest, 0, std::uint64_t(descriptor));
}

void Simulator::registerSocketNotifier(QSocketNotifier *notifier)
{
    const auto found = m_descriptors.find(int(notifier->socket()));
    if (found == m_descriptors.end())
        return;  // of the kernel, which has no part in this
    found->second.notifier = notifier;
    tellOf(found->first);
}

void Simulator::unregisterSocketNotifier(QSocketNotifier *notifier)
{
    const auto found = m_descriptors.find(int(notifier->socket()));
    if (found != m_descriptors.end() && found->second.notifier == notifier)
        found->second.notifier = nullptr;
}

}  // namespace qplc
