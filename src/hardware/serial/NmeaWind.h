// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NmeaSentence.h"

#include <optional>

namespace qplc {

/// What a sentence says about wind and air, in SI units. What it does not say has no value.
struct NmeaWind
{
    /// Wind as an instrument sees it.
    struct Wind
    {
        std::optional<double> speed;  ///< [m/s]
        std::optional<double>
            angle;  ///< [rad] 0 ... 2 pi, where it comes from, clockwise from the bow (from the mark of the instrument)
    };
    Wind relative;                      ///< as it is felt
    Wind theoretical;                   ///< without the instrument's own movement ("true" in the standard)
    std::optional<double> direction;    ///< [rad] 0 ... 2 pi, where it comes from, clockwise from true north
    std::optional<double> temperature;  ///< [degC] of the air
    std::optional<double> pressure;     ///< [Pa]
    std::optional<double> humidity;     ///< relative, 0 ... 1
    std::optional<bool> isValid;        ///< what the instrument says of its wind
    bool isOfWind = false;              ///< the sentence is one of those that are understood: MWV, VWR, VWT, MDA, XDR

    static NmeaWind read(const NmeaSentence &sentence);
};

}  // namespace qplc
