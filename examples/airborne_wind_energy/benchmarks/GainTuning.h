// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "ClosedLoopFlight.h"
#include "CoordinateSearch.h"

#include <cstdint>
#include <vector>

namespace awe {

/// What a set of gains is worth: flights of half an hour in calm and turbulent wind, and in strong
/// wind without and with a force limit. Gains for one wind alone are poor in others, down to half
/// the power at 11 m/s.
struct GainScore
{
    // Of the power behind the machine, if the winch has one.
    double calmEta = 0.0;
    double turbulentEta = 0.0;       // mean over the seeds, per mean |w|^3
    double strongEta = 0.0;          // mean of 8, 10 and 12 m/s
    double calmAltitude = 0.0;       // lowest [m]
    double turbulentAltitude = 0.0;  // lowest of all seeds [m]
    double limitedForce = 0.0;       // greatest at 8, 10 and 12 m/s with a limit of forceLimit [N]
    bool crashed = false;            // in any flight

    static constexpr double lowestAltitude = 15.0;  // [m]; a set that goes below it is none ...
    static constexpr double forceLimit = 4000.0;    // [N]; ... nor one that does not keep its limit
    double allowedForce = forceLimit;               // [N]; a tether with mass may jerk a little

    bool isSafe() const;
    /// What is tuned for: the mean of the three etas; -infinity when the set is not safe.
    double value() const;
};

/// Turbulence seeds 1...8 are tuned with, 9...24 tell whether the gains are good or only fit those
/// flights.
enum class TuningSeeds { Tuned, Fresh };

/// Flies a set of gains with the plant, mean wind and dead time of \a parameters.
/// \pre parameters.validate() is empty
GainScore scoreOf(const ClosedLoopParameters &parameters, TuningSeeds seeds = TuningSeeds::Tuned,
                  double duration = 1800.0);
/// The same with the plant of the thesis.
/// \pre gains.validate() is empty
GainScore scoreOf(const AutopilotGains &gains, int deadTime, TuningSeeds seeds = TuningSeeds::Tuned,
                  double duration = 1800.0);

/// A gain that is tuned: laws of the autopilot. Heights that it keeps, limits of winch and wing,
/// and what guards the force limit are not.
struct TunableGain
{
    const char *name;
    double AutopilotGains::*gain;
    Coordinate range;

    static const std::vector<TunableGain> &all();
    static CoordinateSearch::Point read(const AutopilotGains &gains);
    static AutopilotGains write(AutopilotGains gains, const CoordinateSearch::Point &point);
};

/// Where a search starts: the laws of the safe gains at the heights of the tuned ones, and what
/// these heights ask for.
AutopilotGains startOfTuning();
/// The same for a plant with \a steering: the steered gains, which invert its law, at the heights
/// of the tuned ones.
AutopilotGains startOfTuning(const SteeringParameters &steering);

}  // namespace awe
