// SPDX-License-Identifier: Apache-2.0
#include "I2cRegister.h"

#include "signals/MessageText.h"

#include <cmath>
#include <cstring>

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

quint32 unsignedOf(const I2cRegister &reg, const quint8 *bytes)
{
    quint32 number = 0;
    for (int i = 0; i < reg.size; ++i)
        number = number << 8 | bytes[reg.isBigEndian ? i : reg.size - 1 - i];
    return number;
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

double I2cRegister::valueOf(const quint8 *bytes) const
{
    const quint32 number = unsignedOf(*this, bytes);
    double raw = number;
    if (type == Real) {
        float real = 0.0F;
        std::memcpy(&real, &number, sizeof real);
        raw = double(real);
    } else if (type == SignedInteger && (number >> (8 * size - 1)) != 0) {
        raw -= std::ldexp(1.0, 8 * size);
    }
    return factor * raw + offset;
}

void I2cRegister::bytesOf(double value, quint8 *bytes) const
{
    const double raw = (value - offset) / factor;
    quint32 number = 0;
    if (type == Real) {
        const auto real = float(raw);
        std::memcpy(&number, &real, sizeof number);
    } else {
        const double range = std::ldexp(1.0, 8 * size);
        const double lowest = type == SignedInteger ? -range / 2 : 0.0;
        const double nearest = std::isnan(raw) ? 0.0 : std::round(raw);
        number = quint32(qint64(qBound(lowest, nearest, lowest + range - 1)));
    }
    for (int i = 0; i < size; ++i)
        bytes[isBigEndian ? size - 1 - i : i] = quint8(number >> (8 * i));
}

}  // namespace qplc
