// SPDX-License-Identifier: Apache-2.0
#include "IioScan.h"

#include <QtCore/QRegularExpression>

#include <algorithm>

namespace qplc {

namespace {

constexpr int MostRepetitions = 64;

bool isPowerOfTwo(int number)
{
    return number > 0 && (number & (number - 1)) == 0;
}

int roundedUp(int number, int multiple)
{
    return (number + multiple - 1) / multiple * multiple;
}

}  // namespace

std::optional<IioElement> IioElement::fromText(const QByteArray &text)
{
    // Some drivers write S and U: the bits above continue the sign. They do not count here.
    static const QRegularExpression pattern(
        QStringLiteral("^(be|le):([suSUf])(\\d{1,2})/(\\d{1,2})(?:X(\\d{1,2}))?(?:>>(\\d{1,2}))?\\z"));
    const QByteArray trimmed = text.trimmed();
    const QRegularExpressionMatch match = pattern.match(QString::fromLatin1(trimmed.constData(), trimmed.size()));
    if (!match.hasMatch())
        return std::nullopt;
    const QString kind = match.captured(2).toLower();
    const int storageBits = match.captured(4).toInt();
    IioElement element;
    element.number.kind = kind == QLatin1String("f") ? RawNumber::Float
        : kind == QLatin1String("s")                 ? RawNumber::Signed
                                                     : RawNumber::Unsigned;
    element.number.bits = match.captured(3).toInt();
    element.isBigEndian = match.captured(1) == QLatin1String("be");
    element.storage = storageBits / 8;
    element.repetition = match.capturedLength(5) > 0 ? match.captured(5).toInt() : 1;
    element.shift = match.captured(6).toInt();
    const bool isStored = storageBits >= 8 && storageBits <= 64 && isPowerOfTwo(storageBits);
    const bool isInteger = element.number.bits >= 1 && element.number.bits + element.shift <= storageBits;
    const bool isFloat = element.number.bits >= 32 && element.number.bits == storageBits && element.shift == 0;
    const bool isRepeated = element.repetition >= 1 && element.repetition <= MostRepetitions;
    if (!isStored || !isRepeated || !(element.number.kind == RawNumber::Float ? isFloat : isInteger))
        return std::nullopt;
    return element;
}

quint64 IioElement::bits(const quint8 *bytes) const noexcept
{
    return RawNumber::join(bytes, storage, isBigEndian) >> shift;
}

void IioScan::clear()
{
    m_places.clear();
    m_size = 0;
}

int IioScan::add(int index, const IioElement &element)
{
    m_places.push_back({index, element, 0});
    return int(m_places.size()) - 1;
}

const char *IioScan::layOut()
{
    std::vector<Place *> order;
    for (Place &place : m_places)
        order.push_back(&place);
    std::sort(order.begin(), order.end(), [](const Place *a, const Place *b) { return a->index < b->index; });
    int last = -1;
    int largest = 1;
    m_size = 0;
    for (Place *place : order) {
        const int bytes = place->element.bytes();
        if (place->index <= last)
            return "two elements of the scan have the same index; look for a newer driver of the kernel";
        if (!isPowerOfTwo(bytes))  // the kernel does not say at which places these stand
            return "an element of the scan has a size that is no power of two; read its channels without 'buffer'";
        place->offset = roundedUp(m_size, bytes);
        m_size = place->offset + bytes;
        if (m_size > MostBytes)
            return "the scan is longer than 4096 bytes; read fewer channels";
        last = place->index;
        largest = std::max(largest, bytes);
    }
    m_size = roundedUp(m_size, largest);
    return m_size > 0 ? nullptr : "no channel of it is read; name one in the section 'read', or leave 'buffer' out";
}

double IioScan::value(int number, const quint8 *scan) const noexcept
{
    const Place &place = m_places[std::size_t(number)];
    return place.element.number.decode(bitsOf(place, scan));
}

qint64 IioScan::integer(int number, const quint8 *scan) const noexcept
{
    const Place &place = m_places[std::size_t(number)];
    return place.element.number.decodeSigned(bitsOf(place, scan));
}

}  // namespace qplc
