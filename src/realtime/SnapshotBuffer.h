// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace qplc {

/// The newest state of something: one thread publishes a fixed number of bytes, any other may take
/// a consistent copy.
///
/// A sequence lock over two slots. The writer never waits, whatever the readers do. It fills the
/// slot that is not the published one, so a writer that is preempted in the middle of it does not
/// hold up a reader either: a copy is repeated only when a whole publication has been completed
/// meanwhile. Allocation-free after construction.
class SnapshotBuffer
{
public:
    /// \param size  [byte] of a snapshot; 0 leaves the stamp alone
    explicit SnapshotBuffer(std::size_t size);

    std::size_t size() const noexcept { return m_size; }

    /// Replaces the snapshot by size() bytes. Writer only.
    /// \param stamp  what tells the snapshots apart: cycle number, time, ...
    void publish(const void *bytes, std::uint64_t stamp) noexcept;

    /// Copies the newest snapshot to \a bytes, which has room for size() bytes, and its stamp. Any
    /// thread.
    /// \param stamp  may be null
    /// \return false before the first publication; nothing is written then
    bool read(void *bytes, std::uint64_t *stamp) const noexcept;

private:
    using Word = std::atomic<std::uint64_t>;

    Word *slot(std::uint64_t publication) const noexcept { return &m_words[(publication & 1) * m_wordsPerSlot]; }

    std::size_t m_size = 0;
    std::size_t m_wordsPerSlot = 0;  // the first one is the stamp
    std::unique_ptr<Word[]> m_words;
    alignas(64) std::atomic<std::uint64_t> m_published{0};  // publications completed
};

}  // namespace qplc
