// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

namespace qplc {

/// How many of the cycles a listener hears: the first one of each turn. Turns are equally long, and
/// the first one begins with cycle 0 of the phase. A value type.
class ListeningInterval
{
public:
    static constexpr int Longest = 1'000'000;  // [cycles]

    constexpr ListeningInterval() = default;
    /// \param cycles  of a turn, 1 ... Longest
    constexpr explicit ListeningInterval(int cycles)
        : m_cycles(quint64(cycles))
    {
    }

    constexpr int cycles() const noexcept { return int(m_cycles); }
    constexpr bool isEveryCycle() const noexcept { return m_cycles == 1; }
    /// The turn of a cycle; both count from 0 in each phase.
    constexpr quint64 turn(quint64 cycle) const noexcept { return isEveryCycle() ? cycle : cycle / m_cycles; }
    /// Turns between two cycles that were heard one after the other, of which nothing was heard.
    constexpr quint64 missed(quint64 last, quint64 next) const noexcept
    {
        return turn(next) > turn(last) + 1 ? turn(next) - turn(last) - 1 : 0;
    }

private:
    quint64 m_cycles = 1;
};

}  // namespace qplc
