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
    visitConstants(*this, [&check](const char *name, double value, double smallest, double largest, const char *unit) {
        check.within(name, value, smallest, largest, unit);
    });
    check.within("step", step, 1e-6, 1.0, "s");
    return check.message();
}

}  // namespace awe
