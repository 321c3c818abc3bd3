// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTimeAxis.h"

namespace qplc {

using TimeView = QPlcTimeAxis;

}  // namespace qplc
