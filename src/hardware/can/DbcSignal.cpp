// SPDX-License-Identifier: Apache-2.0
#include "DbcSignal.h"

#include <algorithm>

namespace qplc {

namespace {

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
        value |= ((quint64(data[(start + done) / 8]) >> shift) & RawNumber::lowBits(count)) << done;
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
        value = (value << count) | ((quint64(data[position / 8]) >> shift) & RawNumber::lowBits(count));
        position += count;
        left -= count;
    }
    return value;
}

void putBits(quint8 *byte, int shift, int count, quint64 value) noexcept
{
    const quint64 mask = RawNumber::lowBits(count) << shift;
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

RawNumber numberOf(const DbcSignal &signal) noexcept
{
    const RawNumber::Kind kind = signal.isFloat() ? RawNumber::Float
        : signal.kind == DbcSignal::Signed        ? RawNumber::Signed
                                                  : RawNumber::Unsigned;
    return {kind, signal.length};
}

}  // namespace

bool DbcSignal::isOnPage(quint64 value) const noexcept
{
    return std::any_of(pages.cbegin(), pages.cend(),
                       [value](const Range &range) { return value >= range.first && value <= range.last; });
}

DbcSignal::Bits DbcSignal::places() const
{
    Bits bits;
    for (int i = 0; i < length; ++i) {
        const int position = byteOrder == Intel ? start + i : busOrder(busOrder(start) + i);
        bits.set(std::size_t(position));
    }
    return bits;
}

RawNumber::Limits DbcSignal::limits() const
{
    const RawNumber::Limits bits = numberOf(*this).limits(factor, offset);
    if (!(minimum < maximum))
        return bits;
    return {std::max(bits.lowest, minimum), std::min(bits.highest, maximum)};
}

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
    return numberOf(*this).decodeSigned(bits(data));
}

double DbcSignal::decode(const quint8 *data) const noexcept
{
    return numberOf(*this).decode(bits(data)) * factor + offset;
}

DbcSignal::Fit DbcSignal::encode(quint8 *data, double value) const noexcept
{
    return encodeRaw(data, RawNumber::scaled(value, factor, offset));
}

DbcSignal::Fit DbcSignal::encodeRaw(quint8 *data, double raw) const noexcept
{
    Fit fit = Fits;
    setBits(data, numberOf(*this).encode(raw, &fit));
    return fit;
}

}  // namespace qplc
