// SPDX-License-Identifier: Apache-2.0
#include "I2cRegister.h"

#include "signals/MessageText.h"

#include <cmath>

namespace qplc {

namespace {

constexpr quint8 LastRegister = 0xff;

bool readType(const QString &name, I2cRegister *result)
{
    struct Name
    {
        const char *text;
        I2cRegister::Type type;
        int size;
    };
    constexpr Name names[] = {
        {"int8", I2cRegister::SignedInteger, 1},  {"uint8", I2cRegister::UnsignedInteger, 1},
        {"int16", I2cRegister::SignedInteger, 2}, {"uint16", I2cRegister::UnsignedInteger, 2},
        {"int24", I2cRegister::SignedInteger, 3}, {"uint24", I2cRegister::UnsignedInteger, 3},
        {"int32", I2cRegister::SignedInteger, 4}, {"uint32", I2cRegister::UnsignedInteger, 4},
        {"real32", I2cRegister::Real, 4},
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
    if (!word.startsWith(name + QLatin1Char(' ')))
        return false;
    bool isNumber = false;
    *number = word.mid(name.size()).trimmed().toDouble(&isNumber);
    return isNumber && std::isfinite(*number);
}

bool readWord(const QString &word, I2cRegister *result)
{
    const QStringList parts = word.split(QLatin1Char(' '));
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

RawNumber registerNumber(const I2cRegister &reg)
{
    const RawNumber::Kind kind = reg.type == I2cRegister::Real ? RawNumber::Float
        : reg.type == I2cRegister::SignedInteger               ? RawNumber::Signed
                                                               : RawNumber::Unsigned;
    return {kind, 8 * reg.size};
}

}  // namespace

QString I2cRegister::read(const QStringList &words, I2cRegister *result)
{
    *result = I2cRegister();
    bool isNumber = false;
    const uint first = words.value(0).trimmed().toUInt(&isNumber, 0);
    if (!isNumber || first > LastRegister)
        return QStringLiteral("%1 is not a register; its number comes first, 0 ... 255 or 0x00 ... 0xff")
            .arg(quoted(words.value(0)));
    result->first = quint8(first);
    for (const QString &text : words.mid(1)) {
        if (!readWord(text.simplified().toLower(), result))
            return QStringLiteral("%1 is not an option of a register; use a type (int8, uint8, int16, uint16, "
                                  "int24, uint24, int32, uint32, real32, and behind that big-endian or little-endian), "
                                  "factor X, offset X, read, write")
                .arg(quoted(text));
    }
    if (result->first + result->size - 1 > LastRegister)
        return QStringLiteral("its last byte would be in register %1, and 255 is the last one")
            .arg(result->first + result->size - 1);
    return QString();
}

RawNumber::Limits I2cRegister::limits() const
{
    return registerNumber(*this).limits(factor, offset);
}

double I2cRegister::valueOf(const quint8 *bytes) const
{
    quint64 number = 0;
    for (int i = 0; i < size; ++i)
        number = number << 8 | bytes[isBigEndian ? i : size - 1 - i];
    return factor * registerNumber(*this).decode(number) + offset;
}

void I2cRegister::bytesOf(double value, quint8 *bytes) const
{
    const quint64 number = registerNumber(*this).encode(RawNumber::scaled(value, factor, offset));
    for (int i = 0; i < size; ++i)
        bytes[isBigEndian ? size - 1 - i : i] = quint8(number >> (8 * i));
}

}  // namespace qplc
