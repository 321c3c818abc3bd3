// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RealTimeSetup.h"

namespace qplc {

// What a person can type when the operating system refuses a wish of the QPlcRealTimeOptions.

/// \param error  what pthread_setschedparam() returned
QString schedulingRemedy(Scheduling wanted, int error);
/// The thread did not get the scheduling of the one that started it.
QString inheritanceRemedy();
/// \param allowed  processors that the thread may use, "0-3"
QString cpuRemedy(const QString &allowed);
/// \param error  errno of mlockall(), 0 when it claimed success
QString memoryLockRemedy(int error);
QString stackRemedy();
QString timerSlackRemedy();

}  // namespace qplc
