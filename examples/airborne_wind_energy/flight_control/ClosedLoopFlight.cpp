// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"

#include "AngleMath.h"
#include "RangeCheck.h"

#include <cmath>

namespace awe {

namespace {

FlightStatisticsParameters statisticsParameters(const ClosedLoopParameters &parameters)
{
    FlightStatisticsParameters statistics;
    statistics.step = parameters.plant.step;
    statistics.airDensity = parameters.plant.airDensity;
    statistics.area = parameters.plant.area;
    statistics.aweCoefficient = Aerodynamics::bestAngleOfAttack().aweCoefficient;
    statistics.nominalWindSpeed = parameters.wind.meanVelocity.norm();
    return statistics;
}

double rounded(double value)
{
    return static_cast<double>(static_cast<float>(value));
}

FlightMeasurements rounded(FlightMeasurements measurements)
{
    for (int i = 0; i < 3; ++i) {
        measurements.position[i] = rounded(measurements.position[i]);
        measurements.velocity[i] = rounded(measurements.velocity[i]);
    }
    for (double *value : {&measurements.pitchAngle, &measurements.yawAngle, &measurements.angleOfAttack,
                          &measurements.tetherLength, &measurements.tetherForce, &measurements.windDirection})
        *value = rounded(*value);
    return measurements;
}

AutopilotOutputs rounded(AutopilotOutputs outputs)
{
    for (double *value : {&outputs.pitchSpeed, &outputs.yawSpeed, &outputs.tetherSpeed})
        *value = rounded(*value);
    return outputs;
}

}  // namespace

PlantParameters ClosedLoopParameters::groundedPlant()
{
    PlantParameters plant;
    plant.groundContact = GroundContact::Hold;
    return plant;
}

std::string ClosedLoopParameters::validate() const
{
    for (const std::string &complaint : {plant.validate(), wind.validate(), gains.validate()}) {
        if (!complaint.empty())
            return complaint;
    }
    RangeCheck check;
    check.within("deadTime", deadTime, 1, largestDeadTime, "cycles");
    check.within("step of the wind", wind.step, plant.step, plant.step, "s");
    check.within("step of the autopilot", gains.step, plant.step, plant.step, "s");
    return check.message();
}

ClosedLoopFlight::ClosedLoopFlight(const ClosedLoopParameters &parameters)
    : m_parameters(parameters)
    , m_plant(parameters.plant)
    , m_wind(parameters.wind)
    , m_autopilot(parameters.gains)
    , m_statistics(statisticsParameters(parameters))
{
}

void ClosedLoopFlight::reset()
{
    m_plant.reset();
    m_wind.reset();
    m_autopilot.reset();
    m_statistics.reset();
    m_cycle = 0;
    m_outputs = PlantOutputs();
    m_commands = AutopilotOutputs();
}

FlightMeasurements ClosedLoopFlight::measured(const PlantOutputs &outputs)
{
    FlightMeasurements measurements;
    measurements.position = outputs.position;
    measurements.velocity = outputs.velocity;
    measurements.pitchAngle = outputs.bodyControlOrientation.y();
    measurements.yawAngle = outputs.bodyControlOrientation.z();
    measurements.angleOfAttack = outputs.angleOfAttack;
    measurements.tetherLength = outputs.tetherLength;
    measurements.tetherForce = outputs.tetherForce.norm();
    const Eigen::Vector3d &wind = outputs.inputs.windVelocity;
    measurements.windDirection = std::atan2(wind.y(), wind.x()) * degreesPerRadian;
    return measurements;
}

void ClosedLoopFlight::step()
{
    PlantInputs inputs;
    inputs.pitchSpeed = m_commands.pitchSpeed;
    inputs.yawSpeed = m_commands.yawSpeed;
    inputs.tetherSpeed = m_commands.tetherSpeed;
    inputs.windVelocity = m_wind.velocity();
    m_outputs = m_plant.outputs(inputs);
    m_plant.step(inputs);
    m_wind.step();
    recordStatistics(inputs);
    askAutopilot();
    ++m_cycle;
}

void ClosedLoopFlight::recordStatistics(const PlantInputs &inputs)
{
    FlightSample sample;
    sample.position = m_outputs.position;
    sample.windVelocity = inputs.windVelocity;
    sample.tetherForce = m_outputs.tetherForce;
    sample.tetherSpeed = inputs.tetherSpeed;
    sample.power = m_outputs.power;
    sample.energy = m_outputs.energy;
    sample.flightPhase = static_cast<std::int8_t>(m_commands.phase);
    m_statistics.step(sample);
}

// The answer to the outputs of this cycle acts in the next one: one cycle of dead time is in the loop itself.
void ClosedLoopFlight::askAutopilot()
{
    const auto slot = [](std::int64_t cycle) {
        return static_cast<std::size_t>(cycle % (ClosedLoopParameters::largestDeadTime + 1));
    };
    const bool isRounded = m_parameters.precision == SignalPrecision::Real32;
    const FlightMeasurements measurements = measured(m_outputs);
    m_delayed[slot(m_cycle)] = isRounded ? rounded(measurements) : measurements;
    const std::int64_t seen = m_cycle - (m_parameters.deadTime - 1);
    if (seen < 0)
        return;
    m_commands = m_autopilot.step(m_delayed[slot(seen)]);
    if (isRounded)
        m_commands = rounded(m_commands);
}

void ClosedLoopFlight::fly(double duration)
{
    const auto cycles = std::lround(duration / m_parameters.plant.step);
    for (long i = 0; i < cycles; ++i)
        step();
}

}  // namespace awe
