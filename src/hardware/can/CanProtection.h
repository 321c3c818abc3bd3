// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanFrame.h"

#include <QtCore/QByteArray>
#include <QtCore/QStringList>

namespace qplc {

struct DbcMessage;
struct DbcSignal;

/// Alive counter and checksum in the frames of a message. They tell a receiver that a sender hangs
/// and repeats its frames, or that a frame was changed on the way. Names are those of signals.
struct CanProtection
{
    enum Method : quint8 { Crc8, Xor, Sum };

    QString counter;           // empty: none
    quint64 mostCounted = 0;   // then it begins at 0 again
    QString checksum;          // empty: none
    int checksumByte = -1;     // its place
    Method method = Crc8;      // of all bytes of the frame but that one
    quint8 polynomial = 0x1D;  // of Crc8
    quint8 initial = 0;        // before the first byte
    quint8 finalXor = 0;       // combined with the result by exclusive or
    QByteArray prefix;         // bytes in front of those of the frame

    /// Reads `SIGNAL, up to 14`. \return an error text with a remedy; empty if \a words are right
    QString readCounter(const QStringList &words, const DbcMessage &message);
    /// Reads `SIGNAL, crc8, polynomial 0x2F, initial 0xFF, final 0xFF, prefix 12 34`, or the same
    /// with `xor` or `sum` and without a polynomial. The words behind the method are optional.
    QString readChecksum(const QStringList &words, const DbcMessage &message);

    /// Returns the checksum of a frame with \a size bytes.
    quint8 checksumOf(const quint8 *data, int size) const noexcept;

private:
    bool readOption(const QString &word);
};

}  // namespace qplc
