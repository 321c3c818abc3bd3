// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

namespace qplc {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "frames are little-endian and copied as they are: a big-endian processor needs byte swaps here");

/// The number whose little-endian bytes begin at \a bytes, which need not be aligned.
template<typename T>
T loadLittle(const char *bytes) noexcept
{
    T number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

/// Writes \a number to \a bytes, which need not be aligned.
template<typename T>
void storeLittle(T number, char *bytes) noexcept
{
    std::memcpy(bytes, &number, sizeof number);
}

}  // namespace qplc
