// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/can/CanFrame.h"

#include <QtCore/QString>

namespace qplc {

/// Numbers of CiA 301: ids of frames, commands and states of network management (NMT).
struct CanOpenIds
{
    static constexpr int MaximumNode = 127;
    static constexpr quint32 Nmt = 0x000;
    static constexpr quint32 Sync = 0x080;
    static constexpr quint32 Emergency = 0x080;    // + node, as all below
    static constexpr quint32 SdoResponse = 0x580;  // from the device
    static constexpr quint32 SdoRequest = 0x600;
    static constexpr quint32 Heartbeat = 0x700;

    /// Whether a PDO can have an id, and nothing else has it.
    static constexpr bool isPdo(quint32 id) { return id >= 0x181 && id <= 0x57F; }
    /// The id that a PDO of a device has by default (number 1 ... 4). \param isTransmit  the device
    /// sends it
    static constexpr quint32 pdo(int number, bool isTransmit, int node)
    {
        return (isTransmit ? 0x180U : 0x200U) + 0x100U * quint32(number - 1) + quint32(node);
    }
};

enum class NmtCommand : quint8 {
    Start = 1,
    Stop = 2,
    EnterPreOperational = 128,
    ResetNode = 129,
    ResetCommunication = 130
};

/// The frame of a command. \param node  0: all devices
CanFrame nmtFrame(NmtCommand command, int node) noexcept;

/// What a device tells of itself in its heartbeats.
enum class NmtState : quint8 { BootUp = 0, Stopped = 4, Operational = 5, PreOperational = 127, Unknown = 255 };

/// "Operational"
QString nmtStateText(NmtState state);

}  // namespace qplc
