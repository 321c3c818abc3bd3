// SPDX-License-Identifier: Apache-2.0
#include "NmeaSentence.h"

#include <QtCore/QByteArrayList>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

bool isNmeaCharacter(char character)
{
    return character >= 0x20 && character <= 0x7e && character != '$' && character != '!';
}

bool isAddress(const QByteArray &address)
{
    const bool isPrivate = address.startsWith('P');
    return (isPrivate ? address.size() >= 2 : address.size() == 5)
        && std::all_of(address.cbegin(), address.cend(), [](char character) {
               return (character >= 'A' && character <= 'Z') || (character >= '0' && character <= '9');
           });
}

bool isNmeaNumber(const QByteArray &text)
{
    return !text.isEmpty() && std::all_of(text.cbegin(), text.cend(), [](char character) {
        return (character >= '0' && character <= '9') || character == '.' || character == '-' || character == '+';
    });
}

}  // namespace

quint8 NmeaSentence::checksum(const char *bytes, int size)
{
    quint8 sum = 0;
    for (int i = 0; i < size; ++i)
        sum = quint8(sum ^ quint8(bytes[i]));
    return sum;
}

NmeaSentence::Result NmeaSentence::parse(const QByteArray &line, NmeaSentence *sentence)
{
    if (line.size() > MaximumLength)
        return TooLong;
    if (line.isEmpty() || (line.at(0) != '$' && line.at(0) != '!')
        || !std::all_of(line.cbegin() + 1, line.cend(), isNmeaCharacter))
        return NoSentence;
    const int star = line.indexOf('*');
    QByteArray body = line.mid(1, star < 0 ? -1 : star - 1);
    sentence->m_hasChecksum = star >= 0;
    if (sentence->m_hasChecksum) {
        bool isNumber = false;
        const QByteArray digits = line.mid(star + 1);
        const uint sum = digits.toUInt(&isNumber, 16);
        if (digits.size() != 2 || !isNumber || sum != checksum(body.constData(), body.size()))
            return WrongChecksum;
    }
    const QList<QByteArray> parts = body.split(',');
    const QByteArray &address = parts.first();
    if (!isAddress(address))
        return NoSentence;
    const int talker = address.startsWith('P') ? 1 : 2;
    sentence->m_talker = address.left(talker);
    sentence->m_type = address.mid(talker);
    sentence->m_fields.clear();
    std::copy(parts.cbegin() + 1, parts.cend(), std::back_inserter(sentence->m_fields));
    return Good;
}

bool NmeaSentence::isLetter(int index, char letter) const
{
    const QByteArray text = field(index);
    return text.size() == 1 && text.at(0) == letter;
}

bool NmeaSentence::number(int index, double *number) const
{
    const QByteArray text = field(index);
    bool isRight = false;
    const double value = isNmeaNumber(text) ? text.toDouble(&isRight) : 0.0;
    if (isRight)
        *number = value;
    return isRight;
}

}  // namespace qplc
