// SPDX-License-Identifier: Apache-2.0
#include "GaugePicture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace qplc {

namespace {

/// NaN is as good as NaN.
bool isSame(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

bool isSame(const GaugePicture::Value &a, const GaugePicture::Value &b)
{
    return isSame(a.number, b.number) && a.text == b.text && a.minimum == b.minimum && a.maximum == b.maximum;
}

bool isSame(const GaugePicture::Band &a, const GaugePicture::Band &b)
{
    return a.begin == b.begin && a.end == b.end && a.level == b.level;
}

}  // namespace

bool operator==(const GaugePicture &a, const GaugePicture &b)
{
    const auto areSame = [](const auto &x, const auto &y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                          [](const auto &one, const auto &other) { return isSame(one, other); });
    };
    return a.style == b.style && a.message == b.message && a.name == b.name && a.unit == b.unit && a.status == b.status
        && areSame(a.values, b.values) && a.widest == b.widest && a.scale == b.scale && a.decimals == b.decimals
        && areSame(a.bands, b.bands) && a.level == b.level && a.isTrusted == b.isTrusted && a.isBoolean == b.isBoolean;
}

QString GaugePicture::spoken() const
{
    if (!message.isEmpty())
        return message;
    QStringList words{name};
    for (const Value &value : values)
        words << value.text;
    words << unit << status;
    words.removeAll(QString());
    return words.join(QLatin1Char(' '));
}

QVector<GaugePicture::Band> bandsOf(const AlarmLimits &limits, const GaugeScale &scale)
{
    QVector<GaugePicture::Band> bands;
    const auto add = [&](double begin, double end, AlarmState::Level level) {
        begin = std::max(begin, scale.minimum);
        end = std::min(end, scale.maximum);
        if (begin < end)
            bands.append({begin, end, level});
    };
    if (limits.alarmLow)
        add(scale.minimum, *limits.alarmLow, AlarmState::Alarm);
    if (limits.warningLow)
        add(limits.alarmLow.value_or(scale.minimum), *limits.warningLow, AlarmState::Warning);
    if (limits.warningHigh)
        add(*limits.warningHigh, limits.alarmHigh.value_or(scale.maximum), AlarmState::Warning);
    if (limits.alarmHigh)
        add(*limits.alarmHigh, scale.maximum, AlarmState::Alarm);
    return bands;
}

}  // namespace qplc
