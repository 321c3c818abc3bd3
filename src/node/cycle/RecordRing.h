// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecordLayout.h"
#include "RingMemory.h"

#include <cstddef>

namespace qplc {

/// Writes records into a region of a ring.
///
/// While nobody records, a new record replaces the oldest ones: the region shows the last seconds.
/// While somebody records, records that it has not put to safety stay, and a new one may find no
/// room. Neither allocates, locks, or calls the system.
///
/// The functions that write are for one thread.
class RegionWriter
{
public:
    RegionWriter() = default;
    explicit RegionWriter(const RingRegion &region)
        : m_region(region)
    {
    }

    /// The place of the next record, behind its head. Null: there is no room.
    /// \param size [byte] of the record with its head, a multiple of 8
    /// \param reserve [byte] of room that has to be left for others
    char *begin(std::uint32_t size, std::uint32_t reserve = 0) noexcept;
    /// The record at the place of begin() is complete.
    void commit(RecordKind kind, std::uint32_t size) noexcept;
    /// Whether begin() finds room.
    bool hasRoomFor(std::uint32_t size) const noexcept { return m_region.capacity - unread() >= size; }
    /// [byte] of all that was written
    std::uint64_t head() const noexcept { return m_region.marks->head.load(std::memory_order_relaxed); }
    std::uint64_t capacity() const noexcept { return m_region.capacity; }
    /// Whether somebody records, and so limits the room. \threadsafe yes
    bool isRead() const noexcept { return m_region.marks->isRead.load(std::memory_order_acquire) != 0; }
    /// How far it has put records to safety; grows. \threadsafe yes
    std::uint64_t readPlace() const noexcept { return m_region.marks->read.load(std::memory_order_acquire); }

private:
    std::uint64_t unread() const noexcept;

    RingRegion m_region;
};

/// Writes what happens in a phase into a RingMemory: the records of its cycles, for the cycle
/// thread, and texts, for the thread of the master.
class RecordRing : public RegionWriter
{
public:
    /// See RingMemory::create().
    bool create(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error,
                std::size_t textCapacity = 0);
    RingMemory &memory() { return m_memory; }
    const RingMemory &memory() const { return m_memory; }

    /// Writes a text, and counts it. Without room it is counted only, and the numbers of the others
    /// tell it.
    /// \param head  number and size come from here
    void addText(RecordedText head, const QByteArray &text);
    /// A text that is not told is counted.
    void leaveOutText() { ++m_lastText; }
    /// No text follows.
    void endTexts();

    /// A size of a ring [byte] that holds \a seconds of records of \a recordSize bytes, in the
    /// limits of smallest and largest ring and of what the file system of \a folder has free.
    static std::size_t capacityFor(double recordsPerSecond, double seconds, std::size_t recordSize,
                                   const QByteArray &folder);

private:
    RingMemory m_memory;
    RegionWriter m_texts;
    std::uint64_t m_lastText = 0;  // number
};

}  // namespace qplc
