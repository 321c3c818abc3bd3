// SPDX-License-Identifier: Apache-2.0
#include "HardwareLogging.h"

Q_LOGGING_CATEGORY(lcHardware, "qtplc.hardware")
