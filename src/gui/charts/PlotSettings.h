// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RunSettings.h"
#include "gui/panel/PanelSettings.h"

#include <QtCore/QMap>
#include <QtCore/QString>
#include <QtCore/QVector>
#include <QtGui/QColor>

#include <optional>

namespace qplc {

/// One curve of a time plot: gain * signal + offset. A value type.
struct PlotCurveSettings
{
    enum Axis { Left, Right };

    QString signal;  // a reference, or a formula
    QString name;    // shown in place of text(); empty: none
    double gain = 1.0;
    double offset = 0.0;
    QColor color;              // invalid: by place, from the theme
    std::optional<Axis> axis;  // side that a person has chosen; empty: by unit, see PlotAxes
    bool isVisible = true;
    bool isBands = false;  // states as coloured bands in place of a line
    QJsonObject others;    // keys that nobody knows

    bool isScaled() const { return gain != 1.0 || offset != 0.0; }
    /// The name; without one what is drawn: "kite.elevation", "0.001*tetherForce+5", "mean(power,
    /// 5)", "2*(a + b)".
    QString text() const;

    static PlotCurveSettings fromJson(const QJsonObject &json);
    QJsonObject toJson() const;
};

/// The range of a y axis; what is not there follows the curves.
struct PlotRangeSettings
{
    std::optional<double> minimum;
    std::optional<double> maximum;
    QVector<double> lines{};  // across the plot, for reference

    /// Both ends are given, and are a range.
    bool isFixed() const { return minimum && maximum && *minimum < *maximum; }
};

/// What makes a time plot what it is, and its JSON. A value type.
///
/// What has its default is not written, and what is not there has its default: settings that were
/// written are read as the same, byte by byte.
///
/// ```json
/// {"curves": [{"signal": "kite.elevation", "name": "Elevation", "gain": 2, "offset": -1,
///              "color": "#d55e00", "axis": "right", "visible": false, "bands": true}],
///  "left": {"minimum": 0, "maximum": 90, "lines": [60, 75]}, "right": {},
///  "axes": {"N": {"minimum": 0}}, "time": "own", "span": 10, "labels": "seconds", "grid": false,
///  "limits": true, "legend": false, "statistics": false,
///  "trigger": {"on": true, "signal": "kite.elevation", "level": 30, "mode": "normal"},
///  "runs": {"on": true, "plants": ["flight2"]}}
/// ```
struct PlotSettings
{
    enum class Labels { Clock, Seconds };

    static constexpr double defaultSpan = 30.0;  // [s]

    QVector<PlotCurveSettings> curves;
    PlotRangeSettings left;
    PlotRangeSettings right;
    QMap<QString, PlotRangeSettings> axes;  // further ones, by unit
    bool hasOwnTime = false;
    double span = defaultSpan;  // of an own time axis [s]
    Labels labels = Labels::Clock;
    bool hasGrid = true;
    std::optional<bool> limits;  // lines at the limits of the table; not chosen: showsLimits()
    bool hasLegend = true;
    bool hasStatistics = true;  // between cursors A and B, when both are there
    QJsonObject trigger;        // as TriggerBar has it, and "on"
    RunSettings runs;           // that lie over each other; not with a trigger

    /// As chosen; else where there is one line, whose limits nobody takes for those of another one.
    bool showsLimits() const;
    bool hasTrigger() const;
    void setTriggerOn(bool isOn);

    /// Of axis 0, 1, or a further one that has \a unit.
    PlotRangeSettings range(int axis, const QString &unit) const;
    PlotRangeSettings &range(int axis, const QString &unit);
    /// What it shows in a few words: "power, tetherLength"; empty without curves.
    QString contentText() const;
    /// The place of a curve of this signal; -1: there is none.
    int indexOf(const QString &signal) const;
    /// Adds a curve of this signal unless there is one. \return its place
    int add(const QString &signal);
    /// Whether an axis has lines for reference.
    bool hasLines() const;
    void removeLines();

    static PlotSettings fromJson(const QJsonObject &json);
    QJsonObject toJson() const;
    /// With the keys above.
    static PanelSettings emptyJson();
};

}  // namespace qplc
