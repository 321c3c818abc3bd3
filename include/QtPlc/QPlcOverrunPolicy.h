// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What a master does after an *overrun*: the next cycle can begin only a whole period or more after its nominal time, because the cycle before took too
/// long or the machine did something else.
///
/// ```cpp
/// master.setOverrunPolicy(QPlcOverrunPolicy::catchUp(3));
/// ```
///
/// | policy | cycles lost | numbers | phase of the grid | use it when |
/// |---|---|---|---|---|
/// | `skipToGrid()` (default) | those whose period is over | jump | stays | the newest values count: most controllers |
/// | `catchUp(n)` | those beyond n | jump beyond n | stays | every step counts: integrators, recorders, state machines |
/// | `shift()` | none | in order | moves by the lateness | the distance between two steps counts more than the time of day |
/// | `stop()` | none | end | - | an overrun means that something is broken: test benches |
///
/// A cycle that is late by less than a period is no overrun: it runs at once, whatever the policy, and its lateness is recorded. In lockstep there is no
/// overrun. A value type.
class QTPLC_EXPORT QPlcOverrunPolicy
{
public:
    enum Kind : quint8 {
        SkipToGrid,  ///< cycles whose period is over are left out and counted: the number of a cycle tells its time
        CatchUp,  ///< missed cycles run immediately one after the other, at most n in a row; the oldest of those beyond are left out and counted
        Shift,    ///< the grid moves, so that the late cycle is on it again; the time moved is counted
        Stop      ///< the real-time phase ends with QPlcMasterNode::RealTimeError; the late cycle is not computed
    };

    static constexpr int MaximumCatchUp = 1'000'000;

    static constexpr QPlcOverrunPolicy skipToGrid() { return QPlcOverrunPolicy(SkipToGrid, 0); }
    /// \param cycles  most missed cycles that run in a row, 1 ... MaximumCatchUp
    static constexpr QPlcOverrunPolicy catchUp(int cycles) { return QPlcOverrunPolicy(CatchUp, cycles); }
    static constexpr QPlcOverrunPolicy shift() { return QPlcOverrunPolicy(Shift, 0); }
    static constexpr QPlcOverrunPolicy stop() { return QPlcOverrunPolicy(Stop, 0); }

    constexpr QPlcOverrunPolicy() = default;
    constexpr Kind kind() const { return m_kind; }
    /// Most missed cycles that run in a row; 0 unless CatchUp.
    constexpr int catchUpCycles() const { return m_cycles; }
    constexpr bool isValid() const { return m_kind != CatchUp || (m_cycles >= 1 && m_cycles <= MaximumCatchUp); }

    /// Reads "skip", "catch-up:N", "shift" or "stop", as command lines say it.
    /// \param error  if given: what is wrong and the remedy, empty when all is well
    /// \return skipToGrid() when \a text is none of these
    static QPlcOverrunPolicy fromString(const QString &text, QString *error = nullptr);
    /// "skip", "catch-up:3", "shift", "stop".
    QString toString() const;

    friend constexpr bool operator==(QPlcOverrunPolicy a, QPlcOverrunPolicy b)
    {
        return a.m_kind == b.m_kind && a.m_cycles == b.m_cycles;
    }
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
