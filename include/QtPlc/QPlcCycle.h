// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <chrono>

/// What a node knows of the cycle that it computes: the only clock of a node. A value type.
class QPlcCycle
{
public:
    constexpr QPlcCycle() = default;
    constexpr QPlcCycle(quint64 number, std::chrono::nanoseconds period, quint64 missed = 0)
        : m_number(number)
        , m_missed(missed)
        , m_period(period)
    {
    }

    /// Number of the cycle since the start of the real-time phase, from 0.
    constexpr quint64 number() const { return m_number; }
    /// Nominal time between two cycles.
    constexpr std::chrono::nanoseconds period() const { return m_period; }
    /// Nominal time since the start of the real-time phase: number() x period(), exact.
    constexpr std::chrono::nanoseconds time() const { return m_period * qint64(m_number); }
    /// The period [s].
    constexpr double dt() const { return double(m_period.count()) * 1e-9; }
    /// Cycles since the last step() that this node never saw (overrun of the master, lost frames); 0 when all is well. Those that a listener does not want
    /// (QPlcSlaveNode::setListeningInterval()) do not count.
    constexpr quint64 missedCycles() const { return m_missed; }

private:
    quint64 m_number = 0;
    quint64 m_missed = 0;
    std::chrono::nanoseconds m_period{0};
};
