// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// A panel with signals over time: live, zoomed, frozen, measured between two cursors, and
/// exported.
///
/// \code
/// QPlcTimePlot plot;
/// plot.addSignals({"kite.elevation", "= mean(power, 5)"});
/// \endcode
///
/// A curve is gain * signal + offset. Each unit has a y axis of its own: the first one on the left,
/// others on the right, unless "axis" chooses the side. Integers and booleans are steps; NaN and
/// interruptions are gaps. A signal that does not exist stays in the settings, and its curve
/// appears when the signal does.
///
/// | | mouse | keys |
/// |---|---|---|
/// | zoom the time, at the mouse | wheel, two fingers | `+`, `-` |
/// | zoom the values | Ctrl+wheel, or the wheel over a y axis | `Ctrl++`, `Ctrl+-` |
/// | pan | drag; over a y axis: the values | arrow keys |
/// | zoom into a box | drag with Shift or the right button | |
/// | show everything, automatic y axes | double click | `A` |
/// | follow new values | button "12 s behind" | `L`; `Space` freezes and follows |
/// | cursors A and B, of all plots | drag; context menu | `1`, `2`; `0` removes them |
/// | move the last cursor | drag | `Ctrl+Left`, `Ctrl+Right` |
/// | statistics between A and B | arrow | `S` |
/// | add a signal | drop | `Insert`; `+` while there is none |
/// | choose, hide, remove a curve | legend; context menu | `J`, `Shift+J`; `V`; `Delete` |
/// | axis of a curve to the other side | context menu of the curve | `Y` |
/// | reference line, with its value; none | context menu | `R`; `Shift+R` |
/// | trigger on and off | context menu | `T` |
/// | export the visible part as CSV | context menu | `Ctrl+E` |
/// | copy the visible part as a table | context menu | `Ctrl+C` |
/// | export it as PNG, SVG or PDF | context menu | `Ctrl+Shift+E` |
/// | copy it as a picture | context menu | `Ctrl+Shift+C` |
/// | export the part between A and B as CSV | context menu | `Ctrl+Alt+E` |
/// | copy the part between A and B as a table | context menu | `Ctrl+Alt+C` |
///
/// Zoom and freeze are a view and not settings: recording goes on in any view. The time axis is
/// that of the window, or one of the plot.
///
/// With a trigger, the plot works like an oscilloscope. It has a time axis of its own, in ms around
/// the event, with the wanted share before it; the rest of the window stays live. With "linked" all
/// plots of the window show the event instead. Lines mark the event and the level. Zooming chooses
/// how much of the next event is shown; panning keeps the view until the next event.
///
/// Settings; a missing one has its default:
/// \code{.json}
/// {
///     "curves": [
///         {"signal": "kite.elevation", "name": "Elevation", "gain": 1, "offset": 0,
///          "color": "#d55e00", "axis": "right", "visible": false}
///     ],
///     "left": {"minimum": 0, "maximum": 90, "lines": [60, 75]}, "right": {},
///     "axes": {"N": {"minimum": 0}},
///     "time": "own", "span": 10, "labels": "seconds",
///     "grid": false, "limits": true, "legend": false, "statistics": false,
///     "trigger": {"on": true, "signal": "kite.elevation", "kind": "rising", "level": 30,
///                 "upperLevel": 1, "hysteresis": 0, "mode": "normal", "pre": 0.2, "holdOff": 0,
///                 "linked": false}
/// }
/// \endcode
/// Values and lines are in the unit of the axis, `span` and `holdOff` in s, `pre` is a share from 0
/// to 1.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcTimePlot : public QPlcWidget
{
    Q_OBJECT
public:
    /// Returns "Time plot", the name of this kind of panel in layouts.
    static QString typeName() { return QStringLiteral("Time plot"); }

    /// Makes a plot without curves.
    explicit QPlcTimePlot(QWidget *parent = nullptr);
    ~QPlcTimePlot() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Adds a curve for each signal, and for each element of an array of at most 16. A signal that
    /// has a curve already gets no other one.
    /// \return false if nothing could be added: texts, times, or an empty list
    bool addSignals(const QStringList &references) override;

    /// Returns how many pictures the plot has drawn so far: for tests and measurements.
    int drawnPictures() const;

private:
    class Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
/// The factory of this panel.
///
/// \ingroup panels
using QPlcTimePlotFactory = QPlcWidgetFactoryOf<QPlcTimePlot>;
