// SPDX-License-Identifier: Apache-2.0
#include "CanOpenIds.h"

namespace qplc {

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

}  // namespace qplc
