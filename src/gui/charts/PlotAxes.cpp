// SPDX-License-Identifier: Apache-2.0
#include "PlotAxes.h"

namespace qplc {

PlotAxes::PlotAxes()
    : m_axes{{PlotCurveSettings::Left, {}}, {PlotCurveSettings::Right, {}}}
{
}

/// The one that has the unit; else the first one of the side while it is free; -1: a new one is
/// needed.
int PlotAxes::axisOf(Side side, const QString &unit) const
{
    for (int axis = 0; axis < m_axes.size(); ++axis) {
        if (m_axes[axis].isUsed && m_axes[axis].side == side && m_axes[axis].unit == unit)
            return axis;
    }
    const int first = side == PlotCurveSettings::Left ? 0 : 1;
    return m_axes[first].isUsed ? -1 : first;
}

int PlotAxes::add(std::optional<Side> side, const QString &unitOfTable)
{
    const QString unit = unitOfTable == QLatin1String("1") ? QString() : unitOfTable;
    const bool isAnotherUnit = m_axes[0].isUsed && m_axes[0].unit != unit;
    const Side chosen = side.value_or(isAnotherUnit ? PlotCurveSettings::Right : PlotCurveSettings::Left);
    int axis = axisOf(chosen, unit);
    if (axis < 0) {
        axis = m_axes.size();
        m_axes.append({chosen, unit});
    }
    m_axes[axis].unit = unit;
    m_axes[axis].isUsed = true;
    return axis;
}

}  // namespace qplc
