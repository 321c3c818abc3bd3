// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcNodeInfo.h"
#include "protocol/messages/State.h"

#include <QtCore/QDate>

namespace qplc {

/// A state, or a clock, of the protocol as people read it: "RealTime" is "Real time", "SafeStop"
/// "Safe stop", "WaitingForLateSlaves" "Waiting for late nodes". JSON, the protocol and code keep
/// the names.
QString stateText(const QString &name);
/// "Unknown" for a state of a newer master.
QString stateText(messages::MasterState state);
QString stateText(messages::ClockKind clock);
/// "udp", or "tcp (fallback)" for a node to or from which datagrams do not get through.
QString transportText(const QPlcNodeInfo &node);
/// "evicted by 'anna' at 13:04:05"; with the date, unless it is that of \a today.
QString evictedText(const messages::EvictedEntry &entry, const QDate &today);
/// "recording, 14.1 kB/s, 512.0 GB free", "the disk is full: ..."
QString recorderText(const messages::RecorderEntry &recorder);

}  // namespace qplc
