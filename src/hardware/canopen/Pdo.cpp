// SPDX-License-Identifier: Apache-2.0
#include "Pdo.h"

namespace qplc {

bool PdoEntry::isNamed(const QString &text) const
{
    const auto asAddress = ObjectAddress::fromText(text);
    return asAddress ? *asAddress == address : !name.isEmpty() && name == text;
}

int Pdo::firstBit(int entry) const noexcept
{
    int sum = 0;
    for (int i = 0; i < entry; ++i)
        sum += entries.at(i).number.bits;
    return sum;
}

QString Pdo::title() const
{
    return QStringLiteral("%1 %2").arg(isTransmit ? QStringLiteral("TPDO") : QStringLiteral("RPDO")).arg(number);
}

int Pdo::find(const QString &text) const
{
    for (int i = 0; i < entries.size(); ++i) {
        if (entries.at(i).isNamed(text))
            return i;
    }
    return -1;
}

quint64 Pdo::bitsOf(const quint8 *data, int first, int count) noexcept
{
    quint64 bits = 0;
    for (int i = 0; i < count; ++i) {
        const int place = first + i;
        bits |= quint64((data[place / 8] >> (place % 8)) & 1) << i;
    }
    return bits;
}

void Pdo::setBits(quint8 *data, int first, int count, quint64 bits) noexcept
{
    for (int i = 0; i < count; ++i) {
        const int place = first + i;
        const auto mask = quint8(1 << (place % 8));
        data[place / 8] = quint8((bits >> i) & 1 ? data[place / 8] | mask : data[place / 8] & ~mask);
    }
}

}  // namespace qplc
