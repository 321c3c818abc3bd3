// SPDX-License-Identifier: Apache-2.0
#include "RingReader.h"

#include <cstring>

namespace qplc {

// ---- a region ----

void RegionReader::open(const RingRegion &region)
{
    m_region = region;
    m_place = 0;
    m_isAttached = false;
}

void RegionReader::attach()
{
    if (isEmpty())
        return;
    RingMarks &marks = *m_region.marks;
    const bool isGoingOn = marks.isRead.load() != 0;
    m_place = isGoingOn ? marks.read.load() : marks.oldest.load();
    if (!isGoingOn)
        leaveRoom();
    marks.read.store(m_place);
    marks.isRead.store(1);
    m_isAttached = true;
}

/// A region that nobody has recorded is full: without the oldest records, the writer has room.
void RegionReader::leaveRoom()
{
    const std::uint64_t most = m_region.capacity / 8 * 7;
    const std::uint64_t head = m_region.marks->head.load(std::memory_order_acquire);
    while (m_place < head && head - m_place > most) {
        RecordHead record;
        std::memcpy(&record, m_region.at(m_place), sizeof record);
        if (record.commit != m_place || record.size < sizeof record || record.size > head - m_place)
            break;  // replaced meanwhile, or damaged: next() sees it
        m_place += record.size;
    }
}

void RegionReader::detach()
{
    if (m_isAttached)
        m_region.marks->isRead.store(0);
    m_isAttached = false;
}

RegionReader::Result RegionReader::next()
{
    const RingMarks &marks = *m_region.marks;
    const std::uint64_t head = marks.head.load(std::memory_order_acquire);
    const auto jumpTo = [this](std::uint64_t place, Result result) {
        m_place = place;
        return result;
    };
    if (m_place == head)
        return Nothing;
    if (m_place < marks.oldest.load(std::memory_order_acquire))
        return jumpTo(marks.oldest.load(std::memory_order_acquire), Lost);
    // Without bytes, or with a head before its end, nothing can be read.
    const bool isPlace = m_place < head && m_region.capacity > 0;
    if (isPlace)
        std::memcpy(&m_head, m_region.at(m_place), sizeof m_head);
    // What is written does not end beyond the head, and is not longer than the ring.
    const bool isRecord = isPlace && head - m_place <= m_region.capacity && m_head.commit == m_place
        && m_head.size >= sizeof m_head && m_head.size % 8 == 0 && m_head.size <= head - m_place;
    if (isRecord)
        m_body.assign(m_region.at(m_place) + sizeof m_head, m_region.at(m_place) + m_head.size);
    std::atomic_thread_fence(std::memory_order_acquire);
    const std::uint64_t oldest = marks.oldest.load(std::memory_order_relaxed);
    if (m_place < oldest)
        return jumpTo(oldest, Lost);
    return isRecord ? jumpTo(m_place + m_head.size, Found) : jumpTo(head, Damaged);
}

void RegionReader::release()
{
    if (m_isAttached)
        m_region.marks->read.store(m_place, std::memory_order_release);
}

// ---- a ring ----

bool RingReader::open(const QByteArray &file, QString *error)
{
    detach();
    if (!m_memory.open(file, error))
        return false;
    RegionReader::open(m_memory.cycles());
    m_texts.open(m_memory.texts());
    return true;
}

bool RingReader::attach()
{
    if (m_isAttached)
        return true;
    if (!m_memory.lock(RingMemory::RecorderLock))
        return false;
    m_texts.attach();
    RegionReader::attach();
    m_isAttached = true;
    return true;
}

void RingReader::detach()
{
    if (!m_isAttached)
        return;
    RegionReader::detach();
    m_texts.detach();
    m_memory.unlock(RingMemory::RecorderLock);
    m_isAttached = false;
}

void RingReader::release()
{
    m_texts.release();
    RegionReader::release();
}

void RingReader::report(const RecorderReport &report)
{
    if (m_isAttached)
        m_memory.header()->report.write(report);
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
