// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace qplc {

// [m/s] of the units of speed in sentences.
constexpr double MetresPerSecondOfKnot = 1852.0 / 3600.0;
constexpr double MetresPerSecondOfKmh = 1.0 / 3.6;

}  // namespace qplc
