// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace qplc {

/// A test signal over time.
struct Waveform
{
    enum Shape {
        Step,  // offset + amplitude for the first half of each period, then offset
        Ramp,  // from offset to offset + amplitude within each period, and back at once
        Sine   // amplitude about offset, rising from it
    };

    Shape shape = Sine;
    double amplitude = 1.0;
    double offset = 0.0;
    double period = 10.0;  // [s], > 0

    /// \param time  since the start, >= 0 [s]
    double value(double time) const
    {
        constexpr double fullTurn = 6.283185307179586;
        const double phase = time / period - std::floor(time / period);  // 0 ... 1
        switch (shape) {
        case Step:
            return phase < 0.5 ? offset + amplitude : offset;
        case Ramp:
            return offset + amplitude * phase;
        case Sine:
            break;
        }
        return offset + amplitude * std::sin(fullTurn * phase);
    }
};

}  // namespace qplc
