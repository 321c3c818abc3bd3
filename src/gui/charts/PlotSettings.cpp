// SPDX-License-Identifier: Apache-2.0
#include "PlotSettings.h"

#include "QPlcPast.h"
#include "QPlcTimeAxis.h"

#include <QtCore/QJsonArray>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

const QString curvesKey = QStringLiteral("curves");
const QString leftKey = QStringLiteral("left");
const QString rightKey = QStringLiteral("right");
const QString axesKey = QStringLiteral("axes");
const QString timeKey = QStringLiteral("time");
const QString spanKey = QStringLiteral("span");
const QString labelsKey = QStringLiteral("labels");
const QString gridKey = QStringLiteral("grid");
const QString limitsKey = QStringLiteral("limits");
const QString legendKey = QStringLiteral("legend");
const QString statisticsKey = QStringLiteral("statistics");
const QString triggerKey = QStringLiteral("trigger");
const QString runsKey = QStringLiteral("runs");
const QString onKey = QStringLiteral("on");
const QString signalKey = QStringLiteral("signal");
const QString nameKey = QStringLiteral("name");
const QString gainKey = QStringLiteral("gain");
const QString offsetKey = QStringLiteral("offset");
const QString colorKey = QStringLiteral("color");
const QString axisKey = QStringLiteral("axis");
const QString visibleKey = QStringLiteral("visible");
const QString bandsKey = QStringLiteral("bands");
const QString minimumKey = QStringLiteral("minimum");
const QString maximumKey = QStringLiteral("maximum");
const QString linesKey = QStringLiteral("lines");

constexpr double shortestSpan = 1e-9 * double(QPlcTimeAxis::shortestSpan);  // [s]
constexpr double longestSpan = 1e-9 * double(QPlcTimeAxis::longestSpan);

template<typename T>
void insertUnless(QJsonObject *json, const QString &key, const T &value, const T &standard)
{
    if (value != standard)
        json->insert(key, value);
}

std::optional<double> numberIn(const QJsonObject &json, const QString &key)
{
    const QJsonValue value = json.value(key);
    return value.isDouble() ? std::optional<double>(value.toDouble()) : std::nullopt;
}

PlotRangeSettings rangeIn(const QJsonObject &json)
{
    PlotRangeSettings range{numberIn(json, minimumKey), numberIn(json, maximumKey), {}};
    const QJsonArray lines = json.value(linesKey).toArray();
    for (const QJsonValue &line : lines) {
        if (line.isDouble())
            range.lines.append(line.toDouble());
    }
    return range;
}

void insertRange(QJsonObject *json, const QString &key, const PlotRangeSettings &range)
{
    QJsonObject ends;
    if (range.minimum)
        ends.insert(minimumKey, *range.minimum);
    if (range.maximum)
        ends.insert(maximumKey, *range.maximum);
    QJsonArray lines;
    for (const double line : range.lines)
        lines.append(line);
    if (!lines.isEmpty())
        ends.insert(linesKey, lines);
    if (!ends.isEmpty())
        json->insert(key, ends);
}

}  // namespace

QString PlotCurveSettings::text() const
{
    if (!name.isEmpty())
        return name;
    QString text = QPlcPast::textOf(signal);
    const bool isFormula = text != signal;
    if (gain != 1.0)
        text = QString::number(gain, 'g', 10) + (isFormula ? QStringLiteral("*(%1)") : QStringLiteral("*%1")).arg(text);
    if (offset != 0.0)
        text += (offset > 0.0 ? QStringLiteral("+") : QString()) + QString::number(offset, 'g', 10);
    return text;
}

PlotCurveSettings PlotCurveSettings::fromJson(const QJsonObject &json)
{
    PlotCurveSettings curve;
    curve.others = json;
    curve.signal = curve.others.take(signalKey).toString();
    curve.name = curve.others.take(nameKey).toString();
    curve.gain = curve.others.take(gainKey).toDouble(1.0);
    curve.offset = curve.others.take(offsetKey).toDouble(0.0);
    curve.color = QColor(curve.others.take(colorKey).toString());
    const QString side = curve.others.take(axisKey).toString();
    if (side == leftKey || side == rightKey)
        curve.axis = side == leftKey ? Left : Right;
    curve.isVisible = curve.others.take(visibleKey).toBool(true);
    curve.isBands = curve.others.take(bandsKey).toBool(false);
    return curve;
}

QJsonObject PlotCurveSettings::toJson() const
{
    QJsonObject json = others;
    json.insert(signalKey, signal);
    insertUnless(&json, nameKey, name, QString());
    insertUnless(&json, gainKey, gain, 1.0);
    insertUnless(&json, offsetKey, offset, 0.0);
    if (color.isValid())
        json.insert(colorKey, color.name());
    if (axis)
        json.insert(axisKey, *axis == Left ? leftKey : rightKey);
    insertUnless(&json, visibleKey, isVisible, true);
    insertUnless(&json, bandsKey, isBands, false);
    return json;
}

PlotRangeSettings PlotSettings::range(int axis, const QString &unit) const
{
    return axis == 0 ? left : axis == 1 ? right : axes.value(unit);
}

PlotRangeSettings &PlotSettings::range(int axis, const QString &unit)
{
    return axis == 0 ? left : axis == 1 ? right : axes[unit];
}

QString PlotSettings::contentText() const
{
    constexpr int mostNames = 4;  // that are read; the legend has all
    QStringList names;
    for (const PlotCurveSettings &curve : curves.mid(0, mostNames))
        names << curve.text();
    if (curves.size() > mostNames)
        names << QStringLiteral("…");
    return names.join(QStringLiteral(", "));
}

int PlotSettings::indexOf(const QString &signal) const
{
    const auto found = std::find_if(curves.begin(), curves.end(),
                                    [&](const PlotCurveSettings &each) { return each.signal == signal; });
    return found != curves.end() ? int(found - curves.begin()) : -1;
}

int PlotSettings::add(const QString &signal)
{
    if (const int place = indexOf(signal); place >= 0)
        return place;
    PlotCurveSettings curve;
    curve.signal = signal;
    curves.append(curve);
    return curves.size() - 1;
}

bool PlotSettings::hasLines() const
{
    const auto hasSome = [](const PlotRangeSettings &range) { return !range.lines.isEmpty(); };
    return hasSome(left) || hasSome(right) || std::any_of(axes.begin(), axes.end(), hasSome);
}

void PlotSettings::removeLines()
{
    left.lines.clear();
    right.lines.clear();
    for (PlotRangeSettings &range : axes)
        range.lines.clear();
}

PlotSettings PlotSettings::fromJson(const QJsonObject &json)
{
    PlotSettings settings;
    const QJsonArray curves = json.value(curvesKey).toArray();
    for (const QJsonValue &curve : curves)
        settings.curves.append(PlotCurveSettings::fromJson(curve.toObject()));
    settings.left = rangeIn(json.value(leftKey).toObject());
    settings.right = rangeIn(json.value(rightKey).toObject());
    const QJsonObject axes = json.value(axesKey).toObject();
    for (auto axis = axes.begin(); axis != axes.end(); ++axis)
        settings.axes.insert(axis.key(), rangeIn(axis.value().toObject()));
    settings.hasOwnTime = json.value(timeKey).toString() == QLatin1String("own");
    settings.span = std::clamp(json.value(spanKey).toDouble(defaultSpan), shortestSpan, longestSpan);
    const bool isSeconds = json.value(labelsKey).toString() == QLatin1String("seconds");
    settings.labels = isSeconds ? Labels::Seconds : Labels::Clock;
    settings.hasGrid = json.value(gridKey).toBool(true);
    if (json.value(limitsKey).isBool())
        settings.limits = json.value(limitsKey).toBool();
    settings.hasLegend = json.value(legendKey).toBool(true);
    settings.hasStatistics = json.value(statisticsKey).toBool(true);
    settings.trigger = json.value(triggerKey).toObject();
    settings.runs = RunSettings::fromJson(json.value(runsKey).toObject());
    return settings;
}

bool PlotSettings::showsLimits() const
{
    const auto isLine = [](const PlotCurveSettings &each) { return !each.isBands; };
    return limits.value_or(std::count_if(curves.begin(), curves.end(), isLine) == 1);
}

bool PlotSettings::hasTrigger() const
{
    return trigger.value(onKey).toBool();
}

void PlotSettings::setTriggerOn(bool isOn)
{
    trigger.remove(onKey);
    if (isOn)
        trigger.insert(onKey, true);
}

QJsonObject PlotSettings::toJson() const
{
    QJsonObject json;
    QJsonArray all;
    for (const PlotCurveSettings &curve : curves)
        all.append(curve.toJson());
    insertUnless(&json, curvesKey, all, QJsonArray());
    insertRange(&json, leftKey, left);
    insertRange(&json, rightKey, right);
    QJsonObject further;
    for (auto axis = axes.begin(); axis != axes.end(); ++axis)
        insertRange(&further, axis.key(), axis.value());
    insertUnless(&json, axesKey, further, QJsonObject());
    if (hasOwnTime)
        json.insert(timeKey, QStringLiteral("own"));
    insertUnless(&json, spanKey, span, defaultSpan);
    if (labels == Labels::Seconds)
        json.insert(labelsKey, QStringLiteral("seconds"));
    insertUnless(&json, gridKey, hasGrid, true);
    if (limits)
        json.insert(limitsKey, *limits);
    insertUnless(&json, legendKey, hasLegend, true);
    insertUnless(&json, statisticsKey, hasStatistics, true);
    insertUnless(&json, triggerKey, trigger, QJsonObject());
    insertUnless(&json, runsKey, runs.toJson(), QJsonObject());
    return json;
}

PanelSettings PlotSettings::emptyJson()
{
    return {"curves", "left",   "right",  "axes",       "time",    "span", "labels",
            "grid",   "limits", "legend", "statistics", "trigger", "runs"};
}

}  // namespace qplc
