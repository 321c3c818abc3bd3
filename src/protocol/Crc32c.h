// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace qplc {

/// CRC-32C (Castagnoli, reflected polynomial 0x82F63B78, initial value and final inversion as in
/// iSCSI, RFC 3720).
/// \param crc result of the bytes before, 0 at the beginning; so crc32c(crc32c(0, a), b) ==
///         crc32c(0, ab)
/// Uses the instruction of the processor where there is one. Thread-safe, allocation-free.
std::uint32_t crc32c(std::uint32_t crc, const void *bytes, std::size_t size) noexcept;

/// The same by table alone: what the instruction is tested against.
std::uint32_t crc32cByTable(std::uint32_t crc, const void *bytes, std::size_t size) noexcept;

}  // namespace qplc
