// SPDX-License-Identifier: Apache-2.0
#include "ModbusRegister.h"

#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

#include <QtCore/QStringList>
#include <QtCore/QtEndian>

#include <algorithm>

namespace qplc {

namespace {

const QStringList &spaceWords()
{
    static const QStringList words{QStringLiteral("coil"), QStringLiteral("discrete"), QStringLiteral("input"),
                                   QStringLiteral("holding")};
    return words;
}

const QStringList &typeWords()  // in the order of ModbusRegister::Type, without Bit
{
    static const QStringList words{QStringLiteral("int16"),  QStringLiteral("uint16"),  QStringLiteral("int32"),
                                   QStringLiteral("uint32"), QStringLiteral("float32"), QStringLiteral("int64"),
                                   QStringLiteral("float64")};
    return words;
}

constexpr RawNumber modbusNumbers[]
    = {{RawNumber::Unsigned, 1},  // in the order of ModbusRegister::Type
       {RawNumber::Signed, 16},  {RawNumber::Unsigned, 16}, {RawNumber::Signed, 32}, {RawNumber::Unsigned, 32},
       {RawNumber::Float, 32},   {RawNumber::Signed, 64},   {RawNumber::Float, 64}};

bool toWhole(const QString &text, qint64 minimum, qint64 maximum, qint64 *result)
{
    bool ok = false;
    const bool isHexadecimal = text.startsWith(QLatin1String("0x"), Qt::CaseInsensitive);
    *result = isHexadecimal ? text.midRef(2).toLongLong(&ok, 16) : text.toLongLong(&ok);
    return ok && *result >= minimum && *result <= maximum;
}

/// One attribute after the other, each of one or two words.
class RegisterReader
{
public:
    explicit RegisterReader(const ModbusRegister &defaults)
        : m_register(defaults)
    {
    }

    bool read(const QString &text)
    {
        const QStringList parts = text.split(QLatin1Char(','));
        if (!readPlace(parts.first().simplified()))
            return false;
        for (int i = 1; i < parts.size(); ++i) {
            if (!readAttribute(parts[i].simplified()))
                return false;
        }
        return check();
    }
    const ModbusRegister &result() const { return m_register; }
    const QString &error() const { return m_error; }

private:
    bool fail(const QString &text)
    {
        m_error = text;
        return false;
    }

    bool readPlace(const QString &part)
    {
        const QStringList words = part.split(QLatin1Char(' '));
        const int space = spaceWords().indexOf(words.first());
        qint64 address = 0;
        if (space < 0 || words.size() != 2 || !toWhole(words[1], 0, 0xffff, &address)) {
            return fail(QStringLiteral("%1 is not a place in a device: one of %2 and an address of 0 ... 65535 belong "
                                       "here, \"holding 100\" for example")
                            .arg(quoted(part), spaceWords().join(QStringLiteral(", "))));
        }
        m_register.space = ModbusRegister::Space(space);
        m_register.address = quint16(address);
        m_register.type = m_register.isOfBits() ? ModbusRegister::Bit : ModbusRegister::UInt16;
        return true;
    }

    bool readAttribute(const QString &part)
    {
        const int type = typeWords().indexOf(part);
        if (type >= 0) {
            if (m_register.isOfBits())
                return fail(QStringLiteral("%1: a coil or discrete input is a bit and has no type").arg(quoted(part)));
            m_register.type = ModbusRegister::Type(type + 1);
            return true;
        }
        const QString key = part.section(QLatin1Char(' '), 0, 0);
        const QString value = part.section(QLatin1Char(' '), 1);
        if (key == QLatin1String("factor"))
            return (finiteNumberFromText(value, &m_register.factor) && m_register.factor != 0.0)
                || refuse(part, "a number, not 0");
        if (key == QLatin1String("offset"))
            return finiteNumberFromText(value, &m_register.offset) || refuse(part, "a number");
        if (key == QLatin1String("bit"))
            return readBits(part, value, value, "a number of 0 ... 15");
        if (key == QLatin1String("bits"))
            return readBits(part, value.section(QLatin1Char('-'), 0, 0), value.section(QLatin1Char('-'), 1),
                            "the lowest and the highest bit of 0 ... 15, \"4-7\" for example,");
        if (key == QLatin1String("unit"))
            return readUnit(part, value);
        if (key == QLatin1String("word-order"))
            return readOrder(part, value, &m_register.isLowWordFirst);
        if (key == QLatin1String("byte-order"))
            return readOrder(part, value, &m_register.isLowByteFirst);
        return fail(QStringLiteral("%1 is not known: %2, factor, offset, bit, bits, unit, word-order and byte-order "
                                   "are")
                        .arg(quoted(part), typeWords().join(QStringLiteral(", "))));
    }

    bool refuse(const QString &part, const char *right)
    {
        return fail(QStringLiteral("%1 is not valid: %2 belongs behind the first word")
                        .arg(quoted(part), QLatin1String(right)));
    }

    bool readBits(const QString &part, const QString &lowest, const QString &highest, const char *right)
    {
        qint64 first = 0;
        qint64 last = 0;
        if (!toWhole(lowest, 0, 15, &first) || !toWhole(highest, first, 15, &last))
            return refuse(part, right);
        if (m_register.isOfBits())
            return fail(QStringLiteral("%1: a coil or discrete input is a bit itself").arg(quoted(part)));
        m_register.type = ModbusRegister::Bit;
        m_register.bit = quint8(first);
        m_register.bitCount = quint8(last - first + 1);
        return true;
    }

    bool readUnit(const QString &part, const QString &value)
    {
        qint64 unit = 0;
        if (!toWhole(value, 0, 255, &unit))
            return refuse(part, "a number of 0 ... 255");
        m_register.unit = quint8(unit);
        return true;
    }

    bool readOrder(const QString &part, const QString &value, bool *isLowFirst)
    {
        *isLowFirst = value == QLatin1String("little");
        return *isLowFirst || value == QLatin1String("big") || refuse(part, "big or little");
    }

    bool check()
    {
        if (m_register.isOfBits())
            m_register.isLowByteFirst = false;  // that of the section is one of registers
        if (m_register.address + m_register.size() <= 0x10000)
            return true;
        return fail(QStringLiteral("the value takes %1 registers from %2 on, and the last one of a device is 65535")
                        .arg(m_register.size())
                        .arg(m_register.address));
    }

    ModbusRegister m_register;
    QString m_error;
};

}  // namespace

int ModbusRegister::size() const
{
    return std::max(1, modbusNumbers[type].bits / 16);
}

RawNumber ModbusRegister::number() const
{
    return type == Bit ? RawNumber{RawNumber::Unsigned, bitCount} : modbusNumbers[type];
}

RawNumber::Limits ModbusRegister::limits() const
{
    return number().limits(factor, offset);
}

double ModbusRegister::decode(const quint16 *words) const
{
    const int count = size();
    quint64 bits = 0;
    for (int i = 0; i < count; ++i) {
        const quint16 word = words[isLowWordFirst ? count - 1 - i : i];
        bits = (bits << 16) | (isLowByteFirst ? qbswap(word) : word);
    }
    return number().decode(type == Bit ? bits >> bit : bits) * factor + offset;
}

void ModbusRegister::encode(double value, quint16 *words) const
{
    const double raw = RawNumber::scaled(value, factor, offset);
    quint64 bits = isOfBits() ? quint64(raw >= 0.5) : number().encode(raw);
    if (isPart())
        bits = (bits & RawNumber::lowBits(bitCount)) << bit;
    const int count = size();
    for (int i = 0; i < count; ++i, bits >>= 16) {
        const auto word = quint16(bits);
        words[isLowWordFirst ? i : count - 1 - i] = isLowByteFirst ? qbswap(word) : word;
    }
}

quint16 ModbusRegister::mask() const
{
    const auto bits = quint16(RawNumber::lowBits(bitCount) << bit);
    return isLowByteFirst ? qbswap(bits) : bits;
}

bool ModbusRegister::parse(const QString &text, const ModbusRegister &defaults, ModbusRegister *result, QString *error)
{
    RegisterReader reader(defaults);
    const bool ok = reader.read(text);
    if (ok)
        *result = reader.result();
    else
        *error = reader.error();
    return ok;
}

}  // namespace qplc
