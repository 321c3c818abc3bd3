// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "FlightGeometry.h"

namespace awe {

/// Middle loop: leads the wing along a lying figure eight, or to the zenith side of the wind, by
/// its yaw angle.
///
///     path point --> [bearing] -- chi_ref --> [ground guard] --+--------------------> (+) --> [sat 150] --> psi_ref
///         ^                                                    v                       ^
///     [look ahead L] <-- position             course chi --> -(+)--> [0.8, sat 40] ----+
///
///     eight    phi(s) = W / (R cos th0) sin s,  th(s) = th0 - H / R sin 2s,
///              th0 = max(lowest elevation, asin(lowest height / R)) + H / R          upwards at the outer loops
///     carrot   s grows while the point is nearer than L / R,  L = 11 m max(1, v_f / 16)^0.75
///     bearing  chi_ref = atan2((phi(s) - phi) cos el, th(s) - el)
///     guard    |chi_ref| <= 90 deg + d,  d = acos(1 - h omega / (1.3 max(5, v_tan))),  d = -40 deg when h < 0,
///              h = z + min(0, v_z) 0.5 s - 12 m,  omega the yaw speed limit [rad/s]
///              (d is the steepest dive out of which the wing can turn level within the height h)
///     course   e = wrap(chi_ref - chi),  psi_ref = sat(chi_ref + sat(0.8 e max(0, 1 - |e| / 90), 40), 150),
///              gamma_ref = -psi_ref                                       makes up for the sink angle of about 7 deg
///     zenith   gamma_ref = sat(phi [deg] + 7 v_a, 50)
///
/// W, H and L are lengths, so the turn radius of the wing does not depend on the tether length.
class CourseController
{
public:
    explicit CourseController(const AutopilotGains &gains);

    /// Puts the path point back to the middle of the eight.
    void reset();

    /// Follows the figure eight for one cycle.
    /// \param flightSpeed    v_f, slow average of the tangential speed [m/s]
    /// \param yawSpeedLimit  of the orientation controller [deg/s]
    /// \return gamma_ref [deg]
    double figureEight(const FlightGeometry &geometry, double flightSpeed, double yawSpeedLimit);

    /// Flies towards the zenith above the wind direction, or, with the nose down, holds that
    /// direction by banking.
    /// \return gamma_ref [deg]
    double zenith(const FlightGeometry &geometry) const;

    /// The steepest course allowed, from the zenith direction [deg]: 90 is level, more is a dive.
    double steepestCourse(const FlightGeometry &geometry, double yawSpeedLimit) const;

    /// A point of the eight, seen from the ground station.
    struct PathPoint
    {
        double azimuth = 0.0;    // from the wind direction [rad]
        double elevation = 0.0;  // [rad]
    };
    PathPoint pathPoint(double parameter, double distance) const;

    /// s [rad], -pi...pi
    double pathParameter() const { return m_parameter; }

private:
    struct Eight  // the figure at one distance
    {
        double width, height, middle;  // amplitudes and middle elevation [rad]
        PathPoint point(double parameter) const;
    };
    Eight eightAt(double distance) const;
    double bearing(const FlightGeometry &geometry, double flightSpeed);

    AutopilotGains m_gains;
    double m_parameter = 0.0;
};

}  // namespace awe
