// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace qplc {

/// Touches \a size bytes of the calling thread's stack below the present frame, so that no cycle
/// meets one of their pages for the first time. \return [byte] of them that are in memory now;
/// fewer than \a size when the stack is too small or memory ran out
std::size_t prefaultStack(std::size_t size) noexcept;

}  // namespace qplc
