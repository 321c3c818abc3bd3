// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenObject.h"
#include "hardware/can/CanFrame.h"

#include <array>

namespace qplc {

/// The data of an SDO frame (CiA 301): a command, in the first frames of a transfer an address, and
/// four bytes more.
struct SdoFrame
{
    static constexpr int Size = 8;  // [byte]
    using Data = std::array<quint8, Size>;

    static Data make(quint8 command, ObjectAddress address, quint32 rest);
    static ObjectAddress addressOf(const Data &data);
    static quint32 restOf(const Data &data);

    static CanFrame toFrame(quint32 id, const Data &data);
    /// \pre the frame has Size bytes
    static Data fromFrame(const CanFrame &frame);
};

/// Abort codes of CiA 301 that we send, or look for.
struct SdoAbort
{
    static constexpr quint32 WrongToggle = 0x05030000;
    static constexpr quint32 TimedOut = 0x05040000;
    static constexpr quint32 UnknownCommand = 0x05040001;
    static constexpr quint32 OutOfMemory = 0x05040005;
    static constexpr quint32 UnsupportedAccess = 0x06010000;
    static constexpr quint32 CannotBeWritten = 0x06010002;
    static constexpr quint32 NoObject = 0x06020000;
    static constexpr quint32 NotMappable = 0x06040041;
    static constexpr quint32 TooLongForPdo = 0x06040042;
    static constexpr quint32 WrongLength = 0x06070010;
    static constexpr quint32 TooManyBytes = 0x06070012;
    static constexpr quint32 TooFewBytes = 0x06070013;
    static constexpr quint32 NoSubindex = 0x06090011;
    static constexpr quint32 NotInThisState = 0x08000022;
};

}  // namespace qplc
