// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExtendedPlant.h"
#include "Wind.h"

#include <array>
#include <stdexcept>

namespace awe {

/// What the options of the plant show of one instant, beside PlantOutputs.
struct KiteDetails
{
    PlantOutputs outputs;
    PlantDetails plant;
    std::array<Eigen::Vector3d, TetherParameters::mostSegments> nodes;  // of the tether, without its ends [m]
};

/// The plant in its wind: what the model nodes compute, one way for both of them.
///
/// The outputs of a cycle belong to the state at its begin; then the state moves one step on. Power
/// and, with damping, tether force also depend on the inputs (direct feed-through): step() shows
/// them with the inputs that came in, outputs() and update() with those of the step before. A
/// simulation that diverges throws: its node then has failed, and says why.
class KiteSimulation
{
public:
    /// \param substeps  Runge-Kutta steps in each cycle, for a light kite or a stiff tether
    /// \param options   of the plant
    /// \pre all parameters are valid; plant and wind have the same step: that of the cycle
    KiteSimulation(const PlantParameters &plant, const WindParameters &wind, int substeps = 1,
                   const PlantOptions &options = PlantOptions())
        : m_plant(divided(plant, substeps), options)
        , m_wind(wind)
        , m_substeps(substeps)
        , m_isThesis(options.isThesis())
    {
    }

    const PlantOptions &options() const { return m_plant.options(); }

    /// Back to the begin; outputs of the initial state with the inputs at rest.
    PlantOutputs reset()
    {
        m_plant.reset();
        m_wind.reset();
        m_inputs = PlantInputs();
        return outputs();
    }

    /// One step of 10 ms. \param commands  for wing, winch, turbines and mast; the wind is that of
    /// this object
    PlantOutputs step(const PlantInputs &commands)
    {
        m_inputs = inThisWind(commands);
        const PlantOutputs outputs = shown(m_inputs);
        move();
        return outputs;
    }

    // The same in two phases.
    PlantOutputs outputs() { return shown(inThisWind(m_inputs)); }
    void update(const PlantInputs &commands)
    {
        m_inputs = inThisWind(commands);
        move();
    }

    /// Of the instant that the last outputs belong to. \pre the plant has options
    const KiteDetails &details() const { return m_details; }

private:
    static PlantParameters divided(PlantParameters plant, int substeps)
    {
        plant.step /= substeps;
        return plant;
    }

    PlantInputs inThisWind(PlantInputs inputs) const
    {
        inputs.windVelocity = m_wind.velocity();
        inputs.turbulence = m_wind.turbulence();
        return inputs;
    }

    PlantOutputs shown(const PlantInputs &inputs)
    {
        const PlantOutputs outputs = m_plant.outputs(inputs);
        if (m_isThesis)
            return outputs;
        m_details.outputs = outputs;
        m_details.plant = m_plant.details(inputs);
        for (int node = 1; node < m_plant.segmentCount(); ++node)
            m_details.nodes[std::size_t(node - 1)] = m_plant.position(node);
        return outputs;
    }

    void move()
    {
        for (int i = 0; i < m_substeps; ++i)
            m_plant.step(m_inputs);
        m_wind.step();
        if (isReeledIn())
            throw std::runtime_error("the tether is reeled in: its segments are shorter than 5 cm; stop the winch "
                                     "before, or use fewer 'segments' in [tether] of --plant");
        if (!(m_plant.velocity(m_plant.segmentCount()).squaredNorm()
              < fastest * fastest))  // also when it is not a number
            throw std::runtime_error(
                "the simulation has diverged: the kite is faster than 1000 m/s; its mass is too small or its tether "
                "too stiff for the step, so use more 'substeps' in [kite] of --plant");
    }

    bool isReeledIn() const
    {
        const TetherParameters &tether = options().tether;
        return tether.kind == TetherKind::Segments
            && m_plant.tetherLength() < TetherParameters::shortestSegment * tether.segments;
    }

    static constexpr double fastest = 1000.0;  // [m/s]

    ExtendedPlant m_plant;
    Wind m_wind;
    int m_substeps;
    bool m_isThesis;
    PlantInputs m_inputs;  // of the last step
    KiteDetails m_details;
};

}  // namespace awe
