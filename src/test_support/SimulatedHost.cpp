// SPDX-License-Identifier: Apache-2.0
#include "SimulatedHost.h"

#include "ControlWire.h"
#include "Fiber.h"
#include "FrameWire.h"
#include "signals/Fnv1a.h"

#include <QtCore/QCoreApplication>

#include <utility>

namespace qplc {

namespace {

constexpr std::int64_t PerSecond = 1'000'000'000;

/// While it lives, the thread is on the host.
class Visit
{
public:
    explicit Visit(SimulatedHost *host)
        : m_before(Host::enter(host))
    {
    }
    ~Visit() { Host::enter(m_before); }
    Visit(const Visit &) = delete;
    Visit &operator=(const Visit &) = delete;

private:
    Host *m_before;
};

ProgramScope *scopeOfHost()
{
    const SimulatedHost *host = SimulatedHost::current();
    return host ? host->scope() : nullptr;
}

}  // namespace

SimulatedHost::SimulatedHost(Simulator &simulator, const QString &name, const QHostAddress &address)
    : m_simulator(simulator)
    , m_name(name)
    , m_address(address)
    , m_random(simulator.seed() ^ fnv1a64(name.toUtf8() + address.toString().toUtf8()))
    , m_network(simulator.controlWire().networkOf(*this))
{
    ProgramScope::setLookup(&scopeOfHost);
}

SimulatedHost::~SimulatedHost()
{
    kill(End::Power);
    m_simulator.frameWire().removePorts(*this);
}

SimulatedHost *SimulatedHost::current() noexcept
{
    return dynamic_cast<SimulatedHost *>(&Host::current());
}

void SimulatedHost::start(const std::function<std::shared_ptr<void>()> &program)
{
    kill();
    m_scope = std::make_unique<ProgramScope>();
    const Visit visit(this);
    m_isMute = false;
    m_program = program();
}

void SimulatedHost::kill(End end)
{
    if (!m_program)
        return;
    if (end == End::Program)
        m_simulator.controlWire().closeAll(*this);
    m_isMute = true;
    setStopped(false);
    const Visit visit(this);
    m_program.reset();  // what waits in a step of it hears that it has ended
    m_threads.clear();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);  // what was to end later ends with it
    m_kept.clear();
}

void SimulatedHost::call(const std::function<void()> &code)
{
    const Visit visit(this);
    m_simulator.deliver(code);
}

void SimulatedHost::startThread(const std::function<void()> &code)
{
    const Visit visit(this);
    m_threads.push_back(makeStrand());
    m_threads.back()->start(m_name, code);
}

void SimulatedHost::setStopped(bool stopped)
{
    m_isStopped = stopped;
    if (stopped)
        return;
    for (const SimulatedEvent &event : std::exchange(m_kept, {}))
        m_simulator.repeat(event);
}

// ---- clocks ----

std::int64_t SimulatedHost::now() noexcept
{
    return timeAt(m_simulator.now());
}

/// What the monotonic clock of the host shows at \a instant of the simulator [ns].
std::int64_t SimulatedHost::timeAt(std::int64_t instant) const noexcept
{
    const std::int64_t ahead = instant / PerSecond * m_clocks.drift + instant % PerSecond * m_clocks.drift / PerSecond;
    return instant + m_clocks.offset + ahead;
}

std::int64_t SimulatedHost::whenIs(std::int64_t time) const noexcept
{
    std::int64_t instant = time - m_clocks.offset;
    instant += time - timeAt(instant);
    for (std::int64_t missing = time - timeAt(instant); missing > 0; missing = time - timeAt(instant))
        instant += missing;  // not before
    return instant;
}

bool SimulatedHost::sleepUntil(std::int64_t deadline) noexcept
{
    return !m_fiber || m_fiber->wait(deadline) == Fiber::Due;  // elsewhere nothing is waited for that an event brings
}

// ---- wake-ups ----

int SimulatedHost::openWakeUp(int *error) noexcept
{
    *error = 0;
    return m_simulator.openDescriptor(this);
}

void SimulatedHost::closeWakeUp(int descriptor) noexcept
{
    m_simulator.closeDescriptor(descriptor);
}

void SimulatedHost::wake(int descriptor) noexcept
{
    m_simulator.setReadable(descriptor, true);
}

bool SimulatedHost::consumeWakeUp(int descriptor) noexcept
{
    return m_simulator.consumeReadable(descriptor);
}

// ---- cycles, network ----

std::unique_ptr<Strand> SimulatedHost::makeStrand()
{
    return std::make_unique<Fiber>(*this);
}

Strand *SimulatedHost::runningStrand() noexcept
{
    return m_fiber;
}

ControlNetwork *SimulatedHost::controlNetwork() noexcept
{
    return m_network.get();
}

}  // namespace qplc
