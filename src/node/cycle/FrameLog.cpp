// SPDX-License-Identifier: Apache-2.0
#include "FrameLog.h"

#include "node/Logging.h"

#include <QtCore/QByteArray>

namespace qplc {

void logFrame(const QString &owner, const TappedFrame &frame)
{
    qCDebug(lcCyclic).noquote() << owner
                                << (frame.direction == TappedFrame::Sent ? "sent for node" : "received for node")
                                << frame.node << QByteArray::fromRawData(frame.bytes.data(), frame.size).toHex(' ');
}

}  // namespace qplc
