// SPDX-License-Identifier: Apache-2.0
#include "ClosedLoopFlight.h"

#include "AngleMath.h"
#include "RangeCheck.h"

#include <algorithm>
#include <cmath>

namespace awe {

namespace {

FlightStatisticsParameters statisticsParameters(const ClosedLoopParameters &parameters)
{
    FlightStatisticsParameters statistics = FlightStatisticsParameters::of(parameters.plant);
    statistics.step = parameters.plant.step;
    statistics.nominalWindSpeed = parameters.wind.meanVelocity.norm();
    return statistics;
}

// Volatile, because g++ 12 leaves out such a pair of conversions where it vectorizes them.
double rounded(double value)
{
    const volatile float sent = static_cast<float>(value);
    return static_cast<double>(sent);
}

Eigen::Vector3d rounded(const Eigen::Vector3d &vector)
{
    return {rounded(vector.x()), rounded(vector.y()), rounded(vector.z())};
}

/// What of the outputs is measured or recorded.
PlantOutputs rounded(const PlantOutputs &outputs)
{
    PlantOutputs sent = outputs;
    sent.inputs.windVelocity = rounded(outputs.inputs.windVelocity);
    sent.position = rounded(outputs.position);
    sent.velocity = rounded(outputs.velocity);
    sent.bodyControlOrientation = rounded(outputs.bodyControlOrientation);
    sent.angleOfAttack = rounded(outputs.angleOfAttack);
    sent.tetherForce = rounded(outputs.tetherForce);
    sent.tetherLength = rounded(outputs.tetherLength);
    sent.power = rounded(outputs.power);
    sent.energy = rounded(outputs.energy);
    return sent;
}

AutopilotOutputs rounded(AutopilotOutputs outputs)
{
    for (double *value :
         {&outputs.pitchSpeed, &outputs.yawSpeed, &outputs.tetherSpeed, &outputs.steering, &outputs.turbineCoefficient})
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
    for (const std::string &complaint :
         {plant.validate(), options.validateFor(plant), wind.validate(), gains.validate()}) {
        if (!complaint.empty())
            return complaint;
    }
    RangeCheck check;
    check.within("deadTime", deadTime, 0, largestDeadTime, "cycles");
    check.within("step of the wind", wind.step, plant.step, plant.step, "s");
    check.within("step of the autopilot", gains.step, plant.step, plant.step, "s");
    return check.message();
}

ClosedLoopFlight::ClosedLoopFlight(const ClosedLoopParameters &parameters)
    : m_parameters(parameters)
    , m_plant(parameters.plant, parameters.options)
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
    m_request = FlightRequest::Automatic;
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
    measurements.airspeed = (wind - outputs.velocity).norm();
    measurements.windVelocity = wind;
    measurements.windDirection = std::atan2(wind.y(), wind.x()) * degreesPerRadian;
    return measurements;
}

PlantInputs ClosedLoopFlight::inputs() const
{
    return {m_commands.pitchSpeed, m_commands.yawSpeed, m_commands.tetherSpeed,        m_wind.velocity(),
            m_wind.turbulence(),   m_commands.steering, m_commands.turbineCoefficient, m_commands.release};
}

// Without dead time the answer to the outputs of this cycle acts in this one, otherwise in the next
// at the earliest.
void ClosedLoopFlight::step()
{
    const bool answersAtOnce = m_parameters.deadTime == 0;
    const PlantOutputs outputs = m_plant.outputs(inputs());
    m_outputs = isRounded() ? rounded(outputs) : outputs;
    if (answersAtOnce)
        askAutopilot();
    m_plant.step(inputs());
    recordStatistics();
    m_wind.step();
    if (!answersAtOnce)
        askAutopilot();
    ++m_cycle;
}

void ClosedLoopFlight::recordStatistics()
{
    FlightSample sample;
    sample.position = m_outputs.position;
    sample.velocity = m_outputs.velocity;
    sample.windVelocity = m_outputs.inputs.windVelocity;
    sample.tetherForce = m_outputs.tetherForce;
    sample.tetherSpeed = m_commands.tetherSpeed;
    sample.power = m_outputs.power;
    sample.energy = m_outputs.energy;
    sample.electricalEnergy = m_plant.electricalEnergy();
    sample.turbineEnergy = m_plant.turbineEnergy();
    sample.isDocked = m_plant.isDocked();
    sample.dockings = m_plant.dockings();
    sample.dockingSpeed = m_plant.dockingSpeed();
    sample.crashed = m_outputs.crashed;
    sample.isMachineOff = m_plant.isMachineOff();
    sample.flightPhase = static_cast<std::int8_t>(m_commands.phase);
    m_statistics.step(sample);
}

// Being asked at the end of a cycle is one cycle of dead time in itself.
void ClosedLoopFlight::askAutopilot()
{
    const auto slot = [](std::int64_t cycle) {
        return static_cast<std::size_t>(cycle % (ClosedLoopParameters::largestDeadTime + 1));
    };
    FlightMeasurements &now = m_delayed[slot(m_cycle)];
    now = measured(m_outputs);
    now.isDocked = m_plant.isDocked();
    now.request = m_request;
    const std::int64_t seen = m_cycle - std::max(0, m_parameters.deadTime - 1);
    if (seen < 0)
        return;
    m_commands = m_autopilot.step(m_delayed[slot(seen)]);
    if (isRounded())
        m_commands = rounded(m_commands);
}

void ClosedLoopFlight::fly(double duration)
{
    const auto cycles = std::lround(duration / m_parameters.plant.step);
    for (long i = 0; i < cycles; ++i)
        step();
}

}  // namespace awe
