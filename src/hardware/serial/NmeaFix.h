// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NmeaSentence.h"

#include <optional>

namespace qplc {

/// What a sentence of a receiver for satellite navigation says, in SI units. What it does not say
/// has no value.
struct NmeaFix
{
    std::optional<double> latitude;         ///< [rad] -pi/2 ... pi/2, north is positive
    std::optional<double> longitude;        ///< [rad] -pi ... pi, east is positive
    std::optional<double> altitude;         ///< [m] above mean sea level
    std::optional<double> geoidSeparation;  ///< [m] of mean sea level above the ellipsoid
    std::optional<double> speed;            ///< [m/s] over ground
    std::optional<double> course;           ///< [rad] 0 ... 2 pi over ground, clockwise from true north
    std::optional<double> time;             ///< [s] UTC since 1970
    std::optional<double> quality;          ///< 0 ... 8 as GGA has it: 0 none, 1 GNSS, 2 differential, 4 RTK
    std::optional<double> satellites;       ///< that are used
    std::optional<double> hdop;             ///< horizontal dilution of precision
    std::optional<double> correctionAge;    ///< [s]

    std::optional<bool> hasPosition;  ///< what the receiver says: measured, not estimated, typed in, or simulated
    std::optional<bool> hasMotion;    ///< likewise, of speed and course
    bool isOfFix = false;             ///< the sentence is one of those that are understood: GGA, RMC, VTG

    static NmeaFix read(const NmeaSentence &sentence);
};

}  // namespace qplc
