// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kite/KiteOverlay.h"
#include "kite/KiteText.h"

namespace qplc {

// The 3D view shares what it knows of a kite with the wind window of the example.
using namespace awe;

}  // namespace qplc
