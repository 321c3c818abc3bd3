// SPDX-License-Identifier: Apache-2.0
#include "QPlcProfile.h"

QString QPlcProfile::name(Value profile)
{
    switch (profile) {
    case Automatic:
        return QStringLiteral("Automatic");
    case Simulation:
        return QStringLiteral("Simulation");
    case Plant:
        return QStringLiteral("Plant");
    }
    return {};
}

bool QPlcProfile::fromName(const QString &text, Value *profile)
{
    for (const Value value : {Automatic, Simulation, Plant}) {
        if (text.compare(name(value), Qt::CaseInsensitive) != 0)
            continue;
        *profile = value;
        return true;
    }
    return false;
}
