// SPDX-License-Identifier: Apache-2.0
#include "McapFormat.h"

#include <array>

namespace qplc::mcap {

namespace {

constexpr std::uint32_t polynomial = 0xedb88320;  // reflected
constexpr int slices = 8;
using Tables = std::array<std::array<std::uint32_t, 256>, slices>;

/// tables[n][b]: the byte b, and n bytes of zeros behind it.
constexpr Tables makeTables()
{
    Tables tables{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t crc = byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1) != 0 ? polynomial : 0);
        tables[0][byte] = crc;
    }
    for (std::size_t slice = 1; slice < slices; ++slice) {
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t crc = tables[slice - 1][byte];
            tables[slice][byte] = (crc >> 8) ^ tables[0][crc & 0xff];
        }
    }
    return tables;
}

constexpr Tables tables = makeTables();

}  // namespace

std::uint32_t crc32(const char *bytes, std::size_t size, std::uint32_t crc) noexcept
{
    crc = ~crc;
    for (; size >= slices; size -= slices, bytes += slices) {
        const std::uint32_t low = loadLittle<std::uint32_t>(bytes) ^ crc;
        const auto high = loadLittle<std::uint32_t>(bytes + 4);
        crc = tables[7][low & 0xff] ^ tables[6][(low >> 8) & 0xff] ^ tables[5][(low >> 16) & 0xff]
            ^ tables[4][low >> 24] ^ tables[3][high & 0xff] ^ tables[2][(high >> 8) & 0xff]
            ^ tables[1][(high >> 16) & 0xff] ^ tables[0][high >> 24];
    }
    for (; size > 0; --size, ++bytes)
        crc = (crc >> 8) ^ tables[0][(crc ^ std::uint8_t(*bytes)) & 0xff];
    return ~crc;
}

}  // namespace qplc::mcap
