// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDistribution.h"

#include <QtCore/QStringList>

namespace tools {

/// A duration in the unit that suits it, with three digits: "850 ns", "12.3 µs", "1.50 ms", "2.00
/// s".
QString durationText(double nanoseconds);

/// A histogram as lines of text: logarithmic bins, a bar of Unicode blocks for each, its count and
/// its share.
///
/// Rows go by 1, 2, 5, 10; where less than a decade is in use, by ten steps a decade. A row begins
/// above the upper border of the one before.
/// \param width  of the lines [characters], at least 40
QStringList histogramLines(const QVector<QPlcDistribution::Bin> &bins, int width);

}  // namespace tools
