// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/layout/Layout.h"

namespace qplc {

/// What every plant is shown with that brings no layout of its own: tab "Signals" with values and a
/// plot, and tab "Real time" with nodes, jitter and events.
Layout defaultLayout();

}  // namespace qplc
