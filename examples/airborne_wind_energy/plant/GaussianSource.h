// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace awe {

/// Independent numbers of the standard normal distribution, the same ones for the same seed with
/// every compiler.
///
/// std::mt19937_64 is fixed by the C++ standard to the last bit, std::normal_distribution is not;
/// so the numbers come from the polar method of Marsaglia on the upper 53 bits of the engine.
/// next() takes no memory.
class GaussianSource
{
public:
    explicit GaussianSource(std::uint64_t seed = 1);

    /// Starts the sequence of \a seed from its beginning.
    void reset(std::uint64_t seed);

    double next();

private:
    double uniform();  // -1 <= u < 1

    std::mt19937_64 m_engine;
    double m_spare = 0.0;  // the polar method makes two numbers at a time
    bool m_hasSpare = false;
};

}  // namespace awe
