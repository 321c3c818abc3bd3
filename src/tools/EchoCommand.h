// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"

namespace tools {

/// What of the cycles is printed.
struct LineRate
{
    double rate = 10.0;  // most lines per second
    qint64 count = -1;   // lines; below 0: until the end
    qint64 every = 1;    // cycles for each that is heard
};

/// Prints lines of values as they come: what echo does, and watch where no terminal is.
/// \param names  signals of \a table
/// \return the exit code
int printLines(const CommandCall &call, const QPlcSignalTable &table, const QStringList &names, const LineRate &rate);

/// Reads the option --every. \return false, with the message out
bool readEvery(const CommandCall &call, qint64 *every);

}  // namespace tools
