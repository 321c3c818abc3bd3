// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "formulas/FormulaCalculator.h"
#include "gui/store/SignalStore.h"

namespace qplc {

/// A formula as one channel of a store of its own, which follows the store of a plant: a row for
/// each of its rows, with the same times and interruptions, and as many of them.
///
/// The past is calculated once, when somebody wants to see it, then each new row as it comes; the
/// results are the same. At interruptions of more than 0.5 s everything with a past begins anew;
/// the integral goes on over cycles that were lost, without their time. What is no number (0/0), or
/// none that a 32-bit real can hold, is a gap.
class DerivedSignal
{
public:
    /// \param channels in the store that it follows: those of each operand of the formula, one, or
    ///         all elements of a norm
    /// \param source    what it will follow()
    DerivedSignal(const Formula &formula, std::vector<std::vector<int>> channels, const SignalStore &source);

    SignalStore &store() { return m_store; }
    /// Takes new rows of \a source, always the same store. \param most  rows
    /// \return whether all have been taken
    bool follow(const SignalStore &source, SignalStore::Row most);
    /// Whether the result depends on rows before: it has a derivative(), integral(), mean() or
    /// lowpass().
    bool hasPast() const { return m_hasPast; }
    /// The result for values that are in no row, as of a plant at rest. \param channels one value
    /// for each channel of the source
    /// \pre !hasPast()
    double resultOf(const std::vector<float> &channels);

private:
    void catchUp(const SignalStore &source);
    void takeRow(const SignalStore &source, SignalStore::Row row);
    SignalStore::Mark markOf(const SignalStore &source, SignalStore::Row row) const;
    template<typename ValueOf>
    void takeOperands(ValueOf valueOf);

    FormulaCalculator m_calculator;
    std::vector<std::vector<int>> m_channels;
    std::vector<bool> m_isNorm;
    bool m_hasPast;
    std::vector<double> m_operands;
    SignalStore m_store;
    SignalStore::Row m_next = 0;  // of the source
};

}  // namespace qplc
