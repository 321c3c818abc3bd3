// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPast.h"

namespace qplc {

class SignalStore;
struct CurveSource;

/// The rows of a past for what draws them. They live as long as the past.
///
/// QPlcPast reads the same rows, for panels of users. What draws curves here is older than it, and
/// works on any SignalStore, also one without a window: benchmarks and tests fill their own.
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
