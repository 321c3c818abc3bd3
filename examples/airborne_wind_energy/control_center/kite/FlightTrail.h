// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QPlcPanelContext.h>

#include <QtGui/QVector3D>

#include <vector>

namespace awe {

/// The way of a point through space in a span of time, with few points, whatever the number of
/// cycles.
///
/// A time without a position interrupts it: no number, or a value that stands in for that of the
/// writer.
class FlightTrail
{
public:
    using Samples = QVector<QPlcPanelContext::Sample>;
    struct Point
    {
        QVector3D position;
        float value;    // of the signal that colours; NaN without one
        bool isJoined;  // a line leads here from the point before
    };
    struct Range
    {
        double minimum;
        double maximum;
        bool isEmpty() const { return !(minimum <= maximum); }
    };

    static constexpr int mostPoints = 1200;

    /// \param x, y, z, value the past of the coordinates and of what colours, of the same span of
    /// time and the same plant
    void read(const Samples &x, const Samples &y, const Samples &z, const Samples &value);
    void clear() { m_points.clear(); }
    const std::vector<Point> &points() const { return m_points; }
    /// Of the values of the points; empty without any.
    Range valueRange() const;

private:
    std::vector<Point> m_points;
};

}  // namespace awe
