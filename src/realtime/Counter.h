// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace qplc {

/// A number that one thread counts and any thread may read.
class Counter
{
public:
    /// Counting thread only: a load and a store, several times faster than a locked increment.
    void add(std::uint64_t n = 1) noexcept
    {
        m_value.store(m_value.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
    }
    void set(std::uint64_t value) noexcept { m_value.store(value, std::memory_order_relaxed); }
    std::uint64_t value() const noexcept { return m_value.load(std::memory_order_relaxed); }
    operator std::uint64_t() const noexcept { return value(); }

private:
    std::atomic<std::uint64_t> m_value{0};
};

}  // namespace qplc
