// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace awe {

/// First-order low pass: T y' + y = u, advanced by y += min(1, h / T) (u - y).
class LowPass
{
public:
    /// \param timeConstant  T [s], > 0
    /// \param step          h [s], > 0
    LowPass(double timeConstant, double step, double start = 0.0)
        : m_weight(step < timeConstant ? step / timeConstant : 1.0)
        , m_value(start)
    {
    }

    void reset(double value) { m_value = value; }
    double step(double input) { return m_value += m_weight * (input - m_value); }
    double value() const { return m_value; }

private:
    double m_weight;
    double m_value;
};

}  // namespace awe
