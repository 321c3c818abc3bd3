// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CycleReports.h"

#include <QtCore/QString>

namespace qplc {

/// Writes the exact bytes of \a frame to the category qtplc.cyclic.
void logFrame(const QString &owner, const TappedFrame &frame);

}  // namespace qplc
