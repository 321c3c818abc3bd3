// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SerialLine.h"

class QPlcDriverSettings;

namespace qplc {

/// The keys of a section that concern its serial line: `device`, `baud`, `format`. The line is
/// claimed.
struct SerialKeys
{
    QString device;
    SerialSettings settings;

    void read(QPlcDriverSettings &keys, int usualBaud);
};

}  // namespace qplc
