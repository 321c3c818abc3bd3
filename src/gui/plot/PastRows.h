// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPast.h"

namespace qplc {

class SignalStore;
struct CurveSource;

/// The rows of a past for what draws them. They live as long as the past.
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
