// SPDX-License-Identifier: Apache-2.0
#include "RecordRing.h"

#include <algorithm>
#include <cstring>
#include <sys/statvfs.h>

namespace qplc {

namespace {

constexpr std::size_t SmallestRing = std::size_t(1) << 20;
constexpr std::size_t LargestRing = std::size_t(64) << 20;
constexpr auto LastTextSize = std::uint32_t(sizeof(RecordHead) + sizeof(RecordedText));

}  // namespace

std::uint64_t RegionWriter::unread() const noexcept
{
    const RingMarks &header = *m_region.marks;
    if (!isRead())
        return 0;
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    const std::uint64_t read = header.read.load(std::memory_order_acquire);
    return read <= head ? std::min(head - read, m_region.capacity) : 0;  // a recorder cannot be ahead
}

char *RegionWriter::begin(std::uint32_t size, std::uint32_t reserve) noexcept
{
    const std::uint64_t capacity = m_region.capacity;
    if (std::uint64_t(size) + reserve > capacity - unread())
        return nullptr;
    RingMarks &header = *m_region.marks;
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    std::uint64_t oldest = header.oldest.load(std::memory_order_relaxed);
    if (head + size - oldest > capacity) {
        do {
            RecordHead old;
            std::memcpy(&old, m_region.at(oldest), sizeof old);
            oldest = std::min(head, oldest + std::max(old.size, std::uint32_t(sizeof old)));
        } while (head + size - oldest > capacity);
        // Readers look at `oldest` after they have copied a record: from here on it may be torn.
        header.oldest.store(oldest, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
    }
    return m_region.at(head) + sizeof(RecordHead);
}

void RegionWriter::commit(RecordKind kind, std::uint32_t size) noexcept
{
    RingMarks &header = *m_region.marks;
    const std::uint64_t head = header.head.load(std::memory_order_relaxed);
    const RecordHead record{head, size, kind, 0};
    std::memcpy(m_region.at(head), &record, sizeof record);
    header.head.store(head + size, std::memory_order_release);
}

bool RecordRing::create(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error,
                        std::size_t textCapacity)
{
    if (!m_memory.create(file, capacity, description, error, textCapacity))
        return false;
    static_cast<RegionWriter &>(*this) = RegionWriter(m_memory.cycles());
    m_texts = RegionWriter(m_memory.texts());
    return true;
}

void RecordRing::addText(RecordedText head, const QByteArray &text)
{
    head.number = ++m_lastText;
    head.textSize = std::uint32_t(text.size());
    const std::uint32_t padded = paddedRecordSize(head.textSize);
    const std::uint32_t size = std::uint32_t(sizeof(RecordHead) + sizeof head) + padded;
    // A text that is long must not replace all others. The last one always finds room.
    if (size > m_texts.capacity() / 8)
        return;
    char *to = m_texts.begin(size, LastTextSize);
    if (!to)
        return;
    std::memcpy(to, &head, sizeof head);
    std::memcpy(to + sizeof head, text.constData(), head.textSize);
    std::memset(to + sizeof head + head.textSize, 0, padded - head.textSize);
    m_texts.commit(RecordKind::Text, size);
}

void RecordRing::endTexts()
{
    RecordedText last;
    last.number = ++m_lastText;
    char *to = m_texts.capacity() > 0 ? m_texts.begin(LastTextSize) : nullptr;
    if (!to)
        return;
    std::memcpy(to, &last, sizeof last);
    m_texts.commit(RecordKind::LastText, LastTextSize);
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
