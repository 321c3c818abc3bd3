// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AutopilotGains.h"
#include "AutopilotOutputs.h"
#include "CourseController.h"
#include "FlightMeasurements.h"
#include "LowPass.h"
#include "MastController.h"
#include "OrientationController.h"
#include "PowerController.h"
#include "SteeringController.h"

namespace awe {

/// Flies pumping cycles without hands: three nested controllers (thesis, figure 2.8) and the
/// filters between them.
///
///     sensors --> [filters] --> +-------+ course, pitch +--------+ gamma_ref +-------------+ --> yawSpeed
///                               | power |-------------->| course |---------->| orientation | --> pitchSpeed
///                               +-------+               +--------+           +-------------+
///                                   +-----------------------------------------------------------> tetherSpeed
///
/// With a mast (MastGains) the mast controller starts and lands the wing, and gives the power
/// controller the time between. A request (FlightRequest) makes it start or land at once.
///
///     wind azimuth  low pass 20 s of the measured direction, starts with the first measurement
///     F_f           low pass 0.25 s of the tether force (in the power controller)
///     v_f           low pass 3 s of the tangential speed on the eight; held in the other phases; starts with 12 m/s
///
///     Autopilot autopilot(AutopilotGains::safe());           // validate() was empty
///     const AutopilotOutputs u = autopilot.step(measured);   // once per gains().step
///
/// Where nothing is measured yet (position zero) or a measurement is not finite, the commands are
/// zero speeds, and that cycle is not remembered. step() takes no memory, never fails, and depends
/// on nothing but the measurements since reset(). One thread at a time.
class Autopilot
{
public:
    /// \pre gains.validate() is empty
    explicit Autopilot(const AutopilotGains &gains = AutopilotGains());

    /// Back to the state after construction, exactly.
    void reset();

    /// One control cycle.
    AutopilotOutputs step(const FlightMeasurements &measurements);

    FlightPhase phase() const { return m_phase; }
    const AutopilotGains &gains() const { return m_gains; }
    const PowerController &powerController() const { return m_power; }
    const CourseController &courseController() const { return m_course; }
    const MastController &mastController() const { return m_mast; }

private:
    static bool isUsable(const FlightMeasurements &measurements);
    void filterWindDirection(double direction);
    void flyCycle(const FlightMeasurements &measurements, const FlightGeometry &geometry, AutopilotOutputs *outputs);
    bool flyAtMast(const FlightMeasurements &measurements, const FlightGeometry &geometry, AutopilotOutputs *outputs);

    AutopilotGains m_gains;
    OrientationController m_orientation;
    SteeringController m_steering;
    CourseController m_course;
    PowerController m_power;
    MastController m_mast;
    FlightPhase m_phase;
    double m_tetherSpeed = 0.0;  // last v_t [m/s]
    LowPass m_flightSpeed;
    LowPass m_windDirection;  // [deg]
    bool m_hasWindDirection = false;
};

}  // namespace awe
