// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcValue.h"

#include <optional>

namespace qplc {

/// A limit of the table (QPlcSignalDefinition::minimum, maximum) as a number; none when the table
/// has none.
inline std::optional<double> limitOf(const QPlcValue &value)
{
    return value.isValid() ? std::optional<double>(value.toReal()) : std::nullopt;
}

}  // namespace qplc
