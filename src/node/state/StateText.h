// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// A state, or a clock, of the protocol as people read it: "RealTime" is "Real time", "SafeStop" "Safe stop", "WaitingForLateSlaves" "Waiting for late nodes".
/// JSON, the protocol and code keep the names.
QString stateText(const QString &name);

}  // namespace qplc
