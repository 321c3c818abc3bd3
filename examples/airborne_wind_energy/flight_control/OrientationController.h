// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "FlightMeasurements.h"

#include <limits>

namespace awe {

/// What the pitch is to do.
struct PitchReference
{
    enum class Kind {
        PitchAngle,    ///< hold beta_c
        AngleOfAttack  ///< hold alpha by turning beta_c by what is missing
    };
    Kind kind = Kind::PitchAngle;
    double angle = 0.0;                                          // [deg]
    double fastestUp = std::numeric_limits<double>::infinity();  // upper limit of pitchSpeed [deg/s], may be negative
};

/// Innermost loop: turns the wing to a yaw angle and a pitch angle.
///
///     gamma_ref --> [sat +-150] --> (+) --> [6] --> [sat yawLimit] --> yawSpeed
///                                   ^ -
///                                 gamma_c, wrapped to +-180; the difference is NOT wrapped
///
///     beta_ref ---> (+) --> [4] --> [sat +-60] --> pitchSpeed
///                   ^ -
///                  beta_c
///
///     yawSpeed   = sat(k_yaw (sat(gamma_ref, 150) - wrap(gamma_c)), yawLimit)
///     yawLimit   = min(180, 90 max(1, v_f / 16))                         faster flight, faster turns
///     pitchSpeed = sat(k_pitch (beta_ref - beta_c), 60)
///                  and at most PitchReference::fastestUp, which the force limit sets
///     beta_ref   = given, or sat(beta_c + alpha_ref - alpha, -110, beta_out) to hold an angle of attack
///
/// Because the yaw difference is not wrapped, the nose always turns through the zenith side and
/// never through the ground side, even where that way is shorter: a wing that turns through the
/// nadir in a lull does not come back.
class OrientationController
{
public:
    explicit OrientationController(const AutopilotGains &gains);

    /// \param flightSpeed  v_f, slow average of the tangential speed [m/s]
    /// \return [deg/s]
    double yawSpeedLimit(double flightSpeed) const;

    /// \param yawReference  gamma_ref [deg]
    /// \return [deg/s]
    double yawSpeed(double yawReference, double yawAngle, double flightSpeed) const;

    /// \return [deg/s]
    double pitchSpeed(const PitchReference &reference, const FlightMeasurements &measurements) const;

private:
    AutopilotGains m_gains;
};

}  // namespace awe
