// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"

#include "TransportRegistry.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <poll.h>
#include <utility>

namespace qplc {

CyclicHub::CyclicHub()
{
    m_peers.reserve(MaximumPeers);
    for (const auto &kind : TransportRegistry::instance().kinds()) {
        auto transport = kind->isAtHand() ? kind->makeHubTransport() : nullptr;
        if (transport)
            add(std::move(transport));
    }
}

CyclicHub::~CyclicHub() = default;

void CyclicHub::add(std::unique_ptr<HubTransport> transport)
{
    transport->m_arrivals = &m_arrivals;
    m_transports.push_back(std::move(transport));
    m_busy.reserve(m_transports.size());
    rebuild();
    m_polled.reserve(m_polled.size() + MaximumPeers);
}

bool CyclicHub::open(const SocketAddress &address, QString *error)
{
    close();
    const auto opens = [&](const auto &transport) { return transport->open(address, error); };
    const bool areOpen = std::all_of(m_transports.begin(), m_transports.end(), opens);
    if (!areOpen)
        close();
    rebuild();
    return areOpen;
}

void CyclicHub::close()
{
    for (const auto &transport : m_transports)
        transport->close();
    rebuild();
}

void CyclicHub::setFaults(const std::optional<FaultPlan> &plan, TimeSource &time)
{
    m_faults = plan ? std::make_unique<HubFaults>(*plan, time) : nullptr;
}

void CyclicHub::exposeToFaults(HubPeer &peer, std::uint64_t stream) const
{
    if (m_faults)
        peer.m_faults = std::make_unique<PeerFaults>(m_faults->plan(), stream);
}

// ---- peers ----

/// That of the class which made \a peer. \pre the hub has that transport
HubTransport &CyclicHub::transportOf(HubPeer &peer) const noexcept
{
    if (!peer.m_transport) {
        const auto owns = [&](const auto &transport) { return transport->owns(peer); };
        peer.m_transport = std::find_if(m_transports.begin(), m_transports.end(), owns)->get();
    }
    return *peer.m_transport;
}

void CyclicHub::attach(HubPeer *peer) noexcept
{
    if (m_peers.size() == MaximumPeers)
        return;
    peer->m_transport = nullptr;  // it may have been with another hub before
    transportOf(*peer).attach(peer);
    m_peers.push_back(peer);
    rebuild();
}

void CyclicHub::detach(HubPeer *peer) noexcept
{
    flush();
    if (m_faults)
        m_faults->forget(peer);
    transportOf(*peer).detach(peer);
    m_peers.erase(std::remove(m_peers.begin(), m_peers.end(), peer), m_peers.end());
    rebuild();
}

void CyclicHub::rebuild() noexcept
{
    m_polled.clear();
    m_busy.clear();
    for (const auto &transport : m_transports) {
        if (transport->isIdle())
            continue;
        m_busy.push_back(transport.get());
        transport->addDescriptors(&m_polled);
    }
    m_polled.push_back({-1, POLLIN, 0});
}

std::uint64_t CyclicHub::keptOff() const
{
    std::uint64_t sum = 0;
    for (const auto &transport : m_transports)
        sum += transport->keptOff();
    return sum;
}

std::uint64_t CyclicHub::unread() const
{
    std::uint64_t sum = 0;
    for (const auto &transport : m_transports)
        sum += transport->unread();
    return sum;
}

// ---- sending ----

bool CyclicHub::send(HubPeer *peer, const char *frame, std::size_t size) noexcept
{
    // What a bad network does to a frame is no failure of sending it.
    if (peer->m_faults && !m_faults->sends(*peer->m_faults, peer, frame, size))
        return true;
    return transportOf(*peer).send(peer, frame, size);
}

void CyclicHub::flush() noexcept
{
    flushNow();
    if (m_faults)
        sendDelayed();
}

/// What was kept under way so far.
void CyclicHub::sendDelayed() noexcept
{
    for (DelayLine::Frame frame; m_faults->takeSending(&frame);) {
        auto *peer = static_cast<HubPeer *>(frame.owner);
        transportOf(*peer).send(peer, frame.bytes, frame.size);
        flushNow();  // the bytes stay until the next one is taken
    }
}

void CyclicHub::flushNow() noexcept
{
    for (HubTransport *transport : m_busy)
        transport->flush();
}

// ---- receiving ----

bool CyclicHub::wait(std::int64_t timeout, int alarm) noexcept
{
    if (!m_faults)
        return waitForArrivals(timeout, alarm);
    sendDelayed();
    const std::int64_t left = m_faults->timeLeft(timeout);
    const bool arrived = waitForArrivals(left, left < timeout ? -1 : alarm);
    sendDelayed();
    return m_faults->hasArrived() || arrived;
}

bool CyclicHub::waitForArrivals(std::int64_t timeout, int alarm) noexcept
{
    for (HubTransport *transport : m_busy) {
        bool arrived = false;
        const bool isAlone = alarm < 0 && transport->peerCount() == m_peers.size();
        if (isAlone && transport->waitAlone(timeout, &arrived))
            return arrived;
    }
    bool isToSleep = timeout > 0;
    for (HubTransport *transport : m_busy)
        isToSleep = transport->beginWait(isToSleep) && isToSleep;
    return isToSleep ? pollDescriptors(timeout, alarm) : pollDescriptors(0, -1);
}

bool CyclicHub::pollDescriptors(std::int64_t timeout, int alarm) noexcept
{
    const timespec limit = timeSpec(timeout);
    m_polled.back() = {alarm, POLLIN, 0};
    ::ppoll(m_polled.data(), m_polled.size(), alarm < 0 ? &limit : nullptr, nullptr);
    bool arrived = false;
    pollfd *polled = m_polled.data();
    for (HubTransport *transport : m_busy) {
        arrived = transport->endWait(polled) || arrived;
        polled += transport->descriptorCount();
    }
    return arrived;
}

bool CyclicHub::next(HubFrame *frame) noexcept
{
    if (!m_faults)
        return nextArrived(frame);
    while (nextArrived(frame)) {
        HubPeer *peer = frame->peer;
        if (!peer->m_faults || m_faults->receives(*peer->m_faults, peer, frame->bytes, frame->size))
            return true;
    }
    DelayLine::Frame delayed;
    if (!m_faults->takeReceived(&delayed))
        return false;
    *frame = {static_cast<HubPeer *>(delayed.owner), delayed.bytes, delayed.size};
    return true;
}

bool CyclicHub::nextArrived(HubFrame *frame) noexcept
{
    for (HubTransport *transport : m_busy) {
        if (transport->next(frame))
            return true;
    }
    return false;
}

}  // namespace qplc
