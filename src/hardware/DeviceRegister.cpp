// SPDX-License-Identifier: Apache-2.0
#include "DeviceRegister.h"

#include "RegisterBus.h"
#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

namespace qplc {

namespace {

bool readType(const QString &name, DeviceRegister *result)
{
    struct Name
    {
        const char *text;
        DeviceRegister::Type type;
        int size;
    };
    constexpr Name names[] = {
        {"int8", DeviceRegister::SignedInteger, 1},  {"uint8", DeviceRegister::UnsignedInteger, 1},
        {"int16", DeviceRegister::SignedInteger, 2}, {"uint16", DeviceRegister::UnsignedInteger, 2},
        {"int24", DeviceRegister::SignedInteger, 3}, {"uint24", DeviceRegister::UnsignedInteger, 3},
        {"int32", DeviceRegister::SignedInteger, 4}, {"uint32", DeviceRegister::UnsignedInteger, 4},
        {"real32", DeviceRegister::Real, 4},
    };
    for (const Name &known : names) {
        if (name != QLatin1String(known.text))
            continue;
        result->type = known.type;
        result->size = known.size;
        return true;
    }
    return false;
}

bool readNumber(const QString &word, const QString &name, double *number)
{
    return word.startsWith(name + QLatin1Char(' ')) && finiteNumberFromText(word.mid(name.size()).trimmed(), number);
}

/// "bits 4-15", or "bits 3"
bool readBits(const QStringList &parts, DeviceRegister *result)
{
    const QStringList ends = parts.value(1).split(QLatin1Char('-'));
    bool isLowest = false;
    bool isHighest = false;
    const int lowest = ends.first().toInt(&isLowest);
    const int highest = ends.last().toInt(&isHighest);
    result->lowestBit = lowest;
    result->bitCount = highest - lowest + 1;
    return parts.size() == 2 && ends.size() <= 2 && isLowest && isHighest && lowest >= 0 && highest >= lowest;
}

bool readWord(const QString &word, DeviceRegister *result)
{
    const QStringList parts = word.split(QLatin1Char(' '));
    if (parts.first() == QLatin1String("bits") || parts.first() == QLatin1String("bit"))
        return readBits(parts, result);
    if (word == QLatin1String("write") || word == QLatin1String("read")) {
        result->isWritten = word == QLatin1String("write");
        return true;
    }
    if (readNumber(word, QStringLiteral("offset"), &result->offset))
        return true;
    if (readNumber(word, QStringLiteral("factor"), &result->factor))
        return result->factor != 0.0;
    const QString order = parts.value(1, QStringLiteral("big-endian"));
    result->isBigEndian = order == QLatin1String("big-endian");
    return parts.size() <= 2 && (result->isBigEndian || order == QLatin1String("little-endian"))
        && readType(parts.first(), result);
}

}  // namespace

QString DeviceRegister::read(const QStringList &words, DeviceRegister *result, int lastRegister)
{
    *result = DeviceRegister();
    bool isNumber = false;
    const QString place = words.value(0).trimmed();
    const uint first = place.toUInt(&isNumber, 0);
    if (place == QLatin1String("plain"))
        result->first = RegisterBus::NoRegister;
    else if (isNumber && first <= uint(lastRegister))
        result->first = int(first);
    else
        return QStringLiteral("%1 is not a register; its number comes first, 0 ... %2 or 0x00 ... 0x%3, or 'plain' for "
                              "bytes without a register%4")
            .arg(quoted(words.value(0)))
            .arg(lastRegister)
            .arg(lastRegister, 0, 16)
            .arg(lastRegister > 0xff ? QString()
                                     : QStringLiteral("; for higher ones write 'register-numbers = 16 bits'"));
    for (const QString &text : words.mid(1)) {
        if (!readWord(text.simplified().toLower(), result))
            return QStringLiteral("%1 is not an option of a register; use a type (int8, uint8, int16, uint16, "
                                  "int24, uint24, int32, uint32, real32, and behind that big-endian or little-endian), "
                                  "bits M-N, factor X, offset X, read, write")
                .arg(quoted(text));
    }
    return result->check(lastRegister);
}

QString DeviceRegister::check(int lastRegister) const
{
    if (first + size - 1 > lastRegister)
        return QStringLiteral("its last byte would be in register %1, and %2 is the last one")
            .arg(first + size - 1)
            .arg(lastRegister);
    if (isField() && type == Real)
        return QStringLiteral("some bits of a real32 are no number; use a type of integers with 'bits'");
    if (isField() && lowestBit + bitCount > 8 * size)
        return QStringLiteral("bit %1 is not one of its %2 bits; use a longer type, for example 'uint16'")
            .arg(lowestBit + bitCount - 1)
            .arg(8 * size);
    if (isField() && isWritten && first == RegisterBus::NoRegister)
        return QStringLiteral("the other bits of plain bytes are not known; write all of them, without 'bits'");
    return QString();
}

bool DeviceRegister::overlaps(const DeviceRegister &other) const
{
    if (first == RegisterBus::NoRegister || other.first == RegisterBus::NoRegister)
        return first == other.first;
    if (first >= other.first + other.size || other.first >= first + size)
        return false;
    const bool isSamePlace = first == other.first && size == other.size && isBigEndian == other.isBigEndian;
    const bool isApart = lowestBit >= other.lowestBit + other.bitCount || other.lowestBit >= lowestBit + bitCount;
    return !(isField() && other.isField() && isSamePlace && isApart);
}

RawNumber DeviceRegister::number() const
{
    const RawNumber::Kind kind = type == Real ? RawNumber::Float
        : type == SignedInteger               ? RawNumber::Signed
                                              : RawNumber::Unsigned;
    return {kind, isField() ? bitCount : 8 * size};
}

RawNumber::Limits DeviceRegister::limits() const
{
    return number().limits(factor, offset);
}

quint64 DeviceRegister::join(const quint8 *bytes) const
{
    return RawNumber::join(bytes, size, isBigEndian);
}

double DeviceRegister::valueOf(const quint8 *bytes) const
{
    return factor * number().decode(join(bytes) >> lowestBit) + offset;
}

void DeviceRegister::bytesOf(double value, quint8 *bytes) const
{
    quint64 bits = number().encode(RawNumber::scaled(value, factor, offset));
    if (isField()) {
        const quint64 mask = RawNumber::lowBits(bitCount) << lowestBit;
        bits = (join(bytes) & ~mask) | (bits << lowestBit & mask);
    }
    for (int i = 0; i < size; ++i)
        bytes[isBigEndian ? size - 1 - i : i] = quint8(bits >> (8 * i));
}

}  // namespace qplc
