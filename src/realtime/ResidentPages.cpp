// SPDX-License-Identifier: Apache-2.0
#include "ResidentPages.h"

#include <algorithm>
#include <sys/mman.h>
#include <unistd.h>

namespace qplc {

std::size_t pageSize() noexcept
{
    return std::size_t(sysconf(_SC_PAGESIZE));
}

std::size_t residentBytes(std::uintptr_t begin, std::size_t size) noexcept
{
    const std::size_t page = pageSize();
    const std::uintptr_t end = begin + size;
    std::size_t resident = 0;
    for (std::uintptr_t at = begin - begin % page; at < end; at += page) {
        unsigned char state = 0;
        if (mincore(reinterpret_cast<void *>(at), page, &state) == 0 && (state & 1) != 0)
            resident += std::min(at + page, end) - std::max(at, begin);
    }
    return resident;
}

}  // namespace qplc
