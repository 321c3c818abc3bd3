// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <chrono>

namespace qplc {

/// "10 ms", "250us", "1e-3 s", "2 h": a number and its unit. \param nanoseconds may have a
/// fraction, and any sign
/// \return false when \a text is not a duration
bool durationFromText(const QString &text, double *nanoseconds);
/// "500 ms": the whole number with the largest unit up to seconds.
QString durationText(std::chrono::nanoseconds duration);

}  // namespace qplc
