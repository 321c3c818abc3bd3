// SPDX-License-Identifier: Apache-2.0
#include "GaussianSource.h"

#include <cmath>

namespace awe {

GaussianSource::GaussianSource(std::uint64_t seed)
    : m_engine(seed)
{
}

void GaussianSource::reset(std::uint64_t seed)
{
    m_engine.seed(seed);
    m_hasSpare = false;
}

double GaussianSource::uniform()
{
    constexpr double scale = 1.0 / 4503599627370496.0;  // 2^-52
    return static_cast<double>(m_engine() >> 11) * scale - 1.0;
}

double GaussianSource::next()
{
    if (m_hasSpare) {
        m_hasSpare = false;
        return m_spare;
    }
    double x = 0.0, y = 0.0, square = 0.0;
    do {
        x = uniform();
        y = uniform();
        square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(square) / square);
    m_spare = y * factor;
    m_hasSpare = true;
    return x * factor;
}

}  // namespace awe
