// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace qplc {

/// [byte]
std::size_t pageSize() noexcept;

/// [byte] of the \a size bytes from \a begin on whose pages are in memory. Pages that are not
/// mapped are not.
std::size_t residentBytes(std::uintptr_t begin, std::size_t size) noexcept;

}  // namespace qplc
