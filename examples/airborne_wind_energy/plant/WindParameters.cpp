// SPDX-License-Identifier: Apache-2.0
#include "WindParameters.h"

#include "RangeCheck.h"

namespace awe {

std::string WindParameters::validate() const
{
    RangeCheck check;
    for (int i = 0; i < 3; ++i)
        check.within("meanVelocity", meanVelocity[i], -100.0, 100.0, "m/s");
    for (int i = 0; i < 3; ++i)
        check.within("turbulenceRatio", turbulenceRatio[i], 0.0, 10.0, "");
    check.within("turbulenceIntensity", turbulenceIntensity, 0.0, 1.0, "");
    check.within("lengthScale", lengthScale, 0.1, 1e5, "m");
    check.within("gustAmplitude", gustAmplitude, -1.0, 10.0, "");
    check.within("gustStart", gustStart, 0.0, 1e9, "s");
    check.within("gustDuration", gustDuration, 1e-3, 1e6, "s");
    check.within("step", step, 1e-6, 1.0, "s");
    return check.message();
}

}  // namespace awe
