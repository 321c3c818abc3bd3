// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcValue.h"

namespace qplc {

/// a < b for one element of each, which have the same type; false when one is NaN
inline bool isLess(const QPlcValue &a, int elementOfA, const QPlcValue &b, int elementOfB)
{
    if (a.type().isReal())
        return a.toReal(elementOfA) < b.toReal(elementOfB);
    if (a.type().scalar() == QPlcSignalType::UInt64)
        return a.toUInt64(elementOfA) < b.toUInt64(elementOfB);
    return a.toInt64(elementOfA) < b.toInt64(elementOfB);
}

}  // namespace qplc
