// SPDX-License-Identifier: Apache-2.0
#include "StackPrefault.h"

#include "ResidentPages.h"

#include <algorithm>
#include <alloca.h>
#include <pthread.h>

namespace qplc {

namespace {

constexpr std::size_t Reserve
    = std::size_t(32) * 1024;  // [byte] left alone at the end of the stack, for the calls made here

/// [byte] of the calling thread's stack below \a address, without the reserve.
std::size_t roomBelow(std::uintptr_t address) noexcept
{
    pthread_attr_t attributes;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0)
        return 0;
    void *lowest = nullptr;
    std::size_t size = 0;
    pthread_attr_getstack(&attributes, &lowest, &size);
    pthread_attr_destroy(&attributes);
    const std::uintptr_t end = std::uintptr_t(lowest) + Reserve;
    return address > end ? address - end : 0;
}

/// \return [byte] that are in memory afterwards
__attribute__((noinline)) std::size_t touch(std::size_t size) noexcept
{
    auto *bytes = static_cast<char *>(alloca(size));
    const std::size_t page = pageSize();
    for (std::size_t left = size; left > 0; left -= std::min(left, page))
        *static_cast<volatile char *>(bytes + left - 1) = 0;  // downwards, as a stack grows
    *static_cast<volatile char *>(bytes) = 0;
    return residentBytes(std::uintptr_t(bytes), size);
}

}  // namespace

std::size_t prefaultStack(std::size_t size) noexcept
{
    size = std::min(size, roomBelow(std::uintptr_t(__builtin_frame_address(0))));
    return size > 0 ? touch(size) : 0;
}

}  // namespace qplc
