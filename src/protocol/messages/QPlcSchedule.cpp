// SPDX-License-Identifier: Apache-2.0
#include "QPlcSchedule.h"

#include "State.h"

QString QPlcSchedule::phaseName(Phase phase)
{
    return QLatin1String(qplc::messages::nameOf(phase));
}
