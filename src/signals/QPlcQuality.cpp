// SPDX-License-Identifier: Apache-2.0
#include "QPlcQuality.h"

QString QPlcQuality::toString() const
{
    switch (kind()) {
    case Good:
        return QStringLiteral("good");
    case Held:
        return QStringLiteral("held %1").arg(heldCycles());
    case Safe:
        return QStringLiteral("safe");
    case Invalid:
        break;
    }
    return QStringLiteral("invalid");
}
