// SPDX-License-Identifier: Apache-2.0
#include "HeapReserve.h"

#include "ResidentPages.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define QTPLC_HEAP_OF_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define QTPLC_HEAP_OF_SANITIZER
#endif
#endif

#if defined(__GLIBC__) && !defined(QTPLC_HEAP_OF_SANITIZER)
#define QTPLC_HEAP_OF_GLIBC
#include <malloc.h>
#endif

namespace qplc {

namespace {

/// \return false when the heap does not listen
bool keepWhatIsFreed() noexcept
{
#ifdef QTPLC_HEAP_OF_GLIBC
    // No free end of the heap is large enough to be given back, and no block large enough for a
    // mapping of its own.
    return mallopt(M_TRIM_THRESHOLD, -1) == 1 && mallopt(M_MMAP_MAX, 0) == 1;
#else
    return false;
#endif
}

/// \return [byte] that are in memory afterwards
std::size_t takeTouchAndGiveBack(std::size_t size) noexcept
{
    auto *const block = static_cast<volatile char *>(std::malloc(size));
    if (!block)
        return 0;
    for (std::size_t at = 0; at < size; at += pageSize())
        block[at] = 0;
    block[size - 1] = 0;
    const auto begin = std::uintptr_t(block);
    std::free(const_cast<char *>(block));
    return residentBytes(begin, size);
}

}  // namespace

std::size_t reserveHeap(std::size_t size) noexcept
{
    static std::mutex mutex;
    static std::size_t reserved = 0;
    const std::lock_guard<std::mutex> lock(mutex);
    if (size > reserved && keepWhatIsFreed())
        reserved = std::max(reserved, takeTouchAndGiveBack(size));
    return std::min(size, reserved);
}

}  // namespace qplc
