// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace qplc {

/// Makes the heap keep what is given back to it, and puts \a size bytes into it whose pages are in
/// memory: a block is taken, touched and given back. What is allocated later comes from there and
/// meets no new page, and nothing that is freed goes back to the system, which would only be asked
/// for it again. From then on large blocks have no mappings of their own either.
///
/// It is the heap of the calling thread; other threads may have arenas of their own. Once in a
/// process: who asks again for no more than there was gets the answer of the first time, whatever
/// has been used of it since.
/// \return [byte] of them that were in memory after they had been given back; 0 with another C
///         library than that of
/// GNU, and under a sanitizer, which has a heap of its own
/// \threadsafe yes
std::size_t reserveHeap(std::size_t size) noexcept;

}  // namespace qplc
