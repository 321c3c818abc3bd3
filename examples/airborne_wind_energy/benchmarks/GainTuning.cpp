// SPDX-License-Identifier: Apache-2.0
#include "GainTuning.h"

#include <algorithm>
#include <limits>

namespace awe {

namespace {

constexpr double turbulence = 0.15;

/// Of the power that leaves the plant: behind the machine, if the winch has one.
double usefulPart(const ClosedLoopParameters &parameters, const FlightReport &report)
{
    return parameters.options.hasMachine ? report.electricalPower / report.meanPower : 1.0;
}

FlightReport fly(const ClosedLoopParameters &parameters, double duration)
{
    ClosedLoopFlight flight(parameters);
    flight.fly(duration);
    return flight.report();
}

void flyCalm(const ClosedLoopParameters &parameters, double duration, GainScore *score)
{
    const FlightReport report = fly(parameters, duration);
    score->calmEta = report.eta * usefulPart(parameters, report);
    score->calmAltitude = report.minimumAltitude;
    score->crashed = score->crashed || report.crashed;
}

void flyTurbulent(ClosedLoopParameters parameters, TuningSeeds seeds, double duration, GainScore *score)
{
    const std::uint64_t first = seeds == TuningSeeds::Tuned ? 1 : 9;
    const std::uint64_t last = seeds == TuningSeeds::Tuned ? 8 : 24;
    parameters.wind.turbulenceIntensity = turbulence;
    score->turbulentAltitude = std::numeric_limits<double>::infinity();
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        parameters.wind.seed = seed;
        const FlightReport report = fly(parameters, duration);
        score->turbulentEta
            += report.etaPerMeanCubedWind * usefulPart(parameters, report) / static_cast<double>(last - first + 1);
        score->turbulentAltitude = std::min(score->turbulentAltitude, report.minimumAltitude);
        score->crashed = score->crashed || report.crashed;
    }
}

void flyStrong(ClosedLoopParameters parameters, double duration, GainScore *score)
{
    const Eigen::Vector3d direction = parameters.wind.meanVelocity.normalized();
    const double noLimit = parameters.gains.forceLimit;
    const auto speeds = {8.0, 10.0, 12.0};
    for (double speed : speeds) {
        parameters.wind.meanVelocity = speed * direction;
        parameters.gains.forceLimit = noLimit;
        const FlightReport free = fly(parameters, duration);
        parameters.gains.forceLimit = GainScore::forceLimit;
        const FlightReport limited = fly(parameters, duration);
        score->strongEta += free.eta * usefulPart(parameters, free) / static_cast<double>(speeds.size());
        score->limitedForce = std::max(score->limitedForce, limited.maximumTetherForce);
        score->crashed = score->crashed || free.crashed || limited.crashed;
    }
}

}  // namespace

bool GainScore::isSafe() const
{
    return !crashed && std::min(calmAltitude, turbulentAltitude) >= lowestAltitude && limitedForce <= allowedForce;
}

double GainScore::value() const
{
    return isSafe() ? (calmEta + turbulentEta + strongEta) / 3.0 : -std::numeric_limits<double>::infinity();
}

GainScore scoreOf(const ClosedLoopParameters &parameters, TuningSeeds seeds, double duration)
{
    GainScore score;
    if (parameters.options.tether.kind == TetherKind::Segments)
        score.allowedForce *= 1.02;
    flyCalm(parameters, duration, &score);
    flyTurbulent(parameters, seeds, duration, &score);
    flyStrong(parameters, duration, &score);
    return score;
}

GainScore scoreOf(const AutopilotGains &gains, int deadTime, TuningSeeds seeds, double duration)
{
    ClosedLoopParameters parameters;
    parameters.gains = gains;
    parameters.deadTime = deadTime;
    return scoreOf(parameters, seeds, duration);
}

const std::vector<TunableGain> &TunableGain::all()
{
    using Gains = AutopilotGains;
    static const std::vector<TunableGain> gains = {
        {"yawGain", &Gains::yawGain, {1.0, 20.0, 1.0}},
        {"pitchGain", &Gains::pitchGain, {1.0, 20.0, 1.0}},
        {"eightHalfWidth", &Gains::eightHalfWidth, {15.0, 50.0, 2.0}},
        {"eightHalfHeight", &Gains::eightHalfHeight, {2.0, 15.0, 0.5}},
        {"lookAhead", &Gains::lookAhead, {4.0, 25.0, 1.0}},
        {"lookAheadExponent", &Gains::lookAheadExponent, {0.0, 1.0, 0.1}},
        {"courseGain", &Gains::courseGain, {0.0, 2.0, 0.1}},
        {"zenithAzimuthGain", &Gains::zenithAzimuthGain, {0.0, 4.0, 0.2}},
        {"zenithDamping", &Gains::zenithDamping, {0.0, 20.0, 1.0}},
        {"reelOutFactor", &Gains::reelOutFactor, {0.4, 1.2, 0.02}},
        {"reelOutPitch", &Gains::reelOutPitch, {0.0, 15.0, 0.5}},
        {"retractFactor", &Gains::retractFactor, {0.0, 1.0, 0.1}},
        {"retractYaw", &Gains::retractYaw, {30.0, 120.0, 5.0}},
        {"reelInWindFactor", &Gains::reelInWindFactor, {0.5, 2.0, 0.05}},
        {"reelInElevation", &Gains::reelInElevation, {5.0, 40.0, 1.0}},
        {"reelInAngleOfAttack", &Gains::reelInAngleOfAttack, {-10.0, 5.0, 0.5}},
        {"reelInElevationGain", &Gains::reelInElevationGain, {0.0, 2.0, 0.1}},
        {"reelInZenithDamping", &Gains::reelInZenithDamping, {0.0, 5.0, 0.2}},
        {"reelInForceFactor", &Gains::reelInForceFactor, {0.1, 1.0, 0.05}},
    };
    return gains;
}

CoordinateSearch::Point TunableGain::read(const AutopilotGains &gains)
{
    CoordinateSearch::Point point;
    for (const TunableGain &tunable : all())
        point.push_back(gains.*tunable.gain);
    return point;
}

AutopilotGains TunableGain::write(AutopilotGains gains, const CoordinateSearch::Point &point)
{
    for (std::size_t i = 0; i < point.size(); ++i)
        gains.*all()[i].gain = point[i];
    return gains;
}

AutopilotGains startOfTuning()
{
    AutopilotGains gains = TunableGain::write(AutopilotGains::tuned(), TunableGain::read(AutopilotGains::safe()));
    gains.reelInElevation = 13.0;  // an eight that is lower by far is not left for 20 deg each time
    return gains;
}

AutopilotGains startOfTuning(const SteeringParameters &steering)
{
    if (steering.kind == SteeringKind::Kinematic)
        return startOfTuning();
    AutopilotGains gains = AutopilotGains::steered().invertedFor(steering.turnRateFactor, steering.weightFactor);
    gains.lowestElevation = AutopilotGains::steeredTuned().lowestElevation;
    return gains;
}

}  // namespace awe
