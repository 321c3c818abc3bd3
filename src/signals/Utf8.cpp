// SPDX-License-Identifier: Apache-2.0
#include "Utf8.h"

namespace qplc {

namespace {

bool isContinuation(unsigned char byte)
{
    return (byte & 0xC0) == 0x80;
}

// Bytes of the sequence that `lead` begins, 0 when no sequence begins with it.
int sequenceLength(unsigned char lead)
{
    if (lead < 0x80)
        return 1;
    if (lead >= 0xC2 && lead <= 0xDF)
        return 2;
    if (lead >= 0xE0 && lead <= 0xEF)
        return 3;
    return lead >= 0xF0 && lead <= 0xF4 ? 4 : 0;
}

// Overlong forms, surrogates and numbers above U+10FFFF show in the second byte.
bool isSecondByte(unsigned char lead, unsigned char second)
{
    switch (lead) {
    case 0xE0:
        return second >= 0xA0;
    case 0xED:
        return second < 0xA0;
    case 0xF0:
        return second >= 0x90;
    case 0xF4:
        return second < 0x90;
    default:
        return true;
    }
}

}  // namespace

int firstInvalidUtf8(const char *bytes, int size)
{
    const auto byte = [bytes](int i) { return static_cast<unsigned char>(bytes[i]); };
    int position = 0;
    while (position < size) {
        const int length = sequenceLength(byte(position));
        if (length == 0 || position + length > size)
            return position;
        for (int i = 1; i < length; ++i) {
            if (!isContinuation(byte(position + i)))
                return position;
        }
        if (length > 1 && !isSecondByte(byte(position), byte(position + 1)))
            return position;
        position += length;
    }
    return -1;
}

int utf8Characters(const char *bytes, int size)
{
    int characters = 0;
    for (int i = 0; i < size; ++i)
        characters += isContinuation(static_cast<unsigned char>(bytes[i])) ? 0 : 1;
    return characters;
}

}  // namespace qplc
