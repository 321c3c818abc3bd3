// SPDX-License-Identifier: Apache-2.0
#include "CanOpenIds.h"

namespace qplc {

namespace {

struct EmergencyClass
{
    quint16 mask;
    quint16 code;
    const char *text;
};

// The narrow classes come first.
constexpr EmergencyClass emergencyClasses[] = {
    {0xFFFF, 0x8110, "CAN overrun: objects were lost"},
    {0xFFFF, 0x8120, "CAN in error passive mode"},
    {0xFFFF, 0x8130, "the heartbeat of the master was missing"},
    {0xFFFF, 0x8140, "recovered from bus-off"},
    {0xFFFF, 0x8150, "two devices have one CAN id"},
    {0xFFFF, 0x8210, "a PDO was too short"},
    {0xFFFF, 0x8220, "a PDO was too long"},
    {0xFFFF, 0x8240, "the length of a SYNC was wrong"},
    {0xFFFF, 0x8250, "a PDO came too late"},
    {0xFF00, 0x2100, "current, at the input side"},
    {0xFF00, 0x2200, "current, inside of the device"},
    {0xFF00, 0x2300, "current, at the output side"},
    {0xFF00, 0x3100, "mains voltage"},
    {0xFF00, 0x3200, "voltage inside of the device"},
    {0xFF00, 0x3300, "output voltage"},
    {0xFF00, 0x4100, "ambient temperature"},
    {0xFF00, 0x4200, "temperature of the device"},
    {0xFF00, 0x6100, "internal software"},
    {0xFF00, 0x6200, "user software"},
    {0xFF00, 0x6300, "data set"},
    {0xFF00, 0x8100, "communication"},
    {0xFF00, 0x8200, "protocol"},
    {0xF000, 0x0000, "no error"},
    {0xF000, 0x1000, "general error"},
    {0xF000, 0x2000, "current"},
    {0xF000, 0x3000, "voltage"},
    {0xF000, 0x4000, "temperature"},
    {0xF000, 0x5000, "hardware of the device"},
    {0xF000, 0x6000, "software of the device"},
    {0xF000, 0x7000, "additional modules"},
    {0xF000, 0x8000, "monitoring"},
    {0xF000, 0x9000, "an external error"},
    {0xF000, 0xF000, "additional functions"},
};

}  // namespace

CanFrame nmtFrame(NmtCommand command, int node) noexcept
{
    CanFrame frame;
    frame.id = CanOpenIds::Nmt;
    frame.size = 2;
    frame.data[0] = quint8(command);
    frame.data[1] = quint8(node);
    return frame;
}

QString nmtStateText(NmtState state)
{
    switch (state) {
    case NmtState::BootUp:
        return QStringLiteral("Boot-up");
    case NmtState::Stopped:
        return QStringLiteral("Stopped");
    case NmtState::Operational:
        return QStringLiteral("Operational");
    case NmtState::PreOperational:
        return QStringLiteral("Pre-operational");
    case NmtState::Unknown:
        break;
    }
    return QStringLiteral("unknown");
}

QString emergencyText(quint16 code)
{
    for (const EmergencyClass &one : emergencyClasses) {
        if ((code & one.mask) == one.code)
            return QLatin1String(one.text);
    }
    return QStringLiteral("an error of the manufacturer");
}

}  // namespace qplc
