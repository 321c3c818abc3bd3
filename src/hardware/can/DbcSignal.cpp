// SPDX-License-Identifier: Apache-2.0
#include "DbcSignal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace qplc {

namespace {

constexpr quint64 lowBits(int count)
{
    return count >= 64 ? ~quint64(0) : (quint64(1) << count) - 1;
}

// Place of the most significant bit of a Motorola value, when bits are counted in the order of the
// bus: bit 7 of byte 0 is the first.
constexpr int busOrder(int bit)
{
    return bit / 8 * 8 + 7 - bit % 8;
}

quint64 intelBits(const quint8 *data, int start, int length) noexcept
{
    quint64 value = 0;
    for (int done = 0; done < length;) {
        const int shift = (start + done) % 8;
        const int count = std::min(8 - shift, length - done);
        value |= ((quint64(data[(start + done) / 8]) >> shift) & lowBits(count)) << done;
        done += count;
    }
    return value;
}

quint64 motorolaBits(const quint8 *data, int start, int length) noexcept
{
    quint64 value = 0;
    int position = busOrder(start);
    for (int left = length; left > 0;) {
        const int count = std::min(8 - position % 8, left);
        const int shift = 8 - position % 8 - count;
        value = (value << count) | ((quint64(data[position / 8]) >> shift) & lowBits(count));
        position += count;
        left -= count;
    }
    return value;
}

void putBits(quint8 *byte, int shift, int count, quint64 value) noexcept
{
    const quint64 mask = lowBits(count) << shift;
    *byte = quint8((*byte & ~mask) | ((value << shift) & mask));
}

void setIntelBits(quint8 *data, int start, int length, quint64 value) noexcept
{
    for (int done = 0; done < length;) {
        const int shift = (start + done) % 8;
        const int count = std::min(8 - shift, length - done);
        putBits(data + (start + done) / 8, shift, count, value >> done);
        done += count;
    }
}

void setMotorolaBits(quint8 *data, int start, int length, quint64 value) noexcept
{
    int position = busOrder(start);
    for (int left = length; left > 0;) {
        const int count = std::min(8 - position % 8, left);
        left -= count;
        putBits(data + position / 8, 8 - position % 8 - count, count, value >> left);
        position += count;
    }
}

// The integer that is nearest to `value`, halves away from 0, within 0 ... 2^length - 1.
quint64 nearestUnsigned(double value, int length, DbcSignal::Fit *fit) noexcept
{
    const double rounded = std::round(value);
    *fit = rounded >= 0.0 && rounded < std::ldexp(1.0, length) ? DbcSignal::Fits : DbcSignal::Saturated;
    if (*fit == DbcSignal::Fits)
        return static_cast<quint64>(rounded);
    return rounded < 0.0 ? 0 : lowBits(length);
}

// As above, within -2^(length - 1) ... 2^(length - 1) - 1, as bits.
quint64 nearestSigned(double value, int length, DbcSignal::Fit *fit) noexcept
{
    const double rounded = std::round(value);
    const double limit = std::ldexp(1.0, length - 1);
    *fit = rounded >= -limit && rounded < limit ? DbcSignal::Fits : DbcSignal::Saturated;
    if (*fit == DbcSignal::Fits)
        return static_cast<quint64>(static_cast<qint64>(rounded));
    return rounded < 0.0 ? quint64(1) << (length - 1) : lowBits(length - 1);
}

// A double that is no float stays finite: the largest float is the nearest one.
quint64 nearestFloat(double value, DbcSignal::Fit *fit) noexcept
{
    constexpr double largest = double(std::numeric_limits<float>::max());
    const bool isTooLarge = std::isfinite(value) && std::abs(value) > largest;
    *fit = isTooLarge ? DbcSignal::Saturated : DbcSignal::Fits;
    const auto number = static_cast<float>(isTooLarge ? std::copysign(largest, value) : value);
    quint32 bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}

quint64 bitsOfDouble(double value) noexcept
{
    quint64 bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

double doubleOfFloatBits(quint32 bits) noexcept
{
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return double(value);
}

double doubleOfBits(quint64 bits) noexcept
{
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

}  // namespace

int DbcSignal::neededBytes() const
{
    const int first = byteOrder == Intel ? start : busOrder(start);
    return (first + length - 1) / 8 + 1;
}

quint64 DbcSignal::bits(const quint8 *data) const noexcept
{
    return byteOrder == Intel ? intelBits(data, start, length) : motorolaBits(data, start, length);
}

void DbcSignal::setBits(quint8 *data, quint64 value) const noexcept
{
    if (byteOrder == Intel)
        setIntelBits(data, start, length, value);
    else
        setMotorolaBits(data, start, length, value);
}

qint64 DbcSignal::signedRaw(const quint8 *data) const noexcept
{
    const quint64 value = bits(data);
    const bool isNegative = (value >> (length - 1)) & 1;
    return static_cast<qint64>(isNegative ? value | ~lowBits(length) : value);
}

double DbcSignal::decode(const quint8 *data) const noexcept
{
    switch (kind) {
    case Unsigned:
        return double(bits(data)) * factor + offset;
    case Signed:
        return double(signedRaw(data)) * factor + offset;
    case Float32:
        return doubleOfFloatBits(quint32(bits(data))) * factor + offset;
    case Float64:
        return doubleOfBits(bits(data)) * factor + offset;
    }
    return 0.0;
}

DbcSignal::Fit DbcSignal::encode(quint8 *data, double value) const noexcept
{
    return encodeRaw(data, (value - offset) / factor);
}

DbcSignal::Fit DbcSignal::encodeRaw(quint8 *data, double raw) const noexcept
{
    Fit fit = Fits;
    quint64 value = 0;
    if (kind == Float64)
        value = bitsOfDouble(raw);
    else if (kind == Float32)
        value = nearestFloat(raw, &fit);
    else if (std::isnan(raw))
        fit = NoNumber;
    else
        value = kind == Signed ? nearestSigned(raw, length, &fit) : nearestUnsigned(raw, length, &fit);
    setBits(data, value);
    return fit;
}

}  // namespace qplc
