// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SerialLine.h"

class QPlcDriverSettings;

namespace qplc {

/// The keys of a section that concern its serial line: `device`, `baud`, `format`, and those of
/// SerialMode. The line is claimed.
struct SerialKeys
{
    QString device;
    SerialSettings line;

    void read(QPlcDriverSettings &settings, int usualBaud);
};

}  // namespace qplc
