// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenObject.h"

#include <array>

namespace qplc {

/// An object in a PDO.
struct PdoEntry
{
    ObjectAddress address;
    QString name;  // empty: it has none but its address
    RawNumber number;
    quint64 initial = 0;  // bits that are sent while nobody writes it

    /// As the mapping of the device has it (CiA 301).
    quint32 mapping() const { return address.key() << 8 | quint32(number.bits); }
    bool isNamed(const QString &text) const;
};

/// A process data object: the frame in which a device sends or receives values, without being
/// asked.
struct Pdo
{
    static constexpr int MaximumNumber = 64;  // of a PDO; CiA 301 has more
    static constexpr int MaximumBits = 64;
    static constexpr int EverySync = 1;  // transmission types
    static constexpr int LastSynchronous = 240;
    static constexpr int OnEvent = 255;
    static constexpr quint32 IsOff = 1U << 31;  // in the id, as the device keeps it

    int number = 1;
    bool isTransmit = true;  // the device sends it (TPDO), else it receives it (RPDO)
    quint32 id = 0;
    int transmission = EverySync;  // 1 ... 240: every so many SYNCs
    int eventTime = 0;             // [ms] at most between two frames; 0: the device decides. Of TPDOs on event
    bool isFixed = false;          // the device does not let its mapping be changed
    QVector<PdoEntry> entries;

    bool isSynchronous() const { return transmission <= LastSynchronous; }
    /// Where an entry begins in the frame.
    int firstBit(int entry) const noexcept;
    int bits() const noexcept { return firstBit(entries.size()); }
    int size() const { return (bits() + 7) / 8; }  // [byte]
    /// "TPDO 1"
    QString title() const;
    /// Where the device keeps how it is sent, and what is in it.
    quint16 communicationIndex() const { return quint16((isTransmit ? 0x1800 : 0x1400) + number - 1); }
    quint16 mappingIndex() const { return quint16((isTransmit ? 0x1A00 : 0x1600) + number - 1); }
    /// Index of the entry that has this address or name; -1: there is none.
    int find(const QString &text) const;

    /// The bits of an entry in the data of a frame. \param first  its first bit \pre it lies in
    /// 64 bits
    static quint64 bitsOf(const quint8 *data, int first, int count) noexcept;
    static void setBits(quint8 *data, int first, int count, quint64 bits) noexcept;
};

}  // namespace qplc
