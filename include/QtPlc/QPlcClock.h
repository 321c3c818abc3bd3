// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// How the cycles of a master follow each other.
///
/// Whatever the clock, cycle k happens at the nominal time k x period since the start of the real-time phase, and nodes take time from there alone.
/// A value type.
class QPlcClock
{
public:
    enum Kind : quint8 {
        RealTime,  ///< one cycle each period of CLOCK_MONOTONIC
        Scaled,    ///< `scale` times as fast (0.1: slow motion)
        Lockstep   ///< the next cycle as soon as all nodes that are not listeners have answered; bit-identical results
    };

    static constexpr QPlcClock realTime() { return QPlcClock(RealTime, 1.0); }
    /// \param scale  simulated seconds per second, 0.001 ... 1000
    static constexpr QPlcClock scaled(double scale) { return QPlcClock(Scaled, scale); }
    static constexpr QPlcClock lockstep() { return QPlcClock(Lockstep, 0.0); }

    constexpr QPlcClock() = default;
    constexpr Kind kind() const { return m_kind; }
    /// Simulated seconds per second; 1 for RealTime, 0 (as fast as possible) for Lockstep.
    constexpr double scale() const { return m_scale; }
    constexpr bool isLockstep() const { return m_kind == Lockstep; }
    constexpr bool isValid() const { return m_kind != Scaled || (m_scale >= 0.001 && m_scale <= 1000.0); }

    friend constexpr bool operator==(QPlcClock a, QPlcClock b)
    {
        return a.m_kind == b.m_kind && a.m_scale == b.m_scale;
    }
    friend constexpr bool operator!=(QPlcClock a, QPlcClock b) { return !(a == b); }

private:
    constexpr QPlcClock(Kind kind, double scale)
        : m_kind(kind)
        , m_scale(scale)
    {
    }
    Kind m_kind = RealTime;
    double m_scale = 1.0;
};

Q_DECLARE_METATYPE(QPlcClock)
