// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace qplc {

/// Numbers the bins of a log-linear histogram: values below 2^SubBits have a bin each; above, each
/// power of two has 2^SubBits bins, so that the upper border of a bin is at most 1/2^SubBits above
/// each value in it. The last bin also holds everything from 2^TopBits on.
template<int SubBits, int TopBits>
struct LogLinearBins
{
    static_assert(SubBits > 0 && SubBits < TopBits && TopBits <= 63);
    static constexpr int Count = (TopBits - SubBits + 1) << SubBits;

    // The leading bit selects the group, the SubBits bits behind it the bin within the group.
    static int binOf(std::uint64_t value) noexcept
    {
        if (value >> SubBits == 0)
            return int(value);
        if (value >> TopBits != 0)
            return Count - 1;
        const int shift = 63 - __builtin_clzll(value) - SubBits;
        return ((shift + 1) << SubBits) + int((value >> shift) & ((std::uint64_t(1) << SubBits) - 1));
    }

    /// Largest value that belongs into the bin.
    static std::int64_t upperBorder(int bin) noexcept
    {
        if (bin == Count - 1)
            return INT64_MAX;
        const int group = bin >> SubBits;
        if (group == 0)
            return bin;
        constexpr std::uint64_t leading = std::uint64_t(1) << SubBits;
        const std::uint64_t rest = std::uint64_t(bin) & (leading - 1);
        return std::int64_t(((leading + rest + 1) << (group - 1)) - 1);
    }
};

}  // namespace qplc
