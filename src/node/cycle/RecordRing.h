// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecordLayout.h"
#include "RingMemory.h"

#include <cstddef>

namespace qplc {

/// Writes the records of a phase into a RingMemory.
///
/// While nobody records, a new record replaces the oldest ones: the ring shows the last seconds.
/// While somebody records, records that it has not put to safety stay, and a new one may find no
/// room. Neither allocates, locks, or calls the system.
///
/// The functions that write are for one thread.
class RecordRing
{
public:
    /// See RingMemory::create().
    bool create(const QByteArray &file, std::size_t capacity, const QByteArray &description, QString *error)
    {
        return m_memory.create(file, capacity, description, error);
    }
    RingMemory &memory() { return m_memory; }
    const RingMemory &memory() const { return m_memory; }

    /// The place of the next record, behind its head. Null: there is no room.
    /// \param size [byte] of the record with its head, a multiple of 8
    /// \param reserve [byte] of room that has to be left for others
    char *begin(std::uint32_t size, std::uint32_t reserve = 0) noexcept;
    /// The record at the place of begin() is complete.
    void commit(RecordKind kind, std::uint32_t size) noexcept;
    /// Whether begin() finds room.
    bool hasRoomFor(std::uint32_t size) const noexcept { return m_memory.capacity() - unread() >= size; }
    /// Whether somebody records, and so limits the room. \threadsafe yes
    bool isRead() const noexcept { return m_memory.header()->isRead.load(std::memory_order_acquire) != 0; }
    /// How far it has put records to safety; grows. \threadsafe yes
    std::uint64_t readPlace() const noexcept { return m_memory.header()->read.load(std::memory_order_acquire); }

    /// A size of a ring [byte] that holds \a seconds of records of \a recordSize bytes, in the
    /// limits of smallest and largest ring and of what the file system of \a folder has free.
    static std::size_t capacityFor(double recordsPerSecond, double seconds, std::size_t recordSize,
                                   const QByteArray &folder);

private:
    std::uint64_t unread() const noexcept;

    RingMemory m_memory;
};

}  // namespace qplc
