// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ViolationWatch.h"
#include "gui/panel/Theme.h"
#include "gui/plant/Plant.h"

namespace qplc {

/// How something is: what is normal is grey, and no tone stands without words.
enum class Tone { Calm, Good, Warning, Alarm };

QColor colorOf(const Theme &theme, Tone tone);

/// The link of this window to its master: "link 164 µs, 2 lost". \param roundTrip [ns] \param lost
/// frames of this phase
QString linkText(double roundTrip, quint64 lost);

/// A plant in two lines for people.
struct PlantSummary
{
    Tone tone;
    QString condition;   // "live", "at rest", "lost; next attempt in 3 s"
    QString figures;     // "100 Hz · jitter 41 µs p99 · 0 violations · link 0.12 ms", or why there is no connection
    QString violations;  // the part of the figures that tells of violations, when there were some in the last 10 s

    static PlantSummary of(const Plant &plant, const ViolationWatch &violations = {});
};

/// Where a master is on its way Off -> Initialized -> Real time.
struct StateStep
{
    enum Step { None = -1, Off, Initialized, RealTime };

    Step step = None;
    Tone tone = Tone::Calm;
    QString text;  // of the step, where it says more than its name: "Waiting for late nodes"

    static StateStep of(const Plant *plant, bool isInitialized);
    static QString name(Step step);
};

}  // namespace qplc
