// SPDX-License-Identifier: Apache-2.0
#include "CourseController.h"

#include "AngleMath.h"

#include <cmath>

namespace awe {

namespace {

constexpr double pathStep = 0.01;          // [rad]
constexpr int mostPathSteps = 100;         // in one cycle: the carrot can never run away
constexpr double slowestGuardSpeed = 5.0;  // [m/s]
constexpr double steepClimb = -40.0;       // when there is no height left [deg]

}  // namespace

CourseController::CourseController(const AutopilotGains &gains)
    : m_gains(gains)
{
}

void CourseController::reset()
{
    m_parameter = 0.0;
}

CourseController::Eight CourseController::eightAt(double distance) const
{
    const double height = m_gains.eightHalfHeight / distance;
    const double lowest = std::asin(std::min(1.0, m_gains.lowestHeight / distance));
    const double middle = std::max(m_gains.lowestElevation * radiansPerDegree, lowest) + height;
    return {m_gains.eightHalfWidth / (distance * std::cos(middle)), height, middle};
}

CourseController::PathPoint CourseController::Eight::point(double parameter) const
{
    const double sine = std::sin(parameter), cosine = std::cos(parameter);
    return {width * sine, middle - height * 2.0 * sine * cosine};
}

CourseController::PathPoint CourseController::pathPoint(double parameter, double distance) const
{
    return eightAt(distance).point(parameter);
}

double CourseController::bearing(const FlightGeometry &geometry, double flightSpeed)
{
    const Eight eight = eightAt(geometry.distance);
    const double ratio = std::max(1.0, flightSpeed / m_gains.referenceSpeed);
    const double growth = ratio > 1.0 ? std::pow(ratio, m_gains.lookAheadExponent) : 1.0;
    const double lookAhead = m_gains.lookAhead * growth / geometry.distance;
    double sideways = 0.0, upwards = 0.0;
    for (int i = 0; i <= mostPathSteps; ++i) {
        const PathPoint point = eight.point(m_parameter);
        sideways = (point.azimuth - geometry.azimuth) * geometry.cosElevation;
        upwards = point.elevation - geometry.elevation;
        if (sideways * sideways + upwards * upwards >= lookAhead * lookAhead || i == mostPathSteps)
            break;
        m_parameter = wrapRadians(m_parameter + pathStep);
    }
    return std::atan2(sideways, upwards) * degreesPerRadian;
}

double CourseController::steepestCourse(const FlightGeometry &geometry, double yawSpeedLimit) const
{
    const double room
        = geometry.height + std::min(0.0, geometry.climbSpeed) * m_gains.guardLookAhead - m_gains.guardHeight;
    if (room < 0.0)
        return 90.0 + steepClimb;
    const double speed = std::max(slowestGuardSpeed, geometry.tangentialSpeed);
    const double turns = room * yawSpeedLimit * radiansPerDegree / (m_gains.guardFactor * speed);
    return 90.0 + (turns >= 2.0 ? 180.0 : std::acos(1.0 - turns) * degreesPerRadian);
}

double CourseController::figureEight(const FlightGeometry &geometry, double flightSpeed, double yawSpeedLimit)
{
    const double steepest = std::min(180.0, steepestCourse(geometry, yawSpeedLimit));
    const double course = saturate(bearing(geometry, flightSpeed), steepest);
    const double error = wrapDegrees(course - geometry.course(m_gains.slowestCourseSpeed));
    const double correction = saturate(m_gains.courseGain * error * std::max(0.0, 1.0 - std::abs(error) / 90.0),
                                       m_gains.courseCorrectionLimit);
    return -saturate(course + correction, m_gains.yawReferenceLimit);
}

double CourseController::zenith(const FlightGeometry &geometry) const
{
    return saturate(m_gains.zenithAzimuthGain * geometry.azimuth * degreesPerRadian
                        + m_gains.zenithDamping * geometry.azimuthSpeed,
                    m_gains.zenithYawLimit);
}

}  // namespace awe
