// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcCycleStatistics.h"

#include <QtCore/QJsonObject>

namespace qplc {

/// Fields of the message Statistics; docs/protocol.md lists them.
QJsonObject statisticsFields(const QPlcCycleStatistics &statistics);

}  // namespace qplc
