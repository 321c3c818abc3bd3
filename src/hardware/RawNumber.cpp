// SPDX-License-Identifier: Apache-2.0
#include "RawNumber.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace qplc {

namespace {

template<typename To, typename From>
To sameBits(From from) noexcept
{
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &from, sizeof to);
    return to;
}

// A double that is no float stays finite: the largest float is the nearest one.
quint64 nearestFloat(double value, RawNumber::Fit *fit) noexcept
{
    constexpr double largest = double(std::numeric_limits<float>::max());
    const bool isTooLarge = std::isfinite(value) && std::abs(value) > largest;
    *fit = isTooLarge ? RawNumber::Saturated : RawNumber::Fits;
    return sameBits<quint32>(static_cast<float>(isTooLarge ? std::copysign(largest, value) : value));
}

quint64 nearestInteger(double value, double lowest, double beyond, RawNumber::Fit *fit) noexcept
{
    const double rounded = std::round(value);
    *fit = std::isnan(rounded)                  ? RawNumber::NoNumber
        : rounded >= lowest && rounded < beyond ? RawNumber::Fits
                                                : RawNumber::Saturated;
    if (*fit == RawNumber::NoNumber)
        return 0;
    if (*fit == RawNumber::Fits)
        return rounded < 0.0 ? static_cast<quint64>(static_cast<qint64>(rounded)) : static_cast<quint64>(rounded);
    // The largest one may be no double: its bits are those below that of the number beyond it.
    return rounded < 0.0 ? static_cast<quint64>(static_cast<qint64>(lowest)) : RawNumber::lowBits(std::ilogb(beyond));
}

}  // namespace

double RawNumber::scaled(double value, double factor, double offset) noexcept
{
    const double number = (value - offset) / factor;
    return std::isinf(number) && std::isfinite(value) ? std::copysign(std::numeric_limits<double>::max(), number)
                                                      : number;
}

qint64 RawNumber::decodeSigned(quint64 value) const noexcept
{
    const bool isNegative = (value >> (bits - 1)) & 1;
    return static_cast<qint64>(isNegative ? value | ~lowBits(bits) : value & lowBits(bits));
}

RawNumber::Limits RawNumber::limits(double factor, double offset) const noexcept
{
    const double largest = bits == 32 ? double(std::numeric_limits<float>::max()) : std::numeric_limits<double>::max();
    const double highest = kind == Float ? largest : std::ldexp(1.0, kind == Signed ? bits - 1 : bits) - 1.0;
    const double lowest = kind == Float ? -largest : kind == Signed ? -std::ldexp(1.0, bits - 1) : 0.0;
    const double a = lowest * factor + offset;
    const double b = highest * factor + offset;
    return {std::min(a, b), std::max(a, b)};
}

double RawNumber::decode(quint64 value) const noexcept
{
    switch (kind) {
    case Unsigned:
        return double(value & lowBits(bits));
    case Signed:
        return double(decodeSigned(value));
    case Float:
        break;
    }
    return bits == 32 ? double(sameBits<float>(quint32(value))) : sameBits<double>(value);
}

quint64 RawNumber::encode(double value, Fit *fit) const noexcept
{
    Fit unused = Fits;
    Fit *how = fit ? fit : &unused;
    *how = Fits;
    switch (kind) {
    case Unsigned:
        return nearestInteger(value, 0.0, std::ldexp(1.0, bits), how);
    case Signed:
        return nearestInteger(value, -std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1), how);
    case Float:
        break;
    }
    return bits == 32 ? nearestFloat(value, how) : sameBits<quint64>(value);
}

}  // namespace qplc
