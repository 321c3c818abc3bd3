// SPDX-License-Identifier: Apache-2.0
#include "RingReader.h"

#include <cstring>

namespace qplc {

bool RingReader::open(const QByteArray &file, QString *error)
{
    detach();
    m_place = 0;
    return m_memory.open(file, error);
}

bool RingReader::attach()
{
    if (m_isAttached)
        return true;
    if (!m_memory.lock(RingMemory::RecorderLock))
        return false;
    RingMemory::Header &header = *m_memory.header();
    const bool isGoingOn = header.isRead.load() != 0;
    m_place = isGoingOn ? header.read.load() : header.oldest.load();
    if (!isGoingOn)
        leaveRoom();
    header.read.store(m_place);
    header.isRead.store(1);
    m_isAttached = true;
    return true;
}

/// A ring that nobody has recorded is full: without the oldest records, the writer has room.
void RingReader::leaveRoom()
{
    const std::uint64_t most = m_memory.capacity() / 8 * 7;
    const std::uint64_t head = m_memory.header()->head.load(std::memory_order_acquire);
    while (m_place < head && head - m_place > most) {
        RecordHead record;
        std::memcpy(&record, m_memory.at(m_place), sizeof record);
        if (record.commit != m_place || record.size < sizeof record || record.size > head - m_place)
            break;  // replaced meanwhile, or damaged: next() sees it
        m_place += record.size;
    }
}

void RingReader::detach()
{
    if (!m_isAttached)
        return;
    m_memory.header()->isRead.store(0);
    m_memory.unlock(RingMemory::RecorderLock);
    m_isAttached = false;
}

RingReader::Result RingReader::next()
{
    const RingMemory::Header &header = *m_memory.header();
    const std::uint64_t head = header.head.load(std::memory_order_acquire);
    const auto jumpTo = [this](std::uint64_t place, Result result) {
        m_place = place;
        return result;
    };
    if (m_place == head)
        return Nothing;
    if (m_place < header.oldest.load(std::memory_order_acquire))
        return jumpTo(header.oldest.load(std::memory_order_acquire), Lost);
    std::memcpy(&m_head, m_memory.at(m_place), sizeof m_head);
    // What is written does not end beyond the head, and is not longer than the ring.
    const bool isRecord = m_place < head && head - m_place <= m_memory.capacity() && m_head.commit == m_place
        && m_head.size >= sizeof m_head && m_head.size % 8 == 0 && m_head.size <= head - m_place;
    if (isRecord)
        m_body.assign(m_memory.at(m_place) + sizeof m_head, m_memory.at(m_place) + m_head.size);
    std::atomic_thread_fence(std::memory_order_acquire);
    const std::uint64_t oldest = header.oldest.load(std::memory_order_relaxed);
    if (m_place < oldest)
        return jumpTo(oldest, Lost);
    return isRecord ? jumpTo(m_place + m_head.size, Found) : jumpTo(head, Damaged);
}

void RingReader::release()
{
    if (m_isAttached)
        m_memory.header()->read.store(m_place, std::memory_order_release);
}

RecordedNode CycleView::node(std::uint32_t number) const noexcept
{
    RecordedNode record;
    std::memcpy(&record, nodes + std::size_t(number) * sizeof record, sizeof record);
    return record;
}

bool CycleView::read(const char *body, std::uint32_t size, CycleView *view) noexcept
{
    RecordedCycle &cycle = view->cycle;
    if (size < sizeof cycle)
        return false;
    std::memcpy(&cycle, body, sizeof cycle);
    const auto padded = [](std::uint32_t bytes) { return (std::uint64_t(bytes) + 7) & ~std::uint64_t(7); };
    const std::uint64_t nodes = std::uint64_t(cycle.nodes) * sizeof(RecordedNode);
    const std::uint64_t image = padded(cycle.imageSize);
    const std::uint64_t before = padded(cycle.beforeSize);
    if (sizeof cycle + nodes + image + before + cycle.rawSize != size
        || (cycle.beforeSize != 0 && cycle.beforeSize != cycle.imageSize))
        return false;
    view->nodes = body + sizeof cycle;
    view->image = view->nodes + nodes;
    view->before = view->image + image;
    view->raw = view->before + before;
    return true;
}

}  // namespace qplc
