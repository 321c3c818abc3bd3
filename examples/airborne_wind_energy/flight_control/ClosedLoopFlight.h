// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Autopilot.h"
#include "ExtendedPlant.h"
#include "FlightStatistics.h"
#include "Wind.h"

#include <array>
#include <string>

namespace awe {

/// How many digits the signals between plant and autopilot have.
enum class SignalPrecision {
    Real64,  ///< as computed
    Real32   ///< rounded to float, as the distributed system sends them
};

/// What is flown by a ClosedLoopFlight. The plant holds a crashed wing on the ground.
struct ClosedLoopParameters
{
    PlantParameters plant = groundedPlant();
    PlantOptions options;
    WindParameters wind;
    AutopilotGains gains;
    int deadTime = 2;  // cycles from an output of the plant to the input it causes, 0...largestDeadTime

    SignalPrecision precision = SignalPrecision::Real64;

    static constexpr int largestDeadTime = 63;
    static PlantParameters groundedPlant();

    /// \return empty when all is well, otherwise one sentence with the parameter, its value and the
    ///         remedy
    std::string validate() const;
};

/// Plant, wind, autopilot and statistics in one loop, as the distributed system flies them, without
/// a network.
///
///     wind --> plant --> outputs --> [deadTime cycles] --> autopilot --> inputs of the same cycle
///
/// In the distributed system the outputs of cycle k reach the autopilot in k + 1 and its answer the
/// plant in k + 2: dead time 2. Until the first answer the inputs are zero. With same-cycle inputs
/// the answer to the outputs of cycle k moves the plant in k: dead time 0. The outputs then come
/// before the inputs, and what depends on both (power, and the tether force with damping) is shown
/// with the inputs of cycle k - 1. step() takes no memory. One thread at a time.
class ClosedLoopFlight
{
public:
    /// \pre parameters.validate() is empty
    explicit ClosedLoopFlight(const ClosedLoopParameters &parameters);

    void reset();

    /// One cycle.
    void step();

    /// Cycles until \a duration [s] more have passed.
    void fly(double duration);

    /// What an operator wants from now on; automatic after construction. With a mast only.
    void setRequest(FlightRequest request) { m_request = request; }

    FlightReport report() const { return m_statistics.report(); }
    const PlantOutputs &outputs() const { return m_outputs; }                // of the last cycle
    const AutopilotOutputs &autopilotOutputs() const { return m_commands; }  // of the last cycle
    const ExtendedPlant &plant() const { return m_plant; }
    Autopilot &autopilot() { return m_autopilot; }

    /// The measurements a set of plant outputs stands for.
    static FlightMeasurements measured(const PlantOutputs &outputs);

private:
    bool isRounded() const { return m_parameters.precision == SignalPrecision::Real32; }
    PlantInputs inputs() const;
    void recordStatistics();
    void askAutopilot();

    ClosedLoopParameters m_parameters;
    ExtendedPlant m_plant;
    Wind m_wind;
    Autopilot m_autopilot;
    FlightStatistics m_statistics;
    std::array<FlightMeasurements, ClosedLoopParameters::largestDeadTime + 1> m_delayed;
    std::int64_t m_cycle = 0;
    PlantOutputs m_outputs;
    AutopilotOutputs m_commands;
    FlightRequest m_request = FlightRequest::Automatic;
};

}  // namespace awe
