// SPDX-License-Identifier: Apache-2.0
#include "WinchDriveParameters.h"

#include "RangeCheck.h"

namespace awe {

std::string WinchDriveParameters::validate() const
{
    RangeCheck check;
    check.within("drumRadius", drumRadius, 1e-3, 100.0, "m");
    check.within("gearRatio", gearRatio, 1e-2, 1e4, "");
    check.within("drumInertia", drumInertia, 0.0, 1e6, "kg m²");
    check.within("rotorInertia", rotorInertia, 1e-6, 1e6, "kg m²");
    check.within("dryFriction", dryFriction, 0.0, 1e6, "N m");
    check.within("viscousFriction", viscousFriction, 0.0, 1e6, "N m s/rad");
    check.within("brakeTorque", brakeTorque, 0.0, 1e6, "N m");
    check.within("torqueConstant", torqueConstant, 1e-3, 1e3, "N m/A");
    check.within("windingResistance", windingResistance, 0.0, 1e3, "ohm");
    check.within("currentLimit", currentLimit, 1e-3, 1e5, "A");
    check.within("currentLoopTime", currentLoopTime, 1e-5, 1.0, "s");
    check.within("converterLoss", converterLoss, 0.0, 1e6, "W");
    check.within("speedBandwidth", speedBandwidth, 1e-2, 1e4, "rad/s");
    check.within("speedIntegralTime", speedIntegralTime, 1e-4, 1e3, "s");
    check.within("acceleration", acceleration, 1e-3, 1e6, "rad/s²");
    check.within("stopDeceleration", stopDeceleration, 1e-3, 1e6, "rad/s²");
    check.within("longestStop", longestStop, 1e-3, 1e3, "s");
    check.within("standstill", standstill, 1e-3, 1e3, "rad/s");
    check.within("largestSpeed", largestSpeed, standstill, 1e5, "rad/s");
    check.within("commandTimeout", commandTimeout, step, 1e3, "s");
    check.within("step", step, 1e-6, 0.01, "s");
    return check.message();
}

}  // namespace awe
