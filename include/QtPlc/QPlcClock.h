// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// How the cycles of a master follow each other: in real time, scaled, as fast as possible, or when
/// the program says so.
///
/// \code
/// QPlcMasterNode master;
/// master.setClock(QPlcClock::scaled(0.1));  // ten times slower
/// \endcode
///
/// With each clock, cycle k has the nominal time k * period since the start of the real-time phase,
/// and nodes use this time only.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup time
class QPlcClock
{
public:
    /// The kinds of clocks.
    enum Kind : quint8 {
        RealTime,  ///< one cycle per period of CLOCK_MONOTONIC
        Scaled,    ///< `scale` times as fast; 0.1 is slow motion
        /// The next cycle begins when all nodes but listeners have answered; bit-identical results.
        Lockstep,
        /// A cycle begins when the program calls QPlcMasterNode::step(); else as Lockstep.
        External
    };

    /// Returns the clock of real time: one simulated second per second.
    static constexpr QPlcClock realTime() { return QPlcClock(RealTime, 1.0); }
    /// Returns a clock that is faster or slower than real time.
    /// \param scale  simulated seconds per second, 0.001 to 1000; outside of that the clock is not
    ///     valid
    static constexpr QPlcClock scaled(double scale) { return QPlcClock(Scaled, scale); }
    /// Returns the clock that waits for nodes instead of time.
    static constexpr QPlcClock lockstep() { return QPlcClock(Lockstep, 0.0); }

    /// Returns the clock that the program turns itself: each cycle is a call of
    /// QPlcMasterNode::step(). Nodes see no difference to lockstep, except that a node with real
    /// devices also watches real time: it goes to its safe state when the program hangs.
    static constexpr QPlcClock external() { return QPlcClock(External, 0.0); }

    /// Makes the clock of real time.
    constexpr QPlcClock() = default;
    /// Returns what cycles follow: real time, a scaled time, the answers of nodes, or the program.
    constexpr Kind kind() const { return m_kind; }
    /// Returns the simulated seconds per second: 1 for RealTime, 0 for Lockstep (as fast as
    /// possible) and External.
    constexpr double scale() const { return m_scale; }
    /// Returns true if cycles follow a clock of the computer: RealTime and Scaled. Otherwise each
    /// cycle waits for the nodes, no clock is read, and results do not depend on the computer.
    constexpr bool isTimed() const { return m_kind == RealTime || m_kind == Scaled; }
    /// Returns true if the next cycle begins by itself when the nodes have answered.
    constexpr bool isLockstep() const { return m_kind == Lockstep; }
    /// Returns true if the program turns the clock with QPlcMasterNode::step().
    constexpr bool isExternal() const { return m_kind == External; }
    /// Returns false for a scale outside of 0.001 to 1000.
    constexpr bool isValid() const { return m_kind != Scaled || (m_scale >= 0.001 && m_scale <= 1000.0); }

    /// Returns true if kind and scale are the same.
    friend constexpr bool operator==(QPlcClock a, QPlcClock b)
    {
        return a.m_kind == b.m_kind && a.m_scale == b.m_scale;
    }
    /// Returns true if kind or scale differ.
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
