// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"

namespace tools {

/// Prints lines of values as they come: what echo does, and watch where no terminal is.
/// \param names  signals of \a table \param rate  most lines per second \param count  lines; below 0: until the end
/// \return the exit code
int printLines(const CommandCall &call, const QPlcSignalTable &table, const QStringList &names, double rate,
               qint64 count);

}  // namespace tools
