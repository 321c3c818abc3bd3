// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Plant.h"
#include "Wind.h"

namespace awe {

/// The plant in its wind: what the model nodes compute, one way for both of them.
///
/// The outputs of a cycle belong to the state at its begin; then the state moves one step on. Power and, with damping, tether force also depend on the inputs
/// (direct feed-through): step() shows them with the inputs that came in, outputs() and update() with those of the step before.
class KiteSimulation
{
public:
    /// \pre both parameter sets are valid and have the same step
    KiteSimulation(const PlantParameters &plant, const WindParameters &wind)
        : m_plant(plant)
        , m_wind(wind)
    {
    }

    /// Back to the begin; outputs of the initial state with the inputs at rest.
    PlantOutputs reset()
    {
        m_plant.reset();
        m_wind.reset();
        m_inputs = PlantInputs();
        return outputs();
    }

    /// One step of 10 ms. \param pitchSpeed [deg/s] \param yawSpeed [deg/s] \param tetherSpeed [m/s], > 0 reels out
    PlantOutputs step(double pitchSpeed, double yawSpeed, double tetherSpeed)
    {
        m_inputs = {pitchSpeed, yawSpeed, tetherSpeed, m_wind.velocity()};
        const PlantOutputs outputs = m_plant.outputs(m_inputs);
        move();
        return outputs;
    }

    // The same in two phases.
    PlantOutputs outputs() const
    {
        PlantInputs inputs = m_inputs;
        inputs.windVelocity = m_wind.velocity();
        return m_plant.outputs(inputs);
    }
    void update(double pitchSpeed, double yawSpeed, double tetherSpeed)
    {
        m_inputs = {pitchSpeed, yawSpeed, tetherSpeed, m_wind.velocity()};
        move();
    }

private:
    void move()
    {
        m_plant.step(m_inputs);
        m_wind.step();
    }

    Plant m_plant;
    Wind m_wind;
    PlantInputs m_inputs;  // of the last step
};

}  // namespace awe
