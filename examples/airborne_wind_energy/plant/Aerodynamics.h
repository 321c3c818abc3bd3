// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ClampedCubicSpline.h"

#include <Eigen/Core>

namespace awe {

/// How the angle of attack is told from the relative wind.
enum class AngleOfAttackRange {
    Folded,  ///< asin of the component along the top side, -90...90 deg: the reference model; backward flow folds
    Full     ///< atan2, -180...180 deg: flow from behind gets the coefficients of its own
};

/// Drag, lift and AWE coefficient over the angle of attack, and the aerodynamic force of the wing.
///
/// Drag and lift coefficient are clamped cubic splines through these anchors (thesis, figure 4.4):
///
///     alpha [deg]  -180   -90     0    90   180           -180  -140   -60     0    25   140   180
///     c_d           0.5     1   0.1     1   0.5     c_l      0   0.6  -0.1   0.2     1  -0.6     0
///
///     c_AWE = (c_d^2 + c_l^2)^(3/2) / c_d^2                (thesis, equation 4.7; largest value 17.5427 at 21.977 deg)
///     F_ae  = 1/2 rho A |v_r|^2 (c_d dir(v_r) + c_l dir(v_r x y_b))                          (thesis, equation 4.4)
///
/// The drag factor multiplies the drag coefficient after c_AWE was computed, so c_AWE always
/// belongs to the plain wing.
class Aerodynamics
{
public:
    struct Coefficients
    {
        double drag = 0.0;  // c_d, drag factor included
        double lift = 0.0;  // c_l
        double awe = 0.0;   // c_AWE of the plain wing
    };

    struct Airflow
    {
        double angleOfAttack = 0.0;                       // alpha [deg]
        double drag = 0.0;                                // c_d, drag factor included
        double lift = 0.0;                                // c_l
        Eigen::Vector3d force = Eigen::Vector3d::Zero();  // F_ae [N], same frame as the arguments
    };

    /// c_d = c_d(alpha) dragFactor factor + coefficient
    struct MoreDrag
    {
        double factor = 1.0;       // of a wing that steers [-]
        double coefficient = 0.0;  // of lines [-]
    };

    /// \param dragFactor multiplies c_d, > 0; 0.2 makes the wing about five times faster at the
    ///         same angle of attack
    explicit Aerodynamics(double dragFactor = 1.0, AngleOfAttackRange range = AngleOfAttackRange::Folded);

    /// \param angleOfAttack  alpha [deg], -180...180; the end values hold outside
    Coefficients coefficients(double angleOfAttack) const;

    double dragCoefficient(double angleOfAttack) const { return m_dragFactor * m_drag.value(angleOfAttack); }
    double liftCoefficient(double angleOfAttack) const { return m_lift.value(angleOfAttack); }

    /// Angle of attack and force of a wing in the relative wind; no wind gives no force.
    /// All vectors are in one right-handed frame, for instance the earth's (x east, y north, z up).
    /// \param relativeWind   v_r = wind - velocity of the wing [m/s]
    /// \param tailwards      x_b, unit vector towards the tail (the nose is -x_b)
    /// \param sideways       y_b, unit vector along the span, y_b = z_b x x_b
    /// \param topwards       z_b, unit vector out of the top side, away from the ground station
    /// \param dynamicArea    1/2 rho A [kg/m]
    /// \param moreDrag       what else brakes than the plain wing
    Airflow airflow(const Eigen::Vector3d &relativeWind, const Eigen::Vector3d &tailwards,
                    const Eigen::Vector3d &sideways, const Eigen::Vector3d &topwards, double dynamicArea,
                    const MoreDrag &moreDrag = {1.0, 0.0}) const;

    /// Largest c_AWE of a wing for -90...90 deg and where it is, drag factor included.
    struct BestAngle
    {
        double angleOfAttack = 0.0;   // [deg]
        double aweCoefficient = 0.0;  // [-]
    };
    static BestAngle bestAngleOfAttack(double dragFactor = 1.0);

    double dragFactor() const { return m_dragFactor; }
    AngleOfAttackRange range() const { return m_range; }
    const ClampedCubicSpline<5> &dragSpline() const { return m_drag; }
    const ClampedCubicSpline<7> &liftSpline() const { return m_lift; }

private:
    double angleOfAttack(const Eigen::Vector3d &relativeWind, const Eigen::Vector3d &tailwards,
                         const Eigen::Vector3d &topwards, double speed) const;

    double m_dragFactor;
    AngleOfAttackRange m_range;
    ClampedCubicSpline<5> m_drag;
    ClampedCubicSpline<7> m_lift;
};

}  // namespace awe
