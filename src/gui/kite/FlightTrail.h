// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <QtGui/QVector3D>

#include <vector>

namespace qplc {

/// The way of a point through space in a span of time, with few points, whatever the number of rows.
///
/// A row without a position interrupts it: NaN, and a value that stands in for that of the writer.
/// Points are rows whose number is a multiple of a power of two, so that the path does not shimmer while time goes on, and the newest row.
class FlightTrail
{
public:
    struct Point
    {
        QVector3D position;
        float value;    // of the signal that colours; NaN without one
        bool isJoined;  // a line leads here from the point before
    };

    static constexpr int mostPoints = 1200;

    /// \param firstChannel  of three, one behind the other
    /// \param valueChannel  -1: none
    /// \param begin, end  [ns]; rows of begin <= time <= end
    void read(const SignalStore &store, int firstChannel, int valueChannel, SignalStore::Time begin,
              SignalStore::Time end);
    void clear() { m_points.clear(); }
    const std::vector<Point> &points() const { return m_points; }
    /// Of the values of the points; empty without any.
    SignalStore::Range valueRange() const;

private:
    std::vector<Point> m_points;
};

}  // namespace qplc
