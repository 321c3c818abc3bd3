// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace awe {

/// Turbulence with the spectrum of Kaimal, as IEC 61400-1 gives it for a point:
///
///     f S_k(f) / sigma_k^2 = 4 n / (1 + 6 n)^(5/3),  n = f L_k / U
///     sigma = (1, 0.8, 0.5) TI U,  L = (8.1, 2.7, 0.66) Lambda
///
/// along the mean wind, across it, and upwards.
///
/// It is a sum of harmonics. Each one stands for a band of frequencies, has the variance of the
/// spectrum in this band (the whole integral is exact), a frequency at random within it, and a
/// phase at random. So the variance does not depend on the step, nothing repeats itself, and the
/// flight begins in turbulence that is fully grown. The same seed gives the same turbulence, bit
/// for bit, on each machine with the same mathematical library.
///
/// step() takes no memory. One thread at a time.
class KaimalTurbulence
{
public:
    static constexpr int bands = 96;

    KaimalTurbulence() = default;
    /// \param speed      U, mean wind [m/s], > 0
    /// \param deviation  sigma of the three parts [3] [m/s]
    /// \param scale      Lambda: 0.7 times the height, 42 m at most [m], > 0
    /// \param step       time between two values [s], > 0
    KaimalTurbulence(double speed, const Eigen::Vector3d &deviation, double scale, double step, std::uint64_t seed);

    /// Moves on by one step. \return along the mean wind, across it, upwards [3] [m/s]
    Eigen::Vector3d step();

private:
    struct Harmonic  // a turning pointer; its first part is the value
    {
        double x = 0.0, y = 0.0;              // [m/s]
        double cosTurn = 1.0, sinTurn = 0.0;  // of one step
    };

    std::array<std::array<Harmonic, bands>, 3> m_parts;
};

}  // namespace awe
