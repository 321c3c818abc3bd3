// SPDX-License-Identifier: Apache-2.0
#include "PathShape.h"

#include <algorithm>
#include <cmath>

namespace qplc {

void PathShape::clear()
{
    m_pieces.clear();
    m_isOpen = false;
    m_hasWay = false;
    m_hasPending = false;
}

void PathShape::keep(QPointF point)
{
    m_pieces.back().push_back(point);
    m_anchor = point;
    m_hasPending = false;
    m_hasWay = false;
}

void PathShape::add(QPointF point)
{
    if (!m_isOpen) {
        m_pieces.emplace_back();
        m_isOpen = true;
        keep(point);
        return;
    }
    double direction = 0.0;
    double distance = 0.0;
    if (m_hasPending && !isOnTheWay(point, &direction, &distance))
        keep(m_pending);
    const QPointF way = point - m_anchor;
    distance = std::hypot(way.x(), way.y());
    if (!m_hasWay && distance > tolerance) {
        m_reference = std::atan2(way.y(), way.x());
        m_high = std::asin(tolerance / distance);
        m_low = -m_high;
        m_farthest = distance;
        m_hasWay = true;
    } else if (m_hasWay && distance > tolerance) {
        const double width = std::asin(tolerance / distance);
        m_low = std::max(m_low, direction - width);
        m_high = std::min(m_high, direction + width);
        m_farthest = std::max(m_farthest, distance);
    }
    m_pending = point;
    m_hasPending = true;
}

/// Whether the line from the anchor to a point leads by all points since the anchor. \param
/// direction [rad] from the reference
bool PathShape::isOnTheWay(QPointF point, double *direction, double *distance) const
{
    const QPointF way = point - m_anchor;
    *distance = std::hypot(way.x(), way.y());
    if (!m_hasWay)
        return true;
    if (*distance < m_farthest - tolerance)
        return false;
    *direction = std::remainder(std::atan2(way.y(), way.x()) - m_reference, 2.0 * M_PI);
    return *direction >= m_low && *direction <= m_high;
}

void PathShape::interrupt()
{
    if (m_isOpen && m_hasPending)
        keep(m_pending);
    m_isOpen = false;
    m_hasWay = false;
    m_hasPending = false;
}

const std::vector<std::vector<QPointF>> &PathShape::finish()
{
    interrupt();
    return m_pieces;
}

std::size_t PathShape::pointCount() const
{
    std::size_t count = 0;
    for (const std::vector<QPointF> &piece : m_pieces)
        count += piece.size();
    return count;
}

}  // namespace qplc
