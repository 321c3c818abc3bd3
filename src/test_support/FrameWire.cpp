// SPDX-License-Identifier: Apache-2.0
#include "FrameWire.h"

#include "Fiber.h"
#include "SimulatedHost.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace qplc {

namespace {

// Of those that a kernel gives away.
constexpr quint16 FirstPort = 40000;
constexpr std::uint64_t Ports = 8;

SimulatedRoad withoutReordering(SimulatedRoad road)
{
    road.reordering = 0;
    return road;
}

}  // namespace

FrameWire::FrameWire(Simulator &simulator)
    : m_simulator(simulator)
{
}

FrameWire::~FrameWire() = default;

quint16 FrameWire::freePort(const SimulatedHost &host)
{
    const auto isTaken = [&](quint16 port) {
        const auto found = m_ports.find(SocketAddress(host.address(), port).key());
        return found != m_ports.end() && found->second->end;
    };
    auto port = quint16(FirstPort + m_simulator.fate().below(Ports));
    while (isTaken(port))
        ++port;
    return port;
}

void FrameWire::removePorts(const SimulatedHost &host)
{
    for (auto port = m_ports.begin(); port != m_ports.end();)
        port = &port->second->host() == &host ? m_ports.erase(port) : std::next(port);
}

void FrameWire::send(FrameEnd &from, quint64 to, const char *bytes, std::size_t size)
{
    const auto found = m_ports.find(to);
    if (found == m_ports.end() || from.host().isMute())
        return;
    const FramePort &port = *found->second;
    const SimulatedRoad &road = m_simulator.network().road(from.host(), port.host());
    SeededRandom &fate = m_simulator.fate();
    if (from.isReliable() || (port.end && port.end->isReliable())) {
        if (!road.isCut)
            carry(from, port, arrival(from, port, withoutReordering(road)), bytes, size);
        return;
    }
    if (road.isCut || road.dropsDatagrams || (road.loss > 0 && fate.fraction() < road.loss))
        return;
    carry(from, port, arrival(from, port, road), bytes, size);
    if (road.duplication > 0 && fate.fraction() < road.duplication)
        carry(from, port, arrival(from, port, road), bytes, size);
    if (road.echo > 0 && fate.fraction() < road.echo)
        carry(from, port, m_simulator.now() + std::int64_t(fate.below(std::uint64_t(road.echoTime))), bytes, size);
}

void FrameWire::divert(quint64 from, quint64 to, Reader reader)
{
    const auto found = m_ports.find(to);
    if (found == m_ports.end())
        return;
    if (reader)
        found->second->readers[from] = std::move(reader);
    else
        found->second->readers.erase(from);
}

std::int64_t FrameWire::arrival(FrameEnd &from, const FramePort &to, const SimulatedRoad &road)
{
    const std::int64_t arrival
        = m_simulator.now() + road.delay + std::int64_t(m_simulator.fate().below(std::uint64_t(road.jitter)));
    if (road.reordering > 0 && m_simulator.fate().fraction() < road.reordering)
        return arrival + std::int64_t(m_simulator.fate().below(std::uint64_t(road.lateness)));
    std::int64_t &last = from.m_arrivals[&to];
    last = std::max(arrival, last);
    return last;
}

void FrameWire::carry(const FrameEnd &from, const FramePort &to, std::int64_t arrival, const char *bytes,
                      std::size_t size)
{
    if (m_free.empty()) {
        m_free.push_back(m_frames.size());
        m_frames.push_back(std::make_unique<SimulatedFrame>());
    }
    const std::size_t number = m_free.back();
    m_free.pop_back();
    m_frames[number]->from = from.key();
    m_frames[number]->bytes.assign(bytes, bytes + size);
    m_simulator.schedule(to, arrival, 0, number);
}

std::vector<const FrameEnd *> FrameWire::ends() const
{
    std::vector<const FrameEnd *> all;
    for (const auto &[key, port] : m_ports) {
        if (port->end)
            all.push_back(port->end);
    }
    std::sort(all.begin(), all.end(), [](const FrameEnd *a, const FrameEnd *b) { return a->key() < b->key(); });
    return all;
}

FramePort::FramePort(SimulatedHost &host, FrameWire &wire)
    : SimulatedTarget(host.simulator(), &host)
    , m_wire(wire)
{
}

void FramePort::happen(std::uint32_t, std::uint64_t number)
{
    const auto reader = readers.find(m_wire.frame(number).from);
    const bool isDiverted = reader != readers.end();
    if (end && !isDiverted) {
        end->arrived(number);
        return;
    }
    if (end)
        reader->second(*end, m_wire.frame(number));
    m_wire.release(number);
}

FrameEnd::FrameEnd(SimulatedHost &host, quint16 port)
    : m_host(host)
    , m_wire(host.simulator().frameWire())
    , m_key(SocketAddress(host.address(), port).key())
    , m_descriptor(host.simulator().openDescriptor(&host))
{
    std::unique_ptr<FramePort> &own = m_wire.m_ports[m_key];
    if (!own)
        own = std::make_unique<FramePort>(host, m_wire);
    own->end = this;
}

FrameEnd::~FrameEnd()
{
    m_host.simulator().closeDescriptor(m_descriptor);
    const auto own = m_wire.m_ports.find(m_key);
    if (own != m_wire.m_ports.end() && own->second->end == this)
        own->second->end = nullptr;
    for (const std::size_t number : m_unread)
        m_wire.release(number);
    if (m_taken != None)
        m_wire.release(m_taken);
}

const SimulatedFrame *FrameEnd::take()
{
    if (m_taken != None)
        m_wire.release(m_taken);
    m_taken = None;
    if (m_unread.empty())
        return nullptr;
    m_taken = m_unread.front();
    m_unread.pop_front();
    if (m_unread.empty())
        m_host.simulator().setReadable(m_descriptor, false);
    return &m_wire.frame(m_taken);
}

void FrameEnd::wait(std::int64_t deadline) noexcept
{
    Fiber *fiber = m_host.runningFiber();
    if (!fiber || !m_unread.empty())
        return;
    m_waiting = fiber;
    fiber->wait(deadline);
    m_waiting = nullptr;
}

void FrameEnd::arrived(std::size_t number)
{
    const SimulatedFrame &frame = m_wire.frame(number);
    Simulator &simulator = m_host.simulator();
    simulator.trace(std::uint64_t(simulator.now()));
    simulator.trace(frame.from ^ m_key << 1);
    simulator.trace(frame.bytes.data(), frame.bytes.size());
    if (m_unread.size() >= MostUnread) {
        m_wire.release(number);
        ++m_dropped;
        return;
    }
    m_unread.push_back(number);
    simulator.setReadable(m_descriptor, true);
    if (m_waiting)
        m_waiting->wake();
}

}  // namespace qplc
