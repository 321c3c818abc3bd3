// SPDX-License-Identifier: Apache-2.0
#include "WinchDriveParameters.h"

#include "RangeCheck.h"

namespace awe {

std::string WinchDriveParameters::validate() const
{
    RangeCheck check;
    check.constants(*this);
    check.within("brakeTorque", brakeTorque, 0.0, 1e6, "N m");
    check.within("stopDeceleration", stopDeceleration, 1e-3, 1e6, "rad/s²");
    check.within("longestStop", longestStop, 1e-3, 1e3, "s");
    check.within("standstill", standstill, 1e-3, largestSpeed, "rad/s");
    check.within("commandTimeout", commandTimeout, step, 1e3, "s");
    check.within("step", step, 1e-6, 0.01, "s");
    return check.message();
}

}  // namespace awe
