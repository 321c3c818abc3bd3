// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GpioLine.h"

#include <QtCore/QStringList>

namespace qplc {

/// What a configuration says about a line: `17, active-low, pull-up, debounce 5 ms, edges rising`.
struct GpioLineWords
{
    enum Edges : quint8 { Rising = 1, Falling = 2, Both = Rising | Falling };

    GpioLineRequest request;
    qint64 debounce = 0;  // [ns] inputs
    Edges edges = Both;   // inputs: which are counted
    bool isKept = false;  // outputs: not given its safe value

    /// \return an empty text, or what is wrong with \a words, and what would be right
    static QString read(const QStringList &words, bool isOutput, GpioLineWords *result);
};

}  // namespace qplc
