// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GaussianSource.h"
#include "KaimalTurbulence.h"
#include "WindParameters.h"

#include <Eigen/Core>

#include <cstdint>

namespace awe {

/// A wind that is the same everywhere at one instant: mean + gust + turbulence.
///
///     w(t) = w_mean (1 + A/2 (1 - cos(2 pi (t - t0) / D)))  for t0 < t < t0 + D,  w_mean otherwise      1-cos gust
///          + n(t)                                                                                        turbulence
///
/// With dayShare < 1 all of it, turbulence too, comes and goes in days of the length T:
///
///     w(t) <- w(t) (share + (1 - share) / 2 (1 - cos(2 pi t / T)))
///
/// The turbulence n has three independent parts: along the mean wind, across it (level), and
/// upwards. By the TurbulenceModel it is that of KaimalTurbulence, or each part is an
/// Ornstein-Uhlenbeck process, n' = -n |w_mean| / L + white noise, of the standard deviation sigma
/// = TI |w_mean| turbulenceRatio, advanced by its exact solution
///
///     n(k+1) = a n(k) + sigma sqrt(1 - a^2) g(k),  a = exp(-h |w_mean| / L),  g standard normal
///
/// so its statistics do not depend on the step. It starts at zero and is fully grown after a few L
/// / |w_mean|. The same parameters give the same wind, bit for bit. step() takes no memory. One
/// thread at a time.
class Wind
{
public:
    /// \pre parameters.validate() is empty
    explicit Wind(const WindParameters &parameters = WindParameters());

    /// Back to the first instant, the same sequence again.
    void reset();

    /// Moves on by parameters().step seconds.
    void step();

    /// w [3] [m/s] in the earth frame, now
    const Eigen::Vector3d &velocity() const { return m_velocity; }

    /// The part of velocity() that is turbulence [3] [m/s]
    const Eigen::Vector3d &turbulence() const { return m_turbulenceNow; }

    /// Time since reset() [s]
    double time() const { return static_cast<double>(m_steps) * m_parameters.step; }

    const WindParameters &parameters() const { return m_parameters; }

private:
    double gustFactor() const;
    void composeVelocity();
    void moveKaimal();

    WindParameters m_parameters;
    GaussianSource m_gaussian;
    double m_memory = 0.0;  // a
    bool m_isTurbulent = false;
    bool m_isKaimal = false;
    KaimalTurbulence m_kaimal;
    Eigen::Matrix3d m_frame = Eigen::Matrix3d::Identity();   // columns: along the mean wind, across it, upwards
    Eigen::Matrix3d m_excitation = Eigen::Matrix3d::Zero();  // columns: sigma sqrt(1 - a^2) times direction [m/s]
    std::int64_t m_steps = 0;
    Eigen::Vector3d m_turbulence = Eigen::Vector3d::Zero();     // n [m/s], without the day
    Eigen::Vector3d m_turbulenceNow = Eigen::Vector3d::Zero();  // [m/s]
    Eigen::Vector3d m_velocity = Eigen::Vector3d::Zero();
};

}  // namespace awe
