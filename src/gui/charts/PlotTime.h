// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTimeAxis.h"
#include "gui/plot/TimeColumns.h"

class QPlcPanelContext;

namespace qplc {

class PlotCanvas;
class PlotCurves;
class PlotInteraction;
class TriggerBar;
struct PlotSettings;

/// The time that a plot shows: that of the window or its own one, and its cursors, which are those
/// of the window. What it is made with outlives it.
class PlotTime
{
public:
    using Time = QPlcTimeAxis::Time;

    PlotTime(const QPlcPanelContext *context, const PlotSettings *settings, const TriggerBar *trigger,
             const PlotCanvas *canvas, const PlotCurves *curves, const PlotInteraction *interaction);

    QPlcTimeAxis *shared() const;
    QPlcTimeAxis *own() { return &m_own; }
    /// The one that the plot shows; a plot with a trigger has its own one, too.
    QPlcTimeAxis *view();
    /// Where it ends when it is live: with the newest values of the plants that it shows, as each
    /// has a clock of its own.
    Time newest() const;
    TimeColumns columns();
    /// At the mouse; none: it is elsewhere.
    std::optional<Time> atMouse() const;

    /// What is seen here, which ends earlier than other plots when its plant has another clock.
    void freeze();
    void toggleLive();
    void pan(Time by);
    /// About the mouse, the live edge, or the middle.
    void zoom(double factor);
    void zoom(double factor, Time about);
    void showAll();

    bool hasBothCursors() const;
    /// Goes to a row that is near enough, for only there values were measured.
    void placeCursor(QPlcTimeAxis::Cursor which, Time time);
    /// At the mouse, or at its place without one.
    void placeCursor(QPlcTimeAxis::Cursor which);
    /// The one that was placed last.
    void moveCursor(int pixels);
    void removeCursors();

private:
    Time nearestRow(Time time) const;

    const QPlcPanelContext *m_context;
    const PlotSettings *m_settings;
    const TriggerBar *m_trigger;
    const PlotCanvas *m_canvas;
    const PlotCurves *m_curves;
    const PlotInteraction *m_interaction;
    QPlcTimeAxis m_own;
    QPlcTimeAxis::Cursor m_lastCursor = QPlcTimeAxis::A;
};

}  // namespace qplc
