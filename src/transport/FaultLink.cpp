// SPDX-License-Identifier: Apache-2.0
#include "FaultLink.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr std::size_t framesOfOneLink = 256;  // frames under way in each direction; what comes then is lost

}  // namespace

FaultLink::FaultLink(std::unique_ptr<CyclicLink> link, const FaultPlan &plan, std::uint64_t stream, TimeSource &time)
    : CyclicLink(-1)
    , m_link(std::move(link))
    , m_time(time)
    , m_sent(plan.sent, plan.seed, 2 * stream)
    , m_received(plan.received, plan.seed, 2 * stream + 1)
    , m_sending(framesOfOneLink, FaultStream::LargestFrame)
    , m_receiving(framesOfOneLink, FaultStream::LargestFrame)
{
}

void FaultLink::sendDue() noexcept
{
    bool any = false;
    for (DelayLine::Frame due; m_sending.take(m_time.now(), &due); any = true)
        m_link->send(due.bytes, due.size);
    if (any)
        m_link->flush();
}

bool FaultLink::takeDue(const char **frame, std::size_t *size) noexcept
{
    DelayLine::Frame due;
    if (!m_receiving.take(m_time.now(), &due))
        return false;
    *frame = due.bytes;
    *size = due.size;
    return true;
}

CyclicLink::Status FaultLink::receive(const char **frame, std::size_t *size) noexcept
{
    const Status status = poll(frame, size);
    if (status != Nothing)
        return status;
    const std::int64_t due = std::min(m_sending.nextDue(), m_receiving.nextDue());
    if (due != DelayLine::Never) {
        m_time.sleepUntil(std::min(due, m_time.now() + Look));
        return Nothing;
    }
    const Status arrived = m_link->receive(frame, size);
    // Who gets nothing asks again, and looks at what else there is to do before.
    if (arrived == Received && !m_received.passes(m_time.now(), *frame, *size, m_receiving, this))
        return Nothing;
    return arrived;
}

CyclicLink::Status FaultLink::poll(const char **frame, std::size_t *size) noexcept
{
    sendDue();
    if (takeDue(frame, size))
        return Received;
    Status status = m_link->poll(frame, size);
    while (status == Received && !m_received.passes(m_time.now(), *frame, *size, m_receiving, this)) {
        if (takeDue(frame, size))
            return Received;
        status = m_link->poll(frame, size);
    }
    return status;
}

bool FaultLink::send(const char *frame, std::size_t size) noexcept
{
    // What a bad network does to a frame is no failure of sending it.
    return !m_sent.passes(m_time.now(), frame, size, m_sending, this) || m_link->send(frame, size);
}

}  // namespace qplc
