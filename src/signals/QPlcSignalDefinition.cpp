// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalDefinition.h"

#include "ValueOrder.h"

#include <cmath>

bool QPlcSignalDefinition::isInRange(const QPlcValue &value) const
{
    const bool isLimited = minimum.isValid() || maximum.isValid();
    for (int i = 0; isLimited && i < value.type().count(); ++i) {
        const bool isBelow = minimum.isValid() && qplc::isLess(value, i, minimum, 0);
        const bool isAbove = maximum.isValid() && qplc::isLess(maximum, 0, value, i);
        const bool isNumber = nanAllowed || !value.type().isReal() || !std::isnan(value.toReal(i));
        if (isBelow || isAbove || !isNumber)
            return false;
    }
    return true;
}

QPlcValue QPlcSignalDefinition::safeValue() const
{
    if (safe.isValid())
        return safe;
    const QPlcValue zero(type);
    if (isInRange(zero))
        return zero;
    const bool isAboveZero = minimum.isValid() && minimum.toReal() > 0.0;
    return (isAboveZero ? minimum : maximum).convertedTo(type);
}

QString QPlcSignalDefinition::rangeText() const
{
    if (!minimum.isValid() && !maximum.isValid())
        return {};
    if (!maximum.isValid())
        return QStringLiteral("at least ") + minimum.toString();
    if (!minimum.isValid())
        return QStringLiteral("at most ") + maximum.toString();
    return minimum.toString() + QStringLiteral(" ... ") + maximum.toString();
}
