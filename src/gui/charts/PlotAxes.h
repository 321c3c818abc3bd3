// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlotSettings.h"

namespace qplc {

/// The y axes of a time plot: one for each unit, at the left or at the right. A value type.
///
/// The first curve whose side is not chosen is at the left, with all others of its unit. Those of
/// another unit are at the right, where each unit has an axis of its own. A person may choose the
/// side of a curve. Axes 0 and 1 are always there: the first one at the left and the first one at
/// the right. The others follow in the order of the curves that need them.
class PlotAxes
{
public:
    using Side = PlotCurveSettings::Axis;
    struct Axis
    {
        Side side;
        QString unit;
        bool isUsed = false;
        friend bool operator==(const Axis &a, const Axis &b) { return a.side == b.side && a.unit == b.unit; }
    };

    PlotAxes();
    /// The axis of one more curve. Curves without unit share one; the unit 1 counts as no unit.
    /// \param side that a person has chosen
    int add(std::optional<Side> side, const QString &unitOfTable);
    int count() const { return m_axes.size(); }
    const Axis &at(int axis) const { return m_axes[axis]; }

private:
    int axisOf(Side side, const QString &unit) const;

    QVector<Axis> m_axes;
};

}  // namespace qplc
