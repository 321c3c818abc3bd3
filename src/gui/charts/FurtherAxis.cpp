// SPDX-License-Identifier: Apache-2.0
#include "FurtherAxis.h"

#include <cmath>

namespace qplc {

FurtherAxis::FurtherAxis(PlotCurveSettings::Axis side, QWidget *plot)
    : QwtScaleWidget(side == PlotCurveSettings::Left ? QwtScaleDraw::LeftScale : QwtScaleDraw::RightScale, plot)
    , m_side(side)
{
    setMargin(0);
    setSpacing(1);
    setCursor(Qt::SizeVerCursor);
}

int FurtherAxis::widthFor(int height) const
{
    return dimForLength(height, font());
}

void FurtherAxis::place(int x, double top, double bottom)
{
    int above = 0;
    int below = 0;
    getBorderDistHint(above, below);
    setBorderDist(above, below);
    const int length = int(std::lround(bottom - top));
    setGeometry(x, int(std::lround(top)) - above, widthFor(length), length + above + below);
}

}  // namespace qplc
