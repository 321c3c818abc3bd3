// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>

namespace awe {

/// How the turbulence is made.
enum class TurbulenceModel {
    FirstOrder,  ///< an Ornstein-Uhlenbeck process of the length L: a simple spectrum
    Kaimal       ///< the spectrum of IEC 61400-1 (KaimalTurbulence)
};

/// What the wind does. The values here are those of the thesis: constant (5, 3, 0) m/s.
struct WindParameters
{
    Eigen::Vector3d meanVelocity = Eigen::Vector3d(5.0, 3.0, 0.0);  // [3] [m/s], earth frame
    double turbulenceIntensity = 0.0;  // standard deviation along the mean wind / mean speed [-]
    Eigen::Vector3d turbulenceRatio = Eigen::Vector3d(1.0, 0.8, 0.5);  // along : across : upwards, IEC 61400-1 [-]
    TurbulenceModel turbulenceModel = TurbulenceModel::FirstOrder;
    double lengthScale = 60.0;    // L of the first-order turbulence, Lambda of Kaimal's (42 m above 60 m height) [m]
    std::uint64_t seed = 1;       // chooses one course of the turbulence
    double gustAmplitude = 0.0;   // part of the mean wind added at the peak [-]
    double gustStart = 0.0;       // [s] after reset
    double gustDuration = 6.0;    // [s]
    double dayShare = 1.0;        // part of all wind, turbulence too, at begin and end of a day [-]; 1: no days
    double dayDuration = 2400.0;  // [s]
    double step = 0.010;          // time between two values [s]

    /// Calls visit(name, value, smallest, largest, unit) for each constant of \a parameters that a
    /// file may set.
    template<typename Parameters, typename Visitor>
    static void visitConstants(Parameters &parameters, Visitor visit)
    {
        visit("turbulenceIntensity", parameters.turbulenceIntensity, 0.0, 1.0, "");
        visit("lengthScale", parameters.lengthScale, 0.1, 1e5, "m");
        visit("gustAmplitude", parameters.gustAmplitude, -1.0, 10.0, "");
        visit("gustStart", parameters.gustStart, 0.0, 1e9, "s");
        visit("gustDuration", parameters.gustDuration, 1e-3, 1e6, "s");
        visit("dayShare", parameters.dayShare, 0.0, 1.0, "");
        visit("dayDuration", parameters.dayDuration, 1e-3, 1e6, "s");
    }

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe
