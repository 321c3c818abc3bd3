// SPDX-License-Identifier: Apache-2.0
#include "KaimalTurbulence.h"

#include "AngleMath.h"

#include <cmath>
#include <random>

namespace awe {

namespace {

// Borders of the bands: n = f L / U, the same distance of their logarithms.
constexpr double lowestBorder = 1e-3, highestBorder = 1e3;

double uniform(std::mt19937_64 &engine)  // 0 <= u < 1
{
    constexpr double scale = 1.0 / 9007199254740992.0;  // 2^-53
    return static_cast<double>(engine() >> 11) * scale;
}

/// Part of the variance above the frequency \a n.
double varianceAbove(double n)
{
    return std::pow(1.0 + 6.0 * n, -2.0 / 3.0);
}

double border(int band)  // lower one of the band
{
    if (band == 0)
        return 0.0;
    return lowestBorder * std::pow(highestBorder / lowestBorder, double(band - 1) / (KaimalTurbulence::bands - 1));
}

}  // namespace

KaimalTurbulence::KaimalTurbulence(double speed, const Eigen::Vector3d &deviation, double scale, double step,
                                   std::uint64_t seed)
{
    constexpr double lengthRatio[] = {8.1, 2.7, 0.66};
    std::mt19937_64 engine(seed);
    for (int part = 0; part < 3; ++part) {
        const double length = lengthRatio[part] * scale;
        for (int band = 0; band < bands; ++band) {
            const double low = border(band), high = border(band + 1);
            const bool isLast = band + 1 == bands;
            const double variance = varianceAbove(low) - (isLast ? 0.0 : varianceAbove(high));
            const double n = low + (high - low) * uniform(engine);
            const double turn = 2.0 * pi * n * speed / length * step;
            const double phase = 2.0 * pi * uniform(engine);
            const double amplitude = deviation[part] * std::sqrt(2.0 * variance);
            m_parts[std::size_t(part)][std::size_t(band)]
                = {amplitude * std::cos(phase), amplitude * std::sin(phase), std::cos(turn), std::sin(turn)};
        }
    }
}

Eigen::Vector3d KaimalTurbulence::step()
{
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (int part = 0; part < 3; ++part) {
        for (Harmonic &harmonic : m_parts[std::size_t(part)]) {
            const double x = harmonic.cosTurn * harmonic.x - harmonic.sinTurn * harmonic.y;
            harmonic.y = harmonic.sinTurn * harmonic.x + harmonic.cosTurn * harmonic.y;
            harmonic.x = x;
            value[part] += x;
        }
    }
    return value;
}

}  // namespace awe
