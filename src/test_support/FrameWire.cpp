// SPDX-License-Identifier: Apache-2.0
#include "FrameWire.h"

#include "Fiber.h"
#include "SimulatedHost.h"

#include <algorithm>

namespace qplc {

FrameWire::FrameWire(Simulator &simulator)
    : m_simulator(simulator)
{
}

void FrameWire::send(FrameEnd &from, quint64 to, const char *bytes, std::size_t size)
{
    const auto end = m_ends.find(to);
    if (end == m_ends.end() || from.host().isMute())
        return;
    const SimulatedRoad &road = m_simulator.network().road(from.host(), end->second->host());
    if (road.isCut || (road.loss > 0 && m_simulator.fate().fraction() < road.loss))
        return;
    sendOnce(from, *end->second, bytes, size);
    if (road.duplication > 0 && m_simulator.fate().fraction() < road.duplication)
        sendOnce(from, *end->second, bytes, size);
}

void FrameWire::sendOnce(FrameEnd &from, const FrameEnd &to, const char *bytes, std::size_t size)
{
    if (m_free.empty()) {
        m_free.push_back(m_frames.size());
        m_frames.push_back(std::make_unique<SimulatedFrame>());
    }
    const std::size_t number = m_free.back();
    m_free.pop_back();
    m_frames[number]->from = from.key();
    m_frames[number]->bytes.assign(bytes, bytes + size);
    const SimulatedRoad &road = m_simulator.network().road(from.host(), to.host());
    std::int64_t arrival
        = m_simulator.now() + road.delay + std::int64_t(m_simulator.fate().below(std::uint64_t(road.jitter)));
    std::int64_t &last = from.m_arrivals[to.key()];
    if (road.reordering > 0 && m_simulator.fate().fraction() < road.reordering)
        arrival += std::int64_t(m_simulator.fate().below(std::uint64_t(road.lateness)));
    else
        last = arrival = std::max(arrival, last);
    m_simulator.schedule(to, arrival, 0, number);
}

std::vector<const FrameEnd *> FrameWire::ends() const
{
    std::vector<const FrameEnd *> all;
    for (const auto &[key, end] : m_ends)
        all.push_back(end);
    std::sort(all.begin(), all.end(), [](const FrameEnd *a, const FrameEnd *b) { return a->key() < b->key(); });
    return all;
}

FrameEnd::FrameEnd(SimulatedHost &host, quint16 port)
    : SimulatedTarget(host.simulator(), &host)
    , m_wire(host.simulator().frameWire())
    , m_key(SocketAddress(host.address(), port).key())
{
    m_wire.m_ends[m_key] = this;
}

FrameEnd::~FrameEnd()
{
    const auto own = m_wire.m_ends.find(m_key);
    if (own != m_wire.m_ends.end() && own->second == this)
        m_wire.m_ends.erase(own);
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
    return &m_wire.frame(m_taken);
}

void FrameEnd::wait(std::int64_t deadline) noexcept
{
    Fiber *fiber = m_host->runningFiber();
    if (!fiber || !m_unread.empty())
        return;
    m_waiting = fiber;
    fiber->wait(deadline);
    m_waiting = nullptr;
}

void FrameEnd::happen(std::uint32_t, std::uint64_t number)
{
    const SimulatedFrame &frame = m_wire.frame(number);
    m_simulator.trace(std::uint64_t(m_simulator.now()));
    m_simulator.trace(frame.from ^ m_key << 1);
    m_simulator.trace(frame.bytes.data(), frame.bytes.size());
    if (m_unread.size() >= MostUnread) {
        m_wire.release(number);
        ++m_dropped;
        return;
    }
    m_unread.push_back(number);
    if (m_waiting)
        m_waiting->wake();
}

}  // namespace qplc
