// SPDX-License-Identifier: Apache-2.0
#include "GaugePicture.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

bool isSameNumber(const GaugePicture &picture, double a, double b)
{
    constexpr double pixels = 2000.0;  // of the longest scale that is drawn
    if (std::isnan(a) || std::isnan(b))
        return std::isnan(a) && std::isnan(b);
    switch (picture.style) {
    case GaugeStyle::Dial:
    case GaugeStyle::Bar:
        return std::abs(picture.scale.share(a) - picture.scale.share(b)) < 1.0 / pixels;
    case GaugeStyle::Led:
        return (a != 0.0) == (b != 0.0);
    case GaugeStyle::Number:
        break;
    }
    return true;
}

bool areSameValues(const GaugePicture &a, const GaugePicture &b)
{
    return std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                      [&a](const GaugePicture::Value &one, const GaugePicture::Value &other) {
                          return isSameNumber(a, one.number, other.number) && one.text == other.text
                              && one.minimum == other.minimum && one.maximum == other.maximum;
                      });
}

bool isSame(const GaugePicture::Band &a, const GaugePicture::Band &b)
{
    return a.begin == b.begin && a.end == b.end && a.level == b.level;
}

}  // namespace

bool looksLike(const GaugePicture &a, const GaugePicture &b)
{
    const bool haveSameBands
        = std::equal(a.bands.begin(), a.bands.end(), b.bands.begin(), b.bands.end(),
                     [](const GaugePicture::Band &one, const GaugePicture::Band &other) { return isSame(one, other); });
    return a.style == b.style && a.message == b.message && a.name == b.name && a.showsName == b.showsName
        && a.prefix.unit() == b.prefix.unit() && a.widestUnit == b.widestUnit && a.isSteady == b.isSteady
        && a.status == b.status && a.widest == b.widest && a.sizing == b.sizing && a.scale == b.scale
        && a.decimals == b.decimals && a.level == b.level && a.isTrusted == b.isTrusted && a.isBoolean == b.isBoolean
        && haveSameBands && areSameValues(a, b);
}

QString GaugePicture::text(double number) const
{
    constexpr int steadyDigits = 4;
    const double shown = prefix.shown(number);
    if (!isSteady || !std::isfinite(shown))
        return gaugeNumber(shown, decimals);
    return steadyNumberText(shown, steadyDigits).replace(QLatin1Char('-'), minusSign);
}

QString GaugePicture::tickText(double tick) const
{
    return gaugeNumber(prefix.shown(tick), GaugeScale{0.0, prefix.shown(scale.span()) * 100.0}.decimals());
}

QString GaugePicture::spoken() const
{
    if (!message.isEmpty())
        return message;
    QStringList words{name};
    for (const Value &value : values)
        words << value.text;
    words << prefix.unit() << status;
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
