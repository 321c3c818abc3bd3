// SPDX-License-Identifier: Apache-2.0
#include "QPlcSchedule.h"

QString QPlcSchedule::phaseName(Phase phase)
{
    switch (phase) {
    case Step:
        return QStringLiteral("step");
    case Outputs:
        return QStringLiteral("outputs");
    case Update:
        return QStringLiteral("update");
    }
    return {};
}
