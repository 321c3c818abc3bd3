// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

class QPlcMasterNode;

namespace awe {

/// One line for a terminal: where the flight stands. \param time, duration [s] of simulated time; duration 0: open end
QString progressLine(double time, double duration, const char *phase, const QPlcMasterNode &master);

} // namespace awe
