// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <chrono>

/// The cycle that a node computes: its number, its nominal time and its period. A node reads no
/// other clock.
///
/// \code
/// class Integrator : public QPlcCompactSlaveNode
/// {
/// public:
///     Integrator() : QPlcCompactSlaveNode("Integrator") {}
///
/// private:
///     QPlcInput<double> m_speed{this, "tetherSpeed"};     // [m/s]
///     QPlcOutput<double> m_length{this, "tetherLength"};  // [m]
///     void step(const QPlcCycle &cycle) override { m_length = m_length + m_speed * cycle.dt(); }
/// };
/// \endcode
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup nodes
class QPlcCycle
{
public:
    /// Makes cycle 0 with a period of 0.
    constexpr QPlcCycle() = default;
    /// Makes a cycle, for a test of a node.
    /// \param number  from 0
    /// \param period  nominal time between two cycles
    /// \param missed  see missedCycles()
    constexpr QPlcCycle(quint64 number, std::chrono::nanoseconds period, quint64 missed = 0)
        : m_number(number)
        , m_missed(missed)
        , m_period(period)
    {
    }

    /// Returns the number of the cycle since the start of the real-time phase, from 0.
    constexpr quint64 number() const { return m_number; }
    /// Returns the nominal time between two cycles, 10 us to 10 s.
    constexpr std::chrono::nanoseconds period() const { return m_period; }
    /// Returns the nominal time since the start of the real-time phase: number() * period(),
    /// exactly.
    constexpr std::chrono::nanoseconds time() const { return m_period * qint64(m_number); }
    /// Returns the period [s].
    constexpr double dt() const { return double(m_period.count()) * 1e-9; }
    /// Returns the number of cycles between the last step and this one that the node did not get,
    /// because of an overrun of the master or lost frames (QPlcSlaveNode::Counters tells which); 0
    /// in normal operation. Cycles that a listener skips on purpose
    /// (QPlcSlaveNode::setListeningInterval()) do not count.
    constexpr quint64 missedCycles() const { return m_missed; }

private:
    quint64 m_number = 0;
    quint64 m_missed = 0;
    std::chrono::nanoseconds m_period{0};
};
