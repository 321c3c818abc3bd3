// SPDX-License-Identifier: Apache-2.0
#include "AutopilotGains.h"

#include "RangeCheck.h"

namespace awe {

namespace {

void checkOrientation(const AutopilotGains &g, RangeCheck &check)
{
    check.within("yawGain", g.yawGain, 0.0, 100.0, "1/s");
    check.within("yawReferenceLimit", g.yawReferenceLimit, 1.0, 180.0, "deg");
    check.within("slowYawSpeed", g.slowYawSpeed, 1.0, g.largestYawSpeed, "deg/s");
    check.within("largestYawSpeed", g.largestYawSpeed, 1.0, 1000.0, "deg/s");
    check.within("referenceSpeed", g.referenceSpeed, 0.1, 1000.0, "m/s");
    check.within("pitchGain", g.pitchGain, 0.0, 100.0, "1/s");
    check.within("largestPitchSpeed", g.largestPitchSpeed, 1.0, 1000.0, "deg/s");
    check.within("turnRateFactor", g.turnRateFactor, 0.0, 100.0, "rad/m");
    check.within("weightFactor", g.weightFactor, 0.0, 100.0, "m/s²");
    check.within("slowestSteeringSpeed", g.slowestSteeringSpeed, 0.1, 100.0, "m/s");
    check.within("lowestPitch", g.lowestPitch, -180.0, g.reelOutPitch, "deg");
}

void checkCourse(const AutopilotGains &g, RangeCheck &check)
{
    check.within("eightHalfWidth", g.eightHalfWidth, 1.0, 1000.0, "m");
    check.within("eightHalfHeight", g.eightHalfHeight, 0.0, 1000.0, "m");
    check.within("lowestHeight", g.lowestHeight, 0.0, 1000.0, "m");
    check.within("lowestElevation", g.lowestElevation, 0.0, 60.0, "deg");
    check.within("lookAhead", g.lookAhead, 0.1, g.eightHalfWidth, "m");
    check.within("lookAheadExponent", g.lookAheadExponent, 0.0, 1.0, "");
    check.within("courseGain", g.courseGain, 0.0, 10.0, "");
    check.within("courseCorrectionLimit", g.courseCorrectionLimit, 0.0, 90.0, "deg");
    check.within("slowestCourseSpeed", g.slowestCourseSpeed, 0.0, 100.0, "m/s");
    check.within("guardHeight", g.guardHeight, 0.0, 1000.0, "m");
    check.within("guardLookAhead", g.guardLookAhead, 0.0, 10.0, "s");
    check.within("guardFactor", g.guardFactor, 0.1, 10.0, "");
    check.within("zenithAzimuthGain", g.zenithAzimuthGain, 0.0, 100.0, "deg/deg");
    check.within("zenithDamping", g.zenithDamping, 0.0, 100.0, "deg s/m");
    check.within("zenithYawLimit", g.zenithYawLimit, 0.0, 90.0, "deg");
}

void checkCycle(const AutopilotGains &g, RangeCheck &check)
{
    check.within("forceCoefficient", g.forceCoefficient, 1e-3, 1e9, "N s²/m²");
    check.within("reelOutFactor", g.reelOutFactor, 0.0, 2.0, "");
    check.within("reelOutPitch", g.reelOutPitch, -45.0, 45.0, "deg");
    check.within("shortestTether", g.shortestTether, 1.0, g.longestTether, "m");
    check.within("longestTether", g.longestTether, 1.0, 1e5, "m");
    check.within("fastestReelOut", g.fastestReelOut, 0.0, 100.0, "m/s");
    check.within("fastestReelIn", g.fastestReelIn, 0.0, 100.0, "m/s");
    check.within("winchAcceleration", g.winchAcceleration, 0.01, 1000.0, "m/s²");
    check.within("launchSpeed", g.launchSpeed, 0.0, 100.0, "m/s");
    check.within("launchTime", g.launchTime, 0.0, 1000.0, "s");
    check.within("powerTime", g.powerTime, 0.0, 1000.0, "s");
    check.within("retractFactor", g.retractFactor, 0.0, 2.0, "");
    check.within("retractYaw", g.retractYaw, 0.0, 180.0, "deg");
    check.within("retractTime", g.retractTime, 0.0, 1000.0, "s");
    check.within("reelInWindFactor", g.reelInWindFactor, 0.0, 10.0, "");
    check.within("reelInElevation", g.reelInElevation, 0.0, 80.0, "deg");
    check.within("reelInAngleOfAttack", g.reelInAngleOfAttack, -90.0, 90.0, "deg");
    check.within("lowestReelInAngle", g.lowestReelInAngle, -90.0, g.highestReelInAngle, "deg");
    check.within("highestReelInAngle", g.highestReelInAngle, -90.0, 90.0, "deg");
    check.within("reelInElevationGain", g.reelInElevationGain, 0.0, 100.0, "deg/deg");
    check.within("reelInZenithDamping", g.reelInZenithDamping, 0.0, 100.0, "deg s/m");
    check.within("reelInPayOut", g.reelInPayOut, 0.0, g.fastestReelOut, "m/s");
    check.within("reelInForceFactor", g.reelInForceFactor, 1e-3, 10.0, "");
}

void checkRecovery(const AutopilotGains &g, RangeCheck &check)
{
    check.within("recoverAngleOfAttack", g.recoverAngleOfAttack, 0.0, 90.0, "deg");
    check.within("recoverSpeed", g.recoverSpeed, 0.0, 100.0, "m/s");
    check.within("recoverDelay", g.recoverDelay, 0.0, 100.0, "s");
    check.within("recoverGrace", g.recoverGrace, 0.0, 100.0, "s");
    check.within("recoverPitchTarget", g.recoverPitchTarget, -90.0, 90.0, "deg");
    check.within("recoverHeight", g.recoverHeight, 0.0, 1000.0, "m");
    check.within("recoverTime", g.recoverTime, 0.0, 1000.0, "s");
    check.within("recoverTargetHeight", g.recoverTargetHeight, g.recoverHeight, 1000.0, "m");
    check.within("recoverWinchGain", g.recoverWinchGain, 0.0, 100.0, "1/s");
    check.within("recoverReelIn", g.recoverReelIn, 0.0, 100.0, "m/s");
    check.within("constantTether", g.constantTether, 0.0, 1e5, "m");
    check.within("constantTetherGain", g.constantTetherGain, 0.0, 100.0, "1/s");
    check.within("turbineCoefficient", g.turbineCoefficient, 0.0, 10.0, "");
    check.within("recoverShortestTether", g.recoverShortestTether, 1.0, g.longestTether, "m");
}

void checkFiltersAndLimit(const AutopilotGains &g, RangeCheck &check)
{
    check.within("step", g.step, 1e-6, 1.0, "s");
    check.within("forceFilterTime", g.forceFilterTime, 1e-6, 1000.0, "s");
    check.within("speedFilterTime", g.speedFilterTime, 1e-6, 1000.0, "s");
    check.within("startSpeed", g.startSpeed, 0.0, 1000.0, "m/s");
    check.within("windDirectionFilterTime", g.windDirectionFilterTime, 1e-6, 1e6, "s");
    check.within("forceLimit", g.forceLimit, 1.0, std::numeric_limits<double>::infinity(), "N");
    check.within("forceLimitMargin", g.forceLimitMargin, 0.1, 1.0, "");
    check.within("forceLimitIntegral", g.forceLimitIntegral, 0.0, 10.0, "m/s per N s");
    check.within("forceLimitProportional", g.forceLimitProportional, 0.0, 1.0, "m/s per N");
    check.within("forceGuardGain", g.forceGuardGain, 0.0, 10.0, "deg/s per N");
    check.within("forceGuardLead", g.forceGuardLead, 0.0, 10.0, "");
}

}  // namespace

// The heights are chosen; the laws come from a search without dead time (awe_tune_gains).
AutopilotGains AutopilotGains::tuned()
{
    AutopilotGains gains;
    gains.lowestHeight = 18.0;
    gains.lowestElevation = 5.0;
    gains.guardFactor = 1.1;

    gains.yawGain = 4.0;
    gains.eightHalfWidth = 25.0;
    gains.eightHalfHeight = 5.5;
    gains.zenithAzimuthGain = 0.8;
    gains.zenithDamping = 6.0;
    gains.reelOutFactor = 0.74;
    gains.reelInWindFactor = 1.4;
    gains.reelInElevation = 12.0;
    gains.reelInForceFactor = 0.375;
    return gains;
}

AutopilotGains AutopilotGains::steered()
{
    AutopilotGains gains;
    gains.turnRateFactor = 0.31;
    gains.eightHalfWidth = 40.0;
    gains.eightHalfHeight = 12.0;
    gains.lookAhead = 18.0;
    return gains;
}

// Coordinates of awe_tune_gains --plant realistic, tried by hand; the wind is stronger higher up.
AutopilotGains AutopilotGains::steeredTuned()
{
    AutopilotGains gains = steered();
    gains.lowestElevation = 15.0;

    gains.eightHalfWidth = 46.0;
    gains.lookAhead = 16.0;
    gains.reelOutFactor = 0.78;
    gains.reelOutPitch = 8.2;
    gains.reelInWindFactor = 1.2;
    return gains;
}

AutopilotGains AutopilotGains::invertedFor(double turnRate, double weight) const
{
    AutopilotGains gains = *this;
    gains.turnRateFactor = turnRate;
    gains.weightFactor = weight;
    return gains;
}

AutopilotGains AutopilotGains::drag()
{
    AutopilotGains gains;
    gains.constantTether = 150.0;
    gains.reelOutPitch = 2.5;
    gains.turbineCoefficient = 0.1106;  // half of c_d at the best angle of attack (thesis, equation 2.16)
    return gains;
}

// Heights alone: other eights have more power in weak wind, and less from 7 m/s on.
AutopilotGains AutopilotGains::dragTuned()
{
    const AutopilotGains low = tuned();
    AutopilotGains gains = drag();
    gains.lowestHeight = low.lowestHeight;
    gains.lowestElevation = low.lowestElevation;
    gains.guardFactor = low.guardFactor;
    return gains;
}

std::string AutopilotGains::validate() const
{
    RangeCheck check;
    checkOrientation(*this, check);
    checkCourse(*this, check);
    checkCycle(*this, check);
    checkRecovery(*this, check);
    checkFiltersAndLimit(*this, check);
    mast.check(check);
    if (mast.isPresent && constantTether > 0.0)  // the cycle begins where the ascent ends
        check.within("turbines.tetherLength", constantTether, mast.parkTether, 1e5, "m");
    return check.message();
}

}  // namespace awe
