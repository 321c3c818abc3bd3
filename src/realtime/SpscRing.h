// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace qplc {

/// A bounded queue from one thread to one other, without locks, waits or allocations after
/// construction. A full ring refuses; nothing is overwritten. T is copied as a whole and must be
/// trivially copyable.
template<typename T>
class SpscRing
{
    static_assert(std::is_trivially_copyable_v<T>, "values cross threads as plain bytes");

public:
    /// \param capacity  at least 1, rounded up to a power of two
    explicit SpscRing(std::size_t capacity)
    {
        std::size_t size = 1;
        while (size < capacity)
            size *= 2;
        m_mask = size - 1;
        m_items.reset(new T[size]());  // written now, so that no push meets a page for the first time
    }

    std::size_t capacity() const { return m_mask + 1; }

    /// The place of the next value, to be filled and then given by commitPush(); null when the ring
    /// is full. Producer only.
    /// \param reserve places that stay free for others: with so few left the ring is full. Less
    ///         than capacity()
    T *beginPush(std::size_t reserve = 0) noexcept
    {
        const std::size_t head = m_head.load(std::memory_order_relaxed);
        if (head - m_cachedTail > m_mask - reserve) {
            m_cachedTail = m_tail.load(std::memory_order_acquire);
            if (head - m_cachedTail > m_mask - reserve)
                return nullptr;
        }
        return &m_items[head & m_mask];
    }
    void commitPush() noexcept { m_head.store(m_head.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// \return false when the ring is full. Producer only.
    bool push(const T &value, std::size_t reserve = 0) noexcept
    {
        T *place = beginPush(reserve);
        if (!place)
            return false;
        *place = value;
        commitPush();
        return true;
    }

    /// The oldest value, null when there is none. Consumer only.
    const T *front() noexcept
    {
        const std::size_t tail = m_tail.load(std::memory_order_relaxed);
        if (tail == m_cachedHead) {
            m_cachedHead = m_head.load(std::memory_order_acquire);
            if (tail == m_cachedHead)
                return nullptr;
        }
        return &m_items[tail & m_mask];
    }
    /// Removes the oldest value. \pre front() was not null. Consumer only.
    void pop() noexcept { m_tail.store(m_tail.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// \return false when there is none. Consumer only.
    bool pop(T *value) noexcept
    {
        const T *oldest = front();
        if (!oldest)
            return false;
        *value = *oldest;
        pop();
        return true;
    }

private:
    std::unique_ptr<T[]> m_items;
    std::size_t m_mask = 0;
    alignas(64) std::atomic<std::size_t> m_head{0};  // producer
    std::size_t m_cachedTail = 0;                    // producer
    alignas(64) std::atomic<std::size_t> m_tail{0};  // consumer
    std::size_t m_cachedHead = 0;                    // consumer
};

}  // namespace qplc
