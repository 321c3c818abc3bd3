// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

#include <array>

namespace qplc {

/// One frame of a CAN bus: a plain value.
struct CanFrame
{
    static constexpr int MaximumSize = 64;  // [byte] of CAN FD; 8 without
    static constexpr quint32 StandardIds = 0x7FF;
    static constexpr quint32 ExtendedIds = 0x1FFFFFFF;

    enum Flag : quint8 {
        Extended = 0x01,       ///< the id has 29 bits, else 11
        Fd = 0x02,             ///< a frame of CAN FD
        BitRateSwitch = 0x04,  ///< its data have the faster bit rate
        ErrorPassive = 0x08,   ///< its sender is error passive (CAN FD only)
        Remote = 0x10,         ///< asks for the frame of this id; has a size and no data
        Error = 0x20  ///< tells of an error of the bus or the controller: id and data are those of <linux/can/error.h>
    };

    quint32 id = 0;
    quint8 flags = 0;
    quint8 size = 0;  // [byte]
    std::array<quint8, MaximumSize> data{};
    qint64 time = 0;  ///< when it came in, CLOCK_MONOTONIC [ns]

    bool has(Flag flag) const { return (flags & flag) != 0; }
    /// The same for all frames of a message, whether they carry it or ask for it: id and kind of
    /// id.
    quint32 key() const { return keyOf(id, has(Extended)); }
    static constexpr quint32 keyOf(quint32 id, bool isExtended) { return id | (isExtended ? 0x80000000U : 0U); }
    /// The parameter group (PGN) of an extended id, as J1939 defines it: 18 bits. Priority, source
    /// and, for a group that goes to one node, its destination are no part of it.
    static constexpr quint32 groupOf(quint32 extendedId)
    {
        const quint32 group = (extendedId >> 8) & 0x3FFFF;
        return isForOneNode(group) ? group & 0x3FF00 : group;
    }
    /// Whether frames of a parameter group have a destination in their id (format PDU1).
    static constexpr bool isForOneNode(quint32 group) { return ((group >> 8) & 0xFF) < 240; }

    /// Whether a frame can have this size. \param isFd  of CAN FD
    static constexpr bool isSize(int size, bool isFd)
    {
        if (size <= 8 || !isFd)
            return size >= 0 && size <= 8;
        return size == 12 || size == 16 || size == 20 || size == 24 || size == 32 || size == 48 || size == 64;
    }
};

}  // namespace qplc
