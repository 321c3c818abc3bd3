// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Gates.h"

#include <QtCore/QJsonObject>

namespace soak {

/// What came out of a run, for people and for programs.
struct SoakReport
{
    QString profile;
    quint64 seed = 0;
    int seconds = 0;
    QString error;  // why the run ended early; empty: it did not
    QString folder;
    Evidence evidence;
    std::vector<Gate> gates;

    /// Of the time; a machine that stands still for more is no measure of deadlines.
    static constexpr double MostStalls = 0.05;

    enum Verdict {
        Passed,
        Failed,
        /// values, commands and attempts passed; a gate of time did not, on a machine that stood
        /// still for too long
        Unjudged
    };
    Verdict verdict() const;
    bool passed() const { return verdict() == Passed; }
    /// The command that does the same again.
    QString command() const;
    QJsonObject toJson() const;
    QString toText() const;
};

}  // namespace soak
