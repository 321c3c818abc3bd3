// SPDX-License-Identifier: Apache-2.0
#include "Aerodynamics.h"

#include "AngleMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

double aweCoefficient(double drag, double lift)
{
    const double resultant = std::sqrt(drag * drag + lift * lift);
    return resultant * resultant * resultant / (drag * drag);
}

}  // namespace

Aerodynamics::Aerodynamics(double dragFactor, AngleOfAttackRange range)
    : m_dragFactor(dragFactor)
    , m_range(range)
    , m_drag({-180.0, -90.0, 0.0, 90.0, 180.0}, {0.5, 1.0, 0.1, 1.0, 0.5})
    , m_lift({-180.0, -140.0, -60.0, 0.0, 25.0, 140.0, 180.0}, {0.0, 0.6, -0.1, 0.2, 1.0, -0.6, 0.0})
{
}

Aerodynamics::Coefficients Aerodynamics::coefficients(double angleOfAttack) const
{
    const double plainDrag = m_drag.value(angleOfAttack);
    const double lift = m_lift.value(angleOfAttack);
    return {m_dragFactor * plainDrag, lift, aweCoefficient(plainDrag, lift)};
}

double Aerodynamics::angleOfAttack(const Eigen::Vector3d &relativeWind, const Eigen::Vector3d &tailwards,
                                   const Eigen::Vector3d &topwards, double speed) const
{
    const double upwards = relativeWind.dot(topwards);
    if (m_range == AngleOfAttackRange::Full)
        return std::atan2(upwards, relativeWind.dot(tailwards)) * degreesPerRadian;
    return std::asin(std::clamp(upwards / speed, -1.0, 1.0)) * degreesPerRadian;  // rounding may leave [-1, 1]
}

Aerodynamics::Airflow Aerodynamics::airflow(const Eigen::Vector3d &relativeWind, const Eigen::Vector3d &tailwards,
                                            const Eigen::Vector3d &sideways, const Eigen::Vector3d &topwards,
                                            double dynamicArea, const MoreDrag &moreDrag) const
{
    Airflow flow;
    const double speed = relativeWind.norm();
    if (speed > 0.0)
        flow.angleOfAttack = angleOfAttack(relativeWind, tailwards, topwards, speed);
    flow.drag = dragCoefficient(flow.angleOfAttack) * moreDrag.factor + moreDrag.coefficient;
    flow.lift = liftCoefficient(flow.angleOfAttack);
    flow.force = dynamicArea * speed * flow.drag * relativeWind;
    const Eigen::Vector3d liftDirection = relativeWind.cross(sideways);
    const double length = liftDirection.norm();
    if (length > 0.0)
        flow.force += dynamicArea * speed * speed * flow.lift / length * liftDirection;
    return flow;
}

Aerodynamics::BestAngle Aerodynamics::bestAngleOfAttack(double dragFactor)
{
    const Aerodynamics wing(dragFactor);
    const auto quality
        = [&wing](double angle) { return aweCoefficient(wing.dragCoefficient(angle), wing.liftCoefficient(angle)); };
    double best = -90.0;
    for (double angle = -89.0; angle <= 90.0; angle += 1.0) {
        if (quality(angle) > quality(best))
            best = angle;
    }
    double low = best - 1.0, high = best + 1.0;  // one maximum lies between: shrink by thirds
    while (high - low > 1e-7) {
        const double third = (high - low) / 3.0;
        if (quality(low + third) < quality(high - third))
            low += third;
        else
            high -= third;
    }
    return {0.5 * (low + high), quality(0.5 * (low + high))};
}

}  // namespace awe
