// SPDX-License-Identifier: Apache-2.0
#include "CoordinateSearch.h"

#include <algorithm>
#include <utility>

namespace awe {

CoordinateSearch::CoordinateSearch(Function function, std::vector<Coordinate> coordinates, double leastGain)
    : m_function(std::move(function))
    , m_coordinates(std::move(coordinates))
    , m_leastGain(leastGain)
{
}

CoordinateSearch::Point CoordinateSearch::climb(const Point &start, int halvings)
{
    m_best = start;
    m_value = evaluate(start);
    double scale = 1.0;
    for (int fruitless = 0; fruitless < halvings;) {
        if (tryRound(scale))
            continue;
        scale /= 2.0;
        ++fruitless;
    }
    return m_best;
}

bool CoordinateSearch::tryRound(double scale)
{
    bool hasGained = false;
    for (std::size_t i = 0; i < m_coordinates.size(); ++i) {
        const double step = m_coordinates[i].step * scale;
        hasGained |= tryMove(i, step) || tryMove(i, -step);
    }
    return hasGained;
}

bool CoordinateSearch::tryMove(std::size_t coordinate, double change)
{
    const Coordinate &range = m_coordinates[coordinate];
    Point moved = m_best;
    moved[coordinate] = std::clamp(moved[coordinate] + change, range.smallest, range.largest);
    if (moved[coordinate] == m_best[coordinate])
        return false;
    const double value = evaluate(moved);
    if (!(value > m_value + m_leastGain))
        return false;
    m_best = std::move(moved);
    m_value = value;
    return true;
}

double CoordinateSearch::evaluate(const Point &point)
{
    ++m_evaluations;
    return m_function(point);
}

}  // namespace awe
