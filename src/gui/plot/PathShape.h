// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointF>

#include <vector>

namespace qplc {

/// A path as few points that look the same: points that lie on the way from one kept point to the
/// next are left out.
///
/// What is left out is at most `tolerance` pixels beside the line that is drawn, and at most as
/// much beyond its ends: ways there and back, spikes, loops and gaps stay. So there are as many
/// points as the path has bends in the picture, whatever the number of rows. It is the search of a
/// common direction of all points since the last kept one (a "cone" or "sleeve"), in one pass.
class PathShape
{
public:
    static constexpr double tolerance = 0.2;  // [px]: bends of smooth lines cannot be seen

    /// Begins anew; nothing is kept.
    void clear();
    /// \param point  [px]
    void add(QPointF point);
    /// No line leads to the next point.
    void interrupt();
    /// Ends the path. \return pieces of points, each piece a line; a piece of one point is a dot
    const std::vector<std::vector<QPointF>> &finish();
    /// Of all pieces.
    std::size_t pointCount() const;

private:
    void keep(QPointF point);
    bool isOnTheWay(QPointF point, double *direction, double *distance) const;

    std::vector<std::vector<QPointF>> m_pieces;
    bool m_isOpen = false;  // there is an anchor
    bool m_hasWay = false;  // and a direction
    QPointF m_anchor;       // the last point that was kept
    QPointF m_pending;      // the last point on the way
    bool m_hasPending = false;
    double m_reference = 0.0;  // directions are counted from this one [rad]
    double m_low = 0.0;        // the directions that meet all points of the way
    double m_high = 0.0;
    double m_farthest = 0.0;  // from the anchor [px]
};

}  // namespace qplc
