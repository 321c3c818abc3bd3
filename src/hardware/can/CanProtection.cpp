// SPDX-License-Identifier: Apache-2.0
#include "CanProtection.h"

#include "DbcFile.h"

namespace qplc {

namespace {

const DbcSignal *protectingSignal(const QStringList &words, const DbcMessage &message, QString *error)
{
    const QString name = words.value(0);
    const DbcSignal *signal = message.find(name);
    if (!signal)
        *error = QStringLiteral("message '%1' has no signal '%2'; name one of its signals").arg(message.name, name);
    else if (signal->isMultiplexed() || signal->isMultiplexor || signal->kind != DbcSignal::Unsigned)
        *error = QStringLiteral("signal '%1' of message '%2' has to be unsigned, and in each frame")
                     .arg(name, message.name);
    return signal;
}

quint8 stepOfCrc8(quint8 value, quint8 polynomial)
{
    for (int bit = 0; bit < 8; ++bit)
        value = quint8((value << 1) ^ ((value & 0x80) ? polynomial : 0));
    return value;
}

}  // namespace

QString CanProtection::readCounter(const QStringList &words, const DbcMessage &message)
{
    QString error;
    const DbcSignal *signal = protectingSignal(words, message, &error);
    if (!error.isEmpty())
        return error;
    counter = signal->name;
    const quint64 most = RawNumber::lowBits(signal->length);
    mostCounted = most;
    bool isNumber = words.size() == 1;
    if (words.size() == 2 && words.at(1).startsWith(QLatin1String("up to ")))
        mostCounted = words.at(1).mid(6).toULongLong(&isNumber, 0);
    if (isNumber && mostCounted >= 1 && mostCounted <= most)
        return {};
    return QStringLiteral("'%1' is not an alive counter; write the name of its signal, and 'up to 14' if it does not "
                          "count to %2")
        .arg(words.join(QStringLiteral(", ")))
        .arg(most);
}

QString CanProtection::readChecksum(const QStringList &words, const DbcMessage &message)
{
    QString error;
    const DbcSignal *signal = protectingSignal(words, message, &error);
    if (!error.isEmpty())
        return error;
    const int firstBit = signal->byteOrder == DbcSignal::Intel ? 0 : 7;
    if (signal->length != 8 || signal->start % 8 != firstBit)
        return QStringLiteral("signal '%1' of message '%2' is not one whole byte, as a checksum has to be")
            .arg(signal->name, message.name);
    checksum = signal->name;
    checksumByte = signal->start / 8;
    const QString name = words.value(1);
    method = name == QLatin1String("xor") ? Xor : name == QLatin1String("sum") ? Sum : Crc8;
    initial = finalXor = method == Crc8 ? 0xFF : 0;
    bool isRead = method != Crc8 || name == QLatin1String("crc8");
    for (const QString &word : words.mid(2))
        isRead = isRead && readOption(word);
    if (isRead)
        return {};
    return QStringLiteral("'%1' is not a checksum; write SIGNAL, crc8 (or xor, or sum), and, if need be, polynomial "
                          "0x1D, initial 0xFF, final 0xFF, prefix 12 34")
        .arg(words.join(QStringLiteral(", ")));
}

bool CanProtection::readOption(const QString &word)
{
    const QString name = word.section(QLatin1Char(' '), 0, 0);
    const QString value = word.section(QLatin1Char(' '), 1);
    if (name == QLatin1String("prefix")) {
        prefix = QByteArray::fromHex(value.toLatin1());
        return !prefix.isEmpty() && prefix.size() <= 16
            && prefix.toHex() == QString(value).remove(QLatin1Char(' ')).toLower().toLatin1();
    }
    bool isNumber = false;
    const uint number = value.toUInt(&isNumber, 0);
    quint8 *option = name == QLatin1String("initial")           ? &initial
        : name == QLatin1String("final")                        ? &finalXor
        : name == QLatin1String("polynomial") && method == Crc8 ? &polynomial
                                                                : nullptr;
    if (!option || !isNumber || number > 0xFF)
        return false;
    *option = quint8(number);
    return true;
}

quint8 CanProtection::checksumOf(const quint8 *data, int size) const noexcept
{
    quint8 value = initial;
    const auto take = [this, &value](quint8 byte) {
        value = method == Sum ? quint8(value + byte) : quint8(value ^ byte);
        if (method == Crc8)
            value = stepOfCrc8(value, polynomial);
    };
    for (const char byte : prefix)
        take(quint8(byte));
    for (int i = 0; i < size; ++i) {
        if (i != checksumByte)
            take(data[i]);
    }
    return quint8(value ^ finalXor);
}

}  // namespace qplc
