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
    check.constants(*this);
    check.within("step", step, 1e-6, 1.0, "s");
    return check.message();
}

}  // namespace awe
