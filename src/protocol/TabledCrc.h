// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LittleEndian.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace qplc {

/// A CRC of 32 bits, computed by tables, eight bytes at a time. Initial value and result are
/// inverted. Thread-safe, allocation-free.
/// \tparam Polynomial  its bits reflected
template<std::uint32_t Polynomial>
class TabledCrc
{
public:
    /// \param crc  result of the bytes before, 0 at the beginning
    static std::uint32_t of(std::uint32_t crc, const char *bytes, std::size_t size) noexcept
    {
        std::uint32_t state = ~crc;
        for (; size >= Word; size -= Word, bytes += Word) {
            const std::uint32_t low = loadLittle<std::uint32_t>(bytes) ^ state;
            const auto high = loadLittle<std::uint32_t>(bytes + 4);
            state = tables[7][low & 0xFF] ^ tables[6][(low >> 8) & 0xFF] ^ tables[5][(low >> 16) & 0xFF]
                ^ tables[4][low >> 24] ^ tables[3][high & 0xFF] ^ tables[2][(high >> 8) & 0xFF]
                ^ tables[1][(high >> 16) & 0xFF] ^ tables[0][high >> 24];
        }
        for (; size > 0; --size, ++bytes)
            state = (state >> 8) ^ tables[0][(state ^ std::uint8_t(*bytes)) & 0xFF];
        return ~state;
    }

private:
    static constexpr std::size_t Word = sizeof(std::uint64_t);
    using Tables = std::array<std::array<std::uint32_t, 256>, Word>;

    static constexpr Tables makeTables()
    {
        Tables made{};
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t crc = byte;
            for (int bit = 0; bit < 8; ++bit)
                crc = (crc >> 1) ^ ((crc & 1) != 0 ? Polynomial : 0);
            made[0][byte] = crc;
        }
        for (std::size_t n = 1; n < made.size(); ++n) {
            for (std::size_t byte = 0; byte < 256; ++byte)
                made[n][byte] = (made[n - 1][byte] >> 8) ^ made[0][made[n - 1][byte] & 0xFF];
        }
        return made;
    }

    /// tables[n][b]: what byte b adds to the checksum when n more bytes follow it.
    static const Tables tables;
};

template<std::uint32_t Polynomial>
inline constexpr typename TabledCrc<Polynomial>::Tables TabledCrc<Polynomial>::tables
    = TabledCrc<Polynomial>::makeTables();

}  // namespace qplc
