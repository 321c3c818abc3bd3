// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtGui/QColor>

namespace awe {

/// Values as colours, from violet over green to orange: all as bright as each other, so that they
/// are seen on white and on black. A value type.
struct ColorScale
{
    double minimum = 0.0;
    double maximum = 1.0;

    /// Values outside take the colour of the end; NaN is grey, and an empty scale has its middle
    /// only.
    QColor color(double value) const;
    /// The smallest scale with round ends about all of it. \param minimum, maximum of what is
    /// shown; an empty range is taken as 0 ... 1
    static ColorScale around(double minimum, double maximum);
};

}  // namespace awe
