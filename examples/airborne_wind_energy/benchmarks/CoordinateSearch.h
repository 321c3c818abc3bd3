// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace awe {

/// A number that a CoordinateSearch may change.
struct Coordinate
{
    double smallest, largest;
    double step;  // first change that is tried, > 0
};

/// Climbs a function of many numbers that has no derivative: the compass search.
///
/// A round tries each coordinate in turn: one step up, and if the value is not greater there, one
/// step down. After a round without a gain all steps are halved. Nothing is random: the same
/// function gives the same result.
class CoordinateSearch
{
public:
    using Point = std::vector<double>;
    /// Its value; what may not be is -infinity.
    using Function = std::function<double(const Point &)>;

    /// \param leastGain  smaller gains are not worth a move, >= 0
    CoordinateSearch(Function function, std::vector<Coordinate> coordinates, double leastGain = 0.0);

    /// \param start as many numbers as there are coordinates; its value may be -infinity \param
    ///         halvings rounds without a
    /// gain after which it ends, > 0
    /// \return the best point that was seen; \a start when none was better
    Point climb(const Point &start, int halvings);

    /// Of the point that climb() has returned.
    double value() const { return m_value; }
    /// Values computed so far.
    int evaluations() const { return m_evaluations; }

private:
    bool tryRound(double scale);
    bool tryMove(std::size_t coordinate, double change);
    double evaluate(const Point &point);

    Function m_function;
    std::vector<Coordinate> m_coordinates;
    double m_leastGain;
    Point m_best;
    double m_value = 0.0;
    int m_evaluations = 0;
};

}  // namespace awe
