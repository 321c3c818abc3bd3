// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace qplc {

/// Keeps copies of frames until they are due. Allocation-free after construction; used by one
/// thread.
class DelayLine
{
public:
    struct Frame
    {
        void *owner = nullptr;
        char *bytes = nullptr;
        std::size_t size = 0;
    };
    static constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::max();

    /// \param capacity  frames  \param largestFrame  [byte]
    DelayLine(std::size_t capacity, std::size_t largestFrame);

    /// Keeps a copy until \a due [ns]. Frames that are due at the same time come in the order in
    /// which they were put.
    /// \return the bytes of the copy; null when there is no room, or the frame is too large
    char *put(std::int64_t due, void *owner, const char *frame, std::size_t size) noexcept;
    /// The oldest frame that is due at \a now; it stays valid until the next call. \return false
    /// when there is none
    bool take(std::int64_t now, Frame *frame) noexcept;
    /// When the next frame is due [ns]; Never: there is none.
    std::int64_t nextDue() const noexcept { return m_waiting.empty() ? Never : m_waiting.front().due; }
    /// Drops all frames of \a owner.
    void forget(const void *owner) noexcept;

private:
    struct Entry
    {
        std::int64_t due;
        std::uint64_t number;
        std::size_t place;  // in m_bytes
        void *owner;
        std::size_t size;
    };
    static bool isLater(const Entry &a, const Entry &b) noexcept;

    const std::size_t m_largestFrame;
    std::vector<char> m_bytes;
    std::vector<std::size_t> m_free;
    std::vector<Entry> m_waiting;  // a heap, the next one that is due at the front
    std::uint64_t m_number = 0;
    std::size_t m_taken;  // place of the frame that was given out last
};

}  // namespace qplc
