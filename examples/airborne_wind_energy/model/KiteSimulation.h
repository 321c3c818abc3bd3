// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Plant.h"
#include "Wind.h"

namespace awe {

/// The plant in its wind: what the model nodes compute, one way for both of them.
///
/// The outputs of a cycle belong to the state at its begin; then the state moves one step on.
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
        PlantInputs inputs;
        inputs.windVelocity = m_wind.velocity();
        return m_plant.outputs(inputs);
    }

    /// One step of 10 ms. \param pitchSpeed [deg/s] \param yawSpeed [deg/s] \param tetherSpeed [m/s], > 0 reels out
    PlantOutputs step(double pitchSpeed, double yawSpeed, double tetherSpeed)
    {
        const PlantInputs inputs{pitchSpeed, yawSpeed, tetherSpeed, m_wind.velocity()};
        const PlantOutputs outputs = m_plant.outputs(inputs);
        m_plant.step(inputs);
        m_wind.step();
        return outputs;
    }

private:
    Plant m_plant;
    Wind m_wind;
};

}  // namespace awe
