// SPDX-License-Identifier: Apache-2.0
#include "SnapshotBuffer.h"

#include <cstring>

#if defined(__SANITIZE_THREAD__) && !defined(__clang__)
#pragma GCC diagnostic ignored                                                                                         \
    "-Wtsan"  // the fences go unseen; every shared word is atomic, so no report depends on them
#endif

namespace qplc {

namespace {

constexpr std::size_t WordSize = sizeof(std::uint64_t);
constexpr std::size_t CacheLine = 64;

// Whole cache lines, so that the writer's slot and the readers' slot share none.
std::size_t wordsFor(std::size_t size)
{
    return (WordSize + size + CacheLine - 1) / CacheLine * (CacheLine / WordSize);
}

}  // namespace

SnapshotBuffer::SnapshotBuffer(std::size_t size)
    : m_size(size)
    , m_wordsPerSlot(wordsFor(size))
    , m_words(new Word[2 * m_wordsPerSlot]())
{
}

void SnapshotBuffer::publish(const void *bytes, std::uint64_t stamp) noexcept
{
    const std::uint64_t publication = m_published.load(std::memory_order_relaxed);
    // A reader that sees a word of this publication shall also see that the one before it was
    // completed.
    std::atomic_thread_fence(std::memory_order_release);

    Word *word = slot(publication);
    word->store(stamp, std::memory_order_relaxed);
    const auto *source = static_cast<const unsigned char *>(bytes);
    std::size_t left = m_size;
    for (; left >= WordSize; left -= WordSize, source += WordSize) {
        std::uint64_t value = 0;
        std::memcpy(&value, source, WordSize);
        (++word)->store(value, std::memory_order_relaxed);
    }
    if (left > 0) {
        std::uint64_t value = 0;
        std::memcpy(&value, source, left);
        (++word)->store(value, std::memory_order_relaxed);
    }
    m_published.store(publication + 1, std::memory_order_release);
}

bool SnapshotBuffer::read(void *bytes, std::uint64_t *stamp) const noexcept
{
    std::uint64_t published = 0;
    do {
        published = m_published.load(std::memory_order_acquire);
        if (published == 0)
            return false;

        const Word *word = slot(published - 1);
        const std::uint64_t itsStamp = word->load(std::memory_order_relaxed);
        auto *target = static_cast<unsigned char *>(bytes);
        std::size_t left = m_size;
        for (; left >= WordSize; left -= WordSize, target += WordSize) {
            const std::uint64_t value = (++word)->load(std::memory_order_relaxed);
            std::memcpy(target, &value, WordSize);
        }
        if (left > 0) {
            const std::uint64_t value = (++word)->load(std::memory_order_relaxed);
            std::memcpy(target, &value, left);
        }
        if (stamp)
            *stamp = itsStamp;
        std::atomic_thread_fence(std::memory_order_acquire);
        // The slot is written again only after another publication has been completed.
    } while (m_published.load(std::memory_order_relaxed) != published);
    return true;
}

}  // namespace qplc
