// SPDX-License-Identifier: Apache-2.0
#include "OrientationController.h"

#include "AngleMath.h"

namespace awe {

OrientationController::OrientationController(const AutopilotGains &gains)
    : m_gains(gains)
{
}

double OrientationController::yawSpeedLimit(double flightSpeed) const
{
    return std::min(m_gains.largestYawSpeed,
                    m_gains.slowYawSpeed * std::max(1.0, flightSpeed / m_gains.referenceSpeed));
}

double OrientationController::yawSpeed(double yawReference, double yawAngle, double flightSpeed) const
{
    const double difference = saturate(yawReference, m_gains.yawReferenceLimit) - wrapDegrees(yawAngle);
    return saturate(m_gains.yawGain * difference, yawSpeedLimit(flightSpeed));
}

double OrientationController::pitchSpeed(const PitchReference &reference, const FlightMeasurements &measurements) const
{
    double pitch = reference.angle;
    if (reference.kind == PitchReference::Kind::AngleOfAttack)
        pitch = std::clamp(measurements.pitchAngle + reference.angle - measurements.angleOfAttack, m_gains.lowestPitch,
                           m_gains.reelOutPitch);
    const double speed = std::min(m_gains.pitchGain * (pitch - measurements.pitchAngle), reference.fastestUp);
    return saturate(speed, m_gains.largestPitchSpeed);
}

}  // namespace awe
