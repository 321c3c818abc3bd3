// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <memory>

namespace qplc {

/// A run minus the one that it lies over, in the rows of that one (the reference): a store of one
/// channel, filled some rows at a time.
///
/// Between two rows of the run, its value is on the line through them, or, where it is stepped,
/// that of the earlier row. With the same period and a shift of whole periods nothing is
/// interpolated. No value: one of the two has none there, or an interruption is between the two
/// rows of the run.
///
/// ```cpp
/// RunDifference difference({&store, 0}, {&other, 3, shift, begin, end}, false, 100'000);
/// while (!difference.advance(20'000)) ...
/// draw(difference.store());
/// ```
class RunDifference
{
public:
    using Time = SignalStore::Time;
    using Row = SignalStore::Row;

    struct Reference
    {
        const SignalStore *store;  // outlives this object
        int channel;
    };
    struct Run
    {
        const SignalStore *store;  // outlives this object
        int channel;
        Time shift;  // from its times to those of the reference [ns]
        Time begin;  // only its rows from here on
        Time end;    // to before here
    };

    /// \param isStepped  the run holds each value until the next one
    /// \param mostRows  that are kept: the newest ones, >= 16
    RunDifference(const Reference &reference, const Run &run, bool isStepped, int mostRows);

    /// Calculates at most so many rows. \return whether all are there that both have so far
    bool advance(int mostRows);
    const std::shared_ptr<SignalStore> &store() const { return m_store; }
    /// Whether there are older rows that are not kept.
    bool isCut() const { return m_isCut; }

private:
    float runAt(Time time);

    Reference m_reference;
    Run m_run;
    bool m_isStepped;
    std::shared_ptr<SignalStore> m_store;
    Row m_next;
    Row m_guess;  // of the run
    bool m_isCut = false;
};

}  // namespace qplc
