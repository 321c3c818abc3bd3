// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CurveSources.h"
#include "QPlcPast.h"

namespace qplc {

/// The rows of a past for what draws them. They live as long as the past.
struct PastRows
{
    const SignalStore *store = nullptr;  // null: there are none
    int channel = -1;

    static PastRows of(const QPlcPast &past);
    /// The way in: what a window has found.
    static QPlcPast past(const CurveSource &source);
};

}  // namespace qplc
