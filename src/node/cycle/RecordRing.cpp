// SPDX-License-Identifier: Apache-2.0
#include "RecordRing.h"

#include <algorithm>
#include <cstring>
#include <sys/statvfs.h>

namespace qplc {

namespace {

constexpr std::size_t SmallestRing = std::size_t(1) << 20;
constexpr std::size_t LargestRing = std::size_t(64) << 20;

}  // namespace

std::uint64_t RecordRing::unread() const noexcept
{
    const RingMemory::Header &header = *m_memory.header();
    if (!isRead())
        return 0;
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    const std::uint64_t read = header.read.load(std::memory_order_acquire);
    return read <= head ? std::min(head - read, m_memory.capacity()) : 0;  // a recorder cannot be ahead
}

char *RecordRing::begin(std::uint32_t size, std::uint32_t reserve) noexcept
{
    const std::uint64_t capacity = m_memory.capacity();
    if (std::uint64_t(size) + reserve > capacity - unread())
        return nullptr;
    RingMemory::Header &header = *m_memory.header();
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    std::uint64_t oldest = header.oldest.load(std::memory_order_relaxed);
    if (head + size - oldest > capacity) {
        do {
            RecordHead old;
            std::memcpy(&old, m_memory.at(oldest), sizeof old);
            oldest = std::min(head, oldest + std::max(old.size, std::uint32_t(sizeof old)));
        } while (head + size - oldest > capacity);
        // Readers look at `oldest` after they have copied a record: from here on it may be torn.
        header.oldest.store(oldest, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
    }
    return m_memory.at(head) + sizeof(RecordHead);
}

void RecordRing::commit(RecordKind kind, std::uint32_t size) noexcept
{
    RingMemory::Header &header = *m_memory.header();
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    const RecordHead record{head, size, kind, 0};
    std::memcpy(m_memory.at(head), &record, sizeof record);
    header.head.store(head + size, std::memory_order_release);
}

std::size_t RecordRing::capacityFor(double recordsPerSecond, double seconds, std::size_t recordSize,
                                    const QByteArray &folder)
{
    std::size_t most = LargestRing;
    struct statvfs status = {};
    if (::statvfs(folder.constData(), &status) == 0)
        most = std::min(most, std::size_t(status.f_bavail) * status.f_frsize / 4);
    const double wanted = std::min(recordsPerSecond * seconds * double(recordSize), double(LargestRing));
    const std::size_t smallest = std::max(SmallestRing, 4 * recordSize);
    std::size_t capacity = SmallestRing;
    while (capacity < smallest || (double(capacity) < wanted && 2 * capacity <= most))
        capacity *= 2;
    return capacity;
}

}  // namespace qplc
