// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "AlarmState.h"
#include "gui/panel/PanelSettings.h"

namespace qplc {

enum class GaugeStyle { Dial, Bar, Number, Led };

/// "dial", "bar", "number", "led".
QString styleText(GaugeStyle style);

/// What a gauge is told, read from its JSON. A value type.
struct GaugeSettings
{
    QString signal;  // reference
    GaugeStyle style = GaugeStyle::Dial;
    std::optional<double> minimum;  // of the scale; without: of the table
    std::optional<double> maximum;
    AlarmLimits limits;
    std::optional<double> hysteresis;  // without: a hundredth of the scale
    bool showsExtremes = false;

    /// The keys, and nothing else.
    static PanelSettings emptyJson();
    static GaugeSettings from(const PanelSettings &json);
};

}  // namespace qplc
