// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPast.h"

namespace qplc {

class SignalStore;
struct CurveSource;

/// The store and the channel behind a past. They live as long as the past.
///
/// Curves, statistics and triggers read a SignalStore, not a QPlcPast: they need what panels of
/// users do without (values as their writer gave them, the next interruption, a guess where to
/// search), and tests and benchmarks fill stores of their own.
struct PastRows
{
    const SignalStore *store = nullptr;  // null: there are none
    int channel = -1;

    static PastRows of(const QPlcPast &past);
    static QPlcPast past(std::shared_ptr<const SignalStore> store, int channel);
    /// The way in: what a window has found.
    static QPlcPast past(const CurveSource &source);
};

}  // namespace qplc
