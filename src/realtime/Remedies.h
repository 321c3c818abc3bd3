// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RealTimeSetup.h"

namespace qplc {

// What a person can type when the operating system refuses a wish of the QPlcRealTimeOptions.

/// The path of this program.
QString thisProgram();

/// \param error  what pthread_setschedparam() returned \param program  that is to be cured
QString schedulingRemedy(Scheduling wanted, int error, const QString &program = thisProgram());
/// The thread did not get the scheduling of the one that started it.
QString inheritanceRemedy();
/// \param allowed  processors that the thread may use, "0-3"
QString cpuRemedy(const QString &allowed);
/// \param error  errno of mlockall(), 0 when it claimed success
QString memoryLockRemedy(int error, const QString &program = thisProgram());
/// The heap got less than it shall have in reserve.
QString heapRemedy();
QString stackRemedy();
QString timerSlackRemedy();
/// \param error  errno of the device that limits the sleep of processors
QString idleLatencyRemedy(int error);

// And where a computer as a whole is not fit for real time.

/// The kernel is not PREEMPT_RT.
QString kernelRemedy();
/// The processors change their clock.
QString governorRemedy();
/// Processors that sleep need longer than \a longestExit [us] to wake up.
QString idleStateRemedy(int longestExit);
/// \param hasTsc  whether the time stamp counter could be chosen
QString clockSourceRemedy(bool hasTsc);
QString swapRemedy();
/// The kernel pauses threads with real-time policies too often.
QString realTimeShareRemedy();
/// Threads wake late, datagrams take long: something else has the processor.
QString latencyRemedy();
/// Datagrams do not come back.
QString loopbackRemedy();

}  // namespace qplc
