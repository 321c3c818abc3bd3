// SPDX-License-Identifier: Apache-2.0
#include "Wind.h"

#include <Eigen/Geometry>

#include <cmath>

namespace awe {

namespace {

constexpr double fullTurn = 6.2831853071795864769;

// Columns: along the mean wind, across it (level), upwards. A vertical mean wind has no "across": x
// stands for it.
Eigen::Matrix3d windFrame(const Eigen::Vector3d &meanVelocity)
{
    const Eigen::Vector3d along = meanVelocity.normalized();
    const Eigen::Vector3d level(-along.y(), along.x(), 0.0);
    const Eigen::Vector3d across = level.norm() > 0.0 ? level.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitX());
    Eigen::Matrix3d frame;
    frame << along, across, along.cross(across);
    return frame;
}

}  // namespace

Wind::Wind(const WindParameters &parameters)
    : m_parameters(parameters)
    , m_gaussian(parameters.seed)
{
    const double speed = parameters.meanVelocity.norm();
    m_memory = std::exp(-parameters.step * speed / parameters.lengthScale);
    m_isTurbulent = parameters.turbulenceIntensity > 0.0 && speed > 0.0;
    const double excitation = parameters.turbulenceIntensity * speed * std::sqrt(1.0 - m_memory * m_memory);
    m_frame = windFrame(parameters.meanVelocity);
    m_excitation = m_frame * (excitation * parameters.turbulenceRatio).asDiagonal();
    m_isKaimal = m_isTurbulent && parameters.turbulenceModel == TurbulenceModel::Kaimal;
    reset();
}

void Wind::reset()
{
    m_gaussian.reset(m_parameters.seed);
    m_steps = 0;
    m_turbulence.setZero();
    if (m_isKaimal) {
        const double speed = m_parameters.meanVelocity.norm();
        m_kaimal = KaimalTurbulence(speed, m_parameters.turbulenceIntensity * speed * m_parameters.turbulenceRatio,
                                    m_parameters.lengthScale, m_parameters.step, m_parameters.seed);
        moveKaimal();
    }
    composeVelocity();
}

void Wind::composeVelocity()
{
    m_turbulenceNow = m_turbulence;
    m_velocity = m_parameters.meanVelocity * gustFactor() + m_turbulence;
    if (m_parameters.dayShare == 1.0)
        return;
    const double rising = 0.5 * (1.0 - std::cos(fullTurn * time() / m_parameters.dayDuration));
    const double factor = m_parameters.dayShare + (1.0 - m_parameters.dayShare) * rising;
    m_turbulenceNow *= factor;
    m_velocity *= factor;
}

double Wind::gustFactor() const
{
    const double sinceStart = time() - m_parameters.gustStart;
    if (m_parameters.gustAmplitude == 0.0 || sinceStart <= 0.0 || sinceStart >= m_parameters.gustDuration)
        return 1.0;
    return 1.0 + 0.5 * m_parameters.gustAmplitude * (1.0 - std::cos(fullTurn * sinceStart / m_parameters.gustDuration));
}

void Wind::moveKaimal()
{
    const Eigen::Vector3d value = m_kaimal.step();
    m_turbulence = m_frame.col(0) * value[0] + m_frame.col(1) * value[1] + m_frame.col(2) * value[2];
}

void Wind::step()
{
    ++m_steps;
    if (m_isKaimal) {
        moveKaimal();
    } else if (m_isTurbulent) {
        const double along = m_gaussian.next(), across = m_gaussian.next(), upwards = m_gaussian.next();
        // Column by column: Eigen's product of a matrix and a vector fuses multiplication and
        // addition where a processor can, and rounds once less there.
        const Eigen::Vector3d excitation
            = m_excitation.col(0) * along + m_excitation.col(1) * across + m_excitation.col(2) * upwards;
        m_turbulence = m_memory * m_turbulence + excitation;
    }
    composeVelocity();
}

}  // namespace awe
