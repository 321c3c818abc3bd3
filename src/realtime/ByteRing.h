// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

namespace qplc {

/// As SpscRing, for items whose size is known only at run time: a bounded queue of blocks of bytes
/// from one thread to one other.
class ByteRing
{
public:
    /// \param capacity  number of items, rounded up to a power of two
    ByteRing(std::size_t itemSize, std::size_t capacity)
        : m_itemSize(itemSize)
    {
        std::size_t size = 1;
        while (size < capacity)
            size *= 2;
        m_mask = size - 1;
        m_bytes.reset(new char[size * itemSize]());
    }

    std::size_t itemSize() const { return m_itemSize; }
    std::size_t capacity() const { return m_mask + 1; }

    /// The place of the next item, to be filled and then given by commitPush(); null when the ring
    /// is full. Producer only.
    char *beginPush() noexcept
    {
        const std::size_t head = m_head.load(std::memory_order_relaxed);
        if (head - m_tail.load(std::memory_order_acquire) > m_mask)
            return nullptr;
        return m_bytes.get() + (head & m_mask) * m_itemSize;
    }
    void commitPush() noexcept { m_head.store(m_head.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// The oldest item, null when there is none. Consumer only.
    const char *front() const noexcept
    {
        const std::size_t tail = m_tail.load(std::memory_order_relaxed);
        if (tail == m_head.load(std::memory_order_acquire))
            return nullptr;
        return m_bytes.get() + (tail & m_mask) * m_itemSize;
    }
    /// Removes the oldest item. \pre front() was not null. Consumer only.
    void pop() noexcept { m_tail.store(m_tail.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

private:
    const std::size_t m_itemSize;
    std::size_t m_mask = 0;
    std::unique_ptr<char[]> m_bytes;
    alignas(64) std::atomic<std::size_t> m_head{0};  // producer
    alignas(64) std::atomic<std::size_t> m_tail{0};  // consumer
};

}  // namespace qplc
