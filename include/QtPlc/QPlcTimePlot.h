// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// Signals over time, as a panel of a Control Center: live, zoomed, frozen, measured between two cursors, and exported.
///
/// A curve is gain * signal + offset. Each unit has its own y axis: the first one at the left, others at the right, unless "axis" chooses the side. Integers and booleans are steps; NaN and interruptions are gaps. Signals that are not there are kept, and drawn as soon as they are.
///
/// | | mouse | keys |
/// |---|---|---|
/// | zoom the time, about the mouse | wheel, two fingers | `+`, `-` |
/// | zoom the values | Ctrl+wheel, or the wheel over a y axis | `Ctrl++`, `Ctrl+-` |
/// | pan | drag; over a y axis: the values | arrow keys |
/// | zoom into a box | drag with Shift or the right button | |
/// | everything, y axes automatic again | double click | `A` |
/// | live | button "12 s behind" | `L`; `Space` freezes and goes live |
/// | cursors A and B, of all plots | drag; context menu | `1`, `2`; `0` removes them; `Ctrl+Left`, `Ctrl+Right` move the last one |
/// | statistics between A and B | fold by the arrow | `S` |
/// | add a signal | drop | `Insert`; `+` while there is none |
/// | choose, hide, remove a curve | click in the legend hides; context menu | `N`, `Shift+N`; `V`; `Delete` |
/// | the other side for the axis of a curve | context menu of the curve | `Y` |
/// | reference line, with its value; none | context menu | `R`; `Shift+R` |
/// | trigger on and off | context menu | `T` |
/// | export what is seen | context menu | `Ctrl+E` CSV, `Ctrl+C` table into the clipboard, `Ctrl+Shift+E` PNG, SVG or PDF, `Ctrl+Shift+C` picture into the clipboard |
/// | export what is between A and B | context menu | `Ctrl+Alt+E` CSV, `Ctrl+Alt+C` table into the clipboard |
///
/// Zoom and freeze are a view, and no settings: data go on, whatever is looked at. The time axis is that of the window, or its own.
///
/// Triggered, a plot works as an oscilloscope does: it has a time axis of its own, in ms around the event, with the wanted share before it, and the rest of the window stays live. "linked" shows the event in all plots
/// of the window instead. Lines are at the event and at the level. Zooming chooses how much of the next event is seen; who pans keeps what he sees until the next event.
///
/// Settings, each with its default when it is not there, whatever it was before:
/// ```json
/// {"curves": [{"signal": "kite.elevation", "name": "Elevation", "gain": 1, "offset": 0, "color": "#d55e00", "axis": "right", "visible": false}],
///  "left": {"minimum": 0, "maximum": 90, "lines": [60, 75]}, "right": {}, "axes": {"N": {"minimum": 0}}, "time": "own", "span": 10, "labels": "seconds", "grid": false, "limits": true,
///  "legend": false, "statistics": false,
///  "trigger": {"on": true, "signal": "kite.elevation", "kind": "rising", "level": 30, "upperLevel": 1, "hysteresis": 0, "mode": "normal", "pre": 0.2, "holdOff": 0, "linked": false}}
/// ```
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcTimePlot : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Time plot"); }

    explicit QPlcTimePlot(QWidget *parent = nullptr);
    ~QPlcTimePlot() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// A curve for each signal, for each element of an array of at most 16; those that have one already get none. \return false for texts, times, and nothing at all
    bool addSignals(const QStringList &references) override;

    /// Pictures that have been drawn so far: for tests and measurements.
    int drawnPictures() const;

private:
    class Private;
    std::unique_ptr<Private> d;
};
using QPlcTimePlotFactory = QPlcWidgetFactoryOf<QPlcTimePlot>;
