// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QObject>

#include <algorithm>
#include <optional>

/// A time axis: which span of time is shown, live or frozen, with two cursors, the pointer of
/// the mouse, and the playhead of a recording.
///
/// \code
/// class Chart : public QPlcWidget
/// {
/// protected:
///     void wheelEvent(QWheelEvent *event) override
///     {
///         QPlcTimeAxis *axis = context()->timeAxis();
///         axis->zoom(event->angleDelta().y() > 0 ? 0.8 : 1.25, axis->end());
///     }
/// };
/// \endcode
///
/// All plots, gauges, 3D views and tables of a window share one: QPlcPanelContext::timeAxis(). A
/// chart with a time of its own, for example one with a trigger, makes another one and calls its
/// setNewest().
///
/// A live axis ends with the newest values. When a person zooms or pans, the axis freezes;
/// recording goes on, and goLive() returns to the newest values. Each plant has a clock of its own,
/// which may run ahead (lockstep): QPlcPanelContext::end() is the end of the live axis for one
/// panel.
///
/// Times are in nanoseconds since 1970, on the clock of the plant.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcTimeAxis : public QObject
{
    Q_OBJECT
public:
    using Time = qint64;  ///< time [ns] since 1970-01-01 UTC
    /// The two cursors.
    enum Cursor {
        A,  ///< first cursor
        B   ///< second cursor
    };

    /// Shortest span: 0.1 ms.
    static constexpr Time shortestSpan = 100'000;
    /// Longest span: 365 days.
    static constexpr Time longestSpan = 365 * 24 * 3'600'000'000'000;
    /// Span of a new axis: 30 s.
    static constexpr Time defaultSpan = 30'000'000'000;

    /// Makes a live axis with defaultSpan and without values.
    using QObject::QObject;

    /// Returns true if the axis follows the newest values.
    bool isLive() const { return m_isLive; }
    /// Returns the right end; of a live axis newest().
    Time end() const { return m_isLive ? m_newest : m_end; }
    /// Returns the left end: end() - span().
    Time begin() const { return end() - m_span; }
    /// Returns the shown span [ns].
    Time span() const { return m_span; }
    /// Returns the time of the newest values; 0: there are none.
    Time newest() const { return m_newest; }
    /// Returns by how much a frozen axis is behind the newest values [ns]; 0 if it is live, or
    /// ahead of them.
    Time behind() const { return std::max<Time>(m_newest - end(), 0); }

    /// Sets the span. The right end stays, and a live axis stays live.
    /// \param span  shortestSpan to longestSpan [ns]; a value outside becomes the nearest of these
    void setSpan(Time span);
    /// Shows a range, and freezes.
    void show(Time begin, Time end);
    /// Zooms, while \a about keeps its place. A live axis that is zoomed at its right end stays
    /// live.
    /// \param factor  less than 1 shows less; the span stays within its limits, whatever the factor
    /// \param about  time that keeps its place
    void zoom(double factor, Time about);
    /// Moves the range, and freezes.
    /// \param by  [ns]; more than 0: to later times
    void pan(Time by);
    /// Stops following the newest values.
    void freeze();
    /// Follows the newest values again, and removes the pointer.
    void goLive();
    /// Shows a time in the middle, and freezes.
    void jumpTo(Time time);

    /// Returns the time of a cursor; not set: the cursor is not shown.
    std::optional<Time> cursor(Cursor which) const { return m_cursors[which]; }
    /// Moves a cursor.
    /// \param time  not set: removes the cursor
    void setCursor(Cursor which, std::optional<Time> time);
    /// Returns the time under the mouse, in any plot that shares the axis; not set: there is none.
    std::optional<Time> pointer() const { return m_pointer; }
    /// Sets the time under the mouse.
    /// \param time  not set: the mouse is elsewhere
    void setPointer(std::optional<Time> time);
    /// Returns the time at which a recording is played, or stands; not set: none is open.
    std::optional<Time> playhead() const { return m_playhead; }
    /// Sets the time at which a recording is played, and freezes. A frozen axis moves if the time
    /// is outside of what it shows.
    /// \param time  not set: there is no playhead
    void setPlayhead(std::optional<Time> time);
    /// Returns the time whose values gauges and tables show: on a frozen axis the pointer, or
    /// without one the playhead, or without that the right end, but never later than newest(). Not
    /// set: the newest values.
    std::optional<Time> displayTime() const;

    /// Sets the time of the newest values. The window does it for the shared axis, a chart for its
    /// own one.
    /// \param time  may be earlier than before if values are gone
    void setNewest(Time time);

Q_SIGNALS:
    /// Emitted when begin, end, span or isLive() has changed; on a live axis not for each new
    /// value.
    void viewChanged();
    /// Emitted when a cursor has changed.
    void cursorsChanged();
    /// Emitted when the pointer has changed.
    void pointerChanged();
    /// Emitted when the playhead has changed.
    void playheadChanged();
    /// Emitted when displayTime() has changed.
    void displayTimeChanged();

private:
    Q_DECL_HIDDEN void change(bool isLive, Time end, Time span);

    bool m_isLive = true;
    Time m_newest = 0;
    Time m_end = 0;
    Time m_span = defaultSpan;
    std::optional<Time> m_cursors[2];
    std::optional<Time> m_pointer;
    std::optional<Time> m_playhead;
};
