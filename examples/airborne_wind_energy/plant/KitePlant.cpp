// SPDX-License-Identifier: Apache-2.0
#include "KitePlant.h"

#include <algorithm>
#include <cmath>

namespace awe {

KitePlant::KitePlant(const PlantParameters &parameters)
    : m_parameters(parameters)
    , m_aerodynamics(parameters.dragFactor, parameters.angleOfAttackRange)
{
    reset();
}

void KitePlant::reset()
{
    m_state = m_parameters.initialState;
    m_attitude = Attitude::of(m_state.pitchAngle, m_state.yawAngle);
    m_crashed = false;
    noticeGround();
}

double KitePlant::tetherTension(const PlantState &state, double distance, double tetherSpeed) const
{
    const double stretch = distance - state.tetherLength;
    if (!(stretch > 0.0))
        return 0.0;
    const double tension = m_parameters.tetherStiffness * stretch;
    if (m_parameters.tetherDamping == 0.0)
        return tension;
    const double stretchSpeed = state.velocity.dot(state.position) / distance - tetherSpeed;
    return std::max(0.0, tension + m_parameters.tetherDamping * stretchSpeed);
}

KitePlant::Forces KitePlant::forces(const PlantState &state, const Attitude &attitude, const PlantInputs &inputs) const
{
    const Sphere sphere(state.position);
    const WingFrame wing(sphere, attitude);
    Forces forces;
    const Eigen::Vector3d relativeWind = inputs.windVelocity - state.velocity;
    const double dynamicArea = 0.5 * m_parameters.airDensity * m_parameters.area;
    forces.air = m_aerodynamics.airflow(relativeWind, wing.tailwards, wing.sideways, wing.topwards, dynamicArea);
    forces.tetherTension = tetherTension(state, sphere.distance, inputs.tetherSpeed);
    forces.tether = -forces.tetherTension * wing.outwards;
    return forces;
}

KitePlant::Rates KitePlant::rates(const PlantState &state, const Attitude &attitude, const PlantInputs &inputs) const
{
    const Forces acting = forces(state, attitude, inputs);
    Rates rates;
    rates.velocity = state.velocity;
    rates.acceleration = (acting.air.force + acting.tether) / m_parameters.mass;
    rates.acceleration.z() -= m_parameters.gravity;
    rates.power = inputs.tetherSpeed * acting.tetherTension;
    rates.averagePower = (rates.power - state.averagePower) / m_parameters.averagePowerTime;
    return rates;
}

PlantState KitePlant::moved(const Rates &rates, double time, const PlantInputs &inputs) const
{
    PlantState state;
    state.position = m_state.position + time * rates.velocity;
    state.velocity = m_state.velocity + time * rates.acceleration;
    state.pitchAngle = m_state.pitchAngle + time * inputs.pitchSpeed;
    state.yawAngle = m_state.yawAngle + time * inputs.yawSpeed;
    state.tetherLength = m_state.tetherLength + time * inputs.tetherSpeed;
    state.averagePower = m_state.averagePower + time * rates.averagePower;
    state.energy = m_state.energy + time * rates.power;
    return state;
}

void KitePlant::step(const PlantInputs &inputs)
{
    if (isHeld())
        return;
    const double h = m_parameters.step;
    const Attitude middle
        = Attitude::of(m_state.pitchAngle + 0.5 * h * inputs.pitchSpeed, m_state.yawAngle + 0.5 * h * inputs.yawSpeed);
    const Attitude end
        = Attitude::of(m_state.pitchAngle + h * inputs.pitchSpeed, m_state.yawAngle + h * inputs.yawSpeed);

    const Rates k1 = rates(m_state, m_attitude, inputs);
    const Rates k2 = rates(moved(k1, 0.5 * h, inputs), middle, inputs);
    const Rates k3 = rates(moved(k2, 0.5 * h, inputs), middle, inputs);
    const Rates k4 = rates(moved(k3, h, inputs), end, inputs);

    Rates mean;
    mean.velocity = (k1.velocity + 2.0 * (k2.velocity + k3.velocity) + k4.velocity) / 6.0;
    mean.acceleration = (k1.acceleration + 2.0 * (k2.acceleration + k3.acceleration) + k4.acceleration) / 6.0;
    mean.averagePower = (k1.averagePower + 2.0 * (k2.averagePower + k3.averagePower) + k4.averagePower) / 6.0;
    mean.power = (k1.power + 2.0 * (k2.power + k3.power) + k4.power) / 6.0;
    m_state = moved(mean, h, inputs);
    m_attitude = end;
    noticeGround();
}

void KitePlant::noticeGround()
{
    if (m_crashed || !(m_state.position.z() <= 0.0))  // a position that is not a number is no ground contact
        return;
    m_crashed = true;
    if (m_parameters.groundContact == GroundContact::Hold)
        m_state.velocity.setZero();
}

PlantOutputs KitePlant::outputs(const PlantInputs &inputs) const
{
    const Sphere sphere(m_state.position);
    const Forces acting = forces(m_state, m_attitude, inputs);
    PlantOutputs y;
    y.inputs = inputs;
    y.position = m_state.position;
    y.velocity = m_state.velocity;
    y.bodyControlOrientation = {0.0, m_state.pitchAngle, m_state.yawAngle};
    y.bodyPositionOrientation = {0.0, 90.0 - std::atan2(m_state.position.z(), sphere.horizontal) / radiansPerDegree,
                                 std::atan2(m_state.position.y(), m_state.position.x()) / radiansPerDegree};
    const Aerodynamics::Coefficients coefficients = m_aerodynamics.coefficients(acting.air.angleOfAttack);
    y.angleOfAttack = acting.air.angleOfAttack;
    y.dragCoefficient = coefficients.drag;
    y.liftCoefficient = coefficients.lift;
    y.aweCoefficient = coefficients.awe;
    y.gravitationalForce = {0.0, 0.0, -m_parameters.mass * m_parameters.gravity};
    if (!isHeld()) {
        y.aerodynamicForce = acting.air.force;
        y.tetherForce = acting.tether;
        y.power = inputs.tetherSpeed * acting.tetherTension;
    }
    y.tetherLength = m_state.tetherLength;
    y.averagePower = m_state.averagePower;
    y.energy = m_state.energy;
    y.crashed = m_crashed;
    return y;
}

}  // namespace awe
