// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

namespace qplc {

/// A number in some bits of a device: an integer with or without a sign, or a float of IEEE 754.
struct RawNumber
{
    enum Kind : quint8 { Unsigned, Signed, Float };
    enum Fit : quint8 {
        Fits,
        Saturated,  ///< the value does not fit into the bits; the nearest one that does was taken
        NoNumber    ///< NaN, and the bits are an integer; 0 was taken
    };

    /// Values that a device can hold, both included.
    struct Limits
    {
        double lowest;
        double highest;
    };

    Kind kind = Unsigned;
    int bits = 16;  // 1 ... 64; of a float 32 or 64

    /// The lowest \a count of 64 bits are 1, the others 0. \a count: 0 ... 64
    static constexpr quint64 lowBits(int count) noexcept
    {
        return count >= 64 ? ~quint64(0) : (quint64(1) << count) - 1;
    }
    /// The bits in \a size bytes of a device: 1 ... 8.
    static quint64 join(const quint8 *bytes, int size, bool isBigEndian) noexcept
    {
        quint64 joined = 0;
        for (int i = 0; i < size; ++i)
            joined = joined << 8 | bytes[isBigEndian ? i : size - 1 - i];
        return joined;
    }
    /// The number of a device for \a value = number * factor + offset; finite if the value is.
    static double scaled(double value, double factor, double offset) noexcept;

    /// \param value  bits above those of the number do not count
    double decode(quint64 value) const noexcept;
    /// \return the bits of the nearest number, halves away from 0; those above may be set
    quint64 encode(double value, Fit *fit = nullptr) const noexcept;
    /// Of \a value = number * factor + offset.
    Limits limits(double factor, double offset) const noexcept;
    /// The bits of a signed number as an integer.
    qint64 decodeSigned(quint64 value) const noexcept;
};

}  // namespace qplc
