// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// What a thread needs memory for while this object lives: where there is not enough, the message
/// of tellAtTheEnd() names the newest one.
class MemoryNeed
{
public:
    /// \param what  a literal: "the signal table"
    /// \param bytes  that it needs, at least; 0: nobody knows
    /// \param remedy  a literal: "use fewer signals"
    MemoryNeed(const char *what, std::uint64_t bytes, const char *remedy) noexcept;
    ~MemoryNeed();
    MemoryNeed(const MemoryNeed &) = delete;
    MemoryNeed &operator=(const MemoryNeed &) = delete;

    /// From now on, a program that ends because nothing catches std::bad_alloc says on its standard
    /// error what it needed, what it may have, and what to do. Its exit code is 1.
    static void tellAtTheEnd() noexcept;

private:
    friend struct MemoryText;
    const char *const m_what;
    const std::uint64_t m_bytes;
    const char *const m_remedy;
    const MemoryNeed *const m_outer;
};

}  // namespace qplc
