// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What a master does after an *overrun*: the next cycle can begin only a whole period or more
/// after its nominal time, because the cycle before took too long or the machine did something
/// else.
///
/// \code
/// QPlcMasterNode master;
/// master.setOverrunPolicy(QPlcOverrunPolicy::catchUp(3));
/// \endcode
///
/// | policy       | lost cycles       | cycle numbers | phase of the grid     |
/// |--------------|-------------------|---------------|-----------------------|
/// | skipToGrid() | those in the past | jump          | stays                 |
/// | catchUp(n)   | those beyond n    | jump beyond n | stays                 |
/// | shift()      | none              | in order      | moves by the lateness |
/// | stop()       | none              | end           | -                     |
///
/// Use skipToGrid() (the default) when the newest values count: most controllers. Use catchUp()
/// when every step counts: integrators, recorders, state machines. Use shift() when the distance
/// between two steps counts more than the time of day. Use stop() when an overrun means that
/// something is broken: test benches.
///
/// A cycle that is late by less than a period is not an overrun. It runs at once with each policy,
/// and its lateness is recorded. In lockstep there is no overrun.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup time
class QTPLC_EXPORT QPlcOverrunPolicy
{
public:
    /// The policies.
    enum Kind : quint8 {
        SkipToGrid,  ///< cycles whose period is over are left out and counted; the grid stays
        /// Missed cycles run one after the other, at most n in a row; older ones are left out and
        /// counted.
        CatchUp,
        /// The grid moves so that the late cycle is on it again; the moved time is counted.
        Shift,
        /// The phase ends with QPlcMasterNode::RealTimeError; the late cycle is not computed.
        Stop
    };

    /// Largest number of cycles for catchUp().
    static constexpr int MaximumCatchUp = 1'000'000;

    /// Returns the policy that leaves out cycles and keeps the times of the others.
    static constexpr QPlcOverrunPolicy skipToGrid() { return QPlcOverrunPolicy(SkipToGrid, 0); }
    /// Returns the policy CatchUp.
    /// \param cycles  missed cycles that run in a row at most, 1 to MaximumCatchUp; outside of that
    ///     the policy is not valid
    static constexpr QPlcOverrunPolicy catchUp(int cycles) { return QPlcOverrunPolicy(CatchUp, cycles); }
    /// Returns the policy that moves the late cycle and all later ones.
    static constexpr QPlcOverrunPolicy shift() { return QPlcOverrunPolicy(Shift, 0); }
    /// Returns the policy that ends the real-time phase at the first overrun.
    static constexpr QPlcOverrunPolicy stop() { return QPlcOverrunPolicy(Stop, 0); }

    /// Makes the policy SkipToGrid.
    constexpr QPlcOverrunPolicy() = default;
    /// Returns the kind, without the number of cycles.
    constexpr Kind kind() const { return m_kind; }
    /// Returns the missed cycles that run in a row at most; 0 unless the kind is CatchUp.
    constexpr int catchUpCycles() const { return m_cycles; }
    /// Returns false for CatchUp with a number outside of 1 to MaximumCatchUp.
    constexpr bool isValid() const { return m_kind != CatchUp || (m_cycles >= 1 && m_cycles <= MaximumCatchUp); }

    /// Reads "skip", "catch-up:N", "shift" or "stop", as the command line has it.
    /// \param error  if given: what is wrong and the remedy; empty for a valid text
    /// \return skipToGrid() for any other text
    static QPlcOverrunPolicy fromString(const QString &text, QString *error = nullptr);
    /// Returns a text that fromString() reads back: "skip", "catch-up:3", "shift", "stop".
    QString toString() const;

    /// Returns true if kind and number of cycles are the same.
    friend constexpr bool operator==(QPlcOverrunPolicy a, QPlcOverrunPolicy b)
    {
        return a.m_kind == b.m_kind && a.m_cycles == b.m_cycles;
    }
    /// Returns true if kind or number of cycles differ.
    friend constexpr bool operator!=(QPlcOverrunPolicy a, QPlcOverrunPolicy b) { return !(a == b); }

private:
    constexpr QPlcOverrunPolicy(Kind kind, int cycles)
        : m_kind(kind)
        , m_cycles(cycles)
    {
    }
    Kind m_kind = SkipToGrid;
    int m_cycles = 0;
};

Q_DECLARE_METATYPE(QPlcOverrunPolicy)
