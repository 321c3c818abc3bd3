// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MastGains.h"

#include <limits>
#include <string>

namespace awe {

/// Everything that can be set on the autopilot. The values here are the safe set; see tuned(). Set
/// forceLimit for a winch that bears less. Angles in degrees, as the signals have them.
struct AutopilotGains
{
    double step = 0.010;  // control period [s]

    // Orientation controller
    double yawGain = 6.0;              // [1/s]
    double yawReferenceLimit = 150.0;  // [deg]
    double slowYawSpeed = 90.0;        // yaw speed limit at referenceSpeed and below [deg/s]
    double largestYawSpeed = 180.0;    // [deg/s]
    double referenceSpeed = 16.0;      // tangential speed up to which the yaw limit and the look-ahead stay [m/s]
    double pitchGain = 4.0;            // [1/s]
    double largestPitchSpeed = 60.0;   // [deg/s]
    double lowestPitch = -110.0;       // [deg]

    // Steering of a wing that the air turns
    double turnRateFactor = 0.0;        // c_1 of the wing [rad/m]; 0: the yaw speed itself is the command
    double weightFactor = 0.076;        // c_2 of the wing [m/s^2]
    double slowestSteeringSpeed = 5.0;  // below it the command does not grow any more [m/s]

    // Course controller
    double eightHalfWidth = 27.0;         // W [m]
    double eightHalfHeight = 6.5;         // H [m]
    double lowestHeight = 30.0;           // of the eight's lower edge [m]
    double lowestElevation = 10.0;        // of the eight's lower edge [deg]
    double lookAhead = 11.0;              // L at referenceSpeed [m]
    double lookAheadExponent = 0.75;      // L grows with (speed / referenceSpeed)^exponent
    double courseGain = 0.8;              // [-]
    double courseCorrectionLimit = 40.0;  // [deg]
    double slowestCourseSpeed = 3.0;      // below it the heading stands for the course [m/s]
    double guardHeight = 12.0;            // no dive may need to go below it [m]
    double guardLookAhead = 0.5;          // [s]
    double guardFactor = 1.3;             // safety of the turn radius
    double zenithAzimuthGain = 1.0;       // [deg/deg]
    double zenithDamping = 7.0;           // [deg s/m]
    double zenithYawLimit = 50.0;         // [deg]

    // Power controller
    double forceCoefficient = 421.0;      // C = 2 rho A c_AWE,max [N s^2/m^2]
    double reelOutFactor = 0.75;          // kappa; 1 takes most power out, less shortens the share of reeling in
    double reelOutPitch = 9.0;            // beta_c while reeling out [deg]
    double shortestTether = 100.0;        // reel in down to this [m]
    double longestTether = 200.0;         // reel out up to this [m]
    double fastestReelOut = 10.0;         // [m/s]
    double fastestReelIn = 10.0;          // [m/s]
    double winchAcceleration = 5.0;       // [m/s^2]
    double launchSpeed = 8.0;             // tangential speed that ends the launch [m/s]
    double launchTime = 5.0;              // at the latest [s]
    double powerTime = 4.0;               // Power -> ReelOut [s]
    double retractFactor = 0.3;           // part of the reel-out law
    double retractYaw = 80.0;             // nose high enough to reel in [deg]
    double retractTime = 6.0;             // at the latest [s]
    double reelInWindFactor = 1.3;        // reel-in speed / estimated wind speed
    double reelInElevation = 20.0;        // [deg]
    double reelInAngleOfAttack = -4.0;    // [deg] ...
    double lowestReelInAngle = -20.0;     // ... never below this [deg] ...
    double highestReelInAngle = 15.0;     // ... or above this [deg]
    double reelInElevationGain = 0.5;     // [deg/deg]
    double reelInZenithDamping = 1.7;     // [deg s/m]
    double reelInPayOut = 3.0;            // fastest reel-out while the force is too high in ReelIn [m/s]
    double reelInForceFactor = 0.3;       // force that stops the reel-in / best reel-out force
    double recoverAngleOfAttack = 35.0;   // a stall shows this and more [deg] ...
    double recoverSpeed = 7.0;            // ... and less than this tangential speed [m/s] ...
    double recoverDelay = 0.6;            // ... for this long [s]
    double recoverGrace = 2.5;            // no stall is told this soon after a start [s]
    double recoverPitchTarget = 13.0;     // angle of attack while recovering [deg]
    double recoverHeight = 28.0;          // recovered above it [m] ...
    double recoverTime = 1.5;             // ... after this long [s]
    double recoverTargetHeight = 35.0;    // [m]
    double recoverWinchGain = 0.5;        // [1/s]
    double recoverReelIn = 8.0;           // [m/s]
    double recoverShortestTether = 50.0;  // [m]

    // Drag mode
    double constantTether = 0.0;      // tether length to hold while on the eight [m]; 0: pumping cycles
    double constantTetherGain = 0.5;  // [1/s]
    double turbineCoefficient = 0.0;  // c_dt while on the eight [-]

    MastGains mast;

    // Filters
    double forceFilterTime = 0.25;          // [s]
    double speedFilterTime = 3.0;           // [s]
    double startSpeed = 12.0;               // of the speed filter [m/s]
    double windDirectionFilterTime = 20.0;  // [s]

    // Upper limit of the tether force
    double forceLimit = std::numeric_limits<double>::infinity();  // [N]; infinity: none
    double forceLimitMargin = 0.95;                               // set point of the winch / forceLimit
    double forceLimitIntegral = 0.02;                             // winch [m/s per N s]
    double forceLimitProportional = 0.003;                        // winch [m/s per N]
    double forceGuardGain = 0.04;                                 // pitch [deg/s per N]
    double forceGuardLead = 1.0;                                  // looks forceFilterTime times this ahead [-]

    static AutopilotGains safe() { return {}; }

    /// More power, less height: the lower edge of the eight at 18 m instead of 30 m. For every dead
    /// time; docs/figures.md says how they were found.
    static AutopilotGains tuned();

    /// For a wing that the air turns (SteeringController): a wider eight, which it can follow.
    static AutopilotGains steered();
    /// The same with more power, for a wind that grows with the height: docs/figures.md says how
    /// they were found.
    static AutopilotGains steeredTuned();
    /// These gains, for a wing with another turn-rate law.
    /// \param turnRate  c_1 [rad/m]
    /// \param weight    c_2 [m/s^2]
    AutopilotGains invertedFor(double turnRate, double weight) const;
    /// For turbines on board: a tether of 150 m that stays as it is.
    static AutopilotGains drag();
    /// The same with more power, less height: the heights of tuned().
    static AutopilotGains dragTuned();

    /// \return empty when all is well, otherwise one sentence with the gain, its value and the
    ///         remedy
    std::string validate() const;
};

}  // namespace awe
