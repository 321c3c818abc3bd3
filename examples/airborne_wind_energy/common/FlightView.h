// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "FlightPhase.h"
#include "TerminalCanvas.h"

#include <Eigen/Core>

#include <QtCore/QStringList>

#include <deque>

namespace awe {

/// What is shown of one moment of a flight.
struct FlightMoment
{
    double time = 0.0;                                       // simulated, since the start [s]
    FlightPhase phase = FlightPhase::Launch;                 //
    Eigen::Vector3d position = Eigen::Vector3d::Zero();      // x east, y north, z up [m]
    Eigen::Vector3d windVelocity = Eigen::Vector3d::Zero();  // [m/s]
    double tetherLength = 0.0;                               // [m]
    double tetherForce = 0.0;                                // [N]
    double power = 0.0;                                      // [W]
    double energy = 0.0;                                     // [J]
    bool crashed = false;
};

/// One line that says where the flight stands. \param duration  planned [s], 0: open end
QString progressLine(const FlightMoment &moment, double duration);

/// The flight as a picture of characters and Braille dots: the wind window as seen from the winch,
/// azimuth across and elevation up, with the kite and the trail behind it, then a plot of the
/// power, and the figures below. Knows no terminal: it makes lines, with ANSI colours if they are
/// wanted.
class FlightView
{
public:
    static constexpr double trailDuration = 20.0;  // [s]
    static constexpr double plotDuration = 60.0;   // [s]

    /// \param duration  planned [s], 0: open end
    explicit FlightView(double duration, bool hasColours = true)
        : m_duration(duration)
        , m_hasColours(hasColours)
    {
    }

    /// The newest moment. A time before the last one is another flight: the trail begins anew.
    void add(const FlightMoment &moment);

    /// \return at most \a rows lines of at most \a columns characters, colour codes not counted
    QStringList draw(int columns, int rows) const;

private:
    struct TrailPoint
    {
        double time;       // [s]
        double azimuth;    // from downwind, > 0 to the left of who looks downwind [deg]
        double elevation;  // [deg]
    };
    struct PowerPoint
    {
        double time;   // [s]
        double power;  // [W]
    };

    void drawTitle(TerminalCanvas &canvas) const;
    void drawWindow(TerminalCanvas &canvas, int top, int height) const;
    void drawTrail(TerminalCanvas &canvas, int top, int height) const;
    void drawPlot(TerminalCanvas &canvas, int top, int height) const;
    void drawFigures(TerminalCanvas &canvas, int top) const;

    double m_duration;
    bool m_hasColours;
    FlightMoment m_moment;
    double m_windDirection = 0.0;  // slowly following, from east to north [rad]
    std::deque<TrailPoint> m_trail;
    std::deque<PowerPoint> m_powers;
};

}  // namespace awe
