// SPDX-License-Identifier: Apache-2.0
#include "GaugeSettings.h"

namespace qplc {

namespace {

constexpr GaugeStyle styles[] = {GaugeStyle::Dial, GaugeStyle::Bar, GaugeStyle::Number, GaugeStyle::Led};

std::optional<double> number(const QJsonValue &value)
{
    return value.isDouble() ? std::optional<double>(value.toDouble()) : std::nullopt;
}

}  // namespace

QString styleText(GaugeStyle style)
{
    switch (style) {
    case GaugeStyle::Dial:
        return QStringLiteral("dial");
    case GaugeStyle::Bar:
        return QStringLiteral("bar");
    case GaugeStyle::Number:
        return QStringLiteral("number");
    case GaugeStyle::Led:
        return QStringLiteral("led");
    }
    return {};
}

PanelSettings GaugeSettings::emptyJson()
{
    return {"signal",     "style",       "minimum",   "maximum",    "alarmLow",
            "warningLow", "warningHigh", "alarmHigh", "hysteresis", "extremes"};
}

GaugeSettings GaugeSettings::from(const PanelSettings &json)
{
    GaugeSettings settings;
    settings.signal = json.value("signal").toString();
    for (const GaugeStyle style : styles) {
        if (json.value("style").toString() == styleText(style))
            settings.style = style;
    }
    settings.minimum = number(json.value("minimum"));
    settings.maximum = number(json.value("maximum"));
    settings.limits.alarmLow = number(json.value("alarmLow"));
    settings.limits.warningLow = number(json.value("warningLow"));
    settings.limits.warningHigh = number(json.value("warningHigh"));
    settings.limits.alarmHigh = number(json.value("alarmHigh"));
    settings.hysteresis = number(json.value("hysteresis"));
    settings.showsExtremes = json.value("extremes").toBool();
    return settings;
}

}  // namespace qplc
