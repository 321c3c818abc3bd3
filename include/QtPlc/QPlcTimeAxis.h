// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtCore/QObject>

#include <algorithm>
#include <optional>

/// A time axis: which piece of time is shown, live or frozen, with two cursors and the pointer of the mouse.
///
/// All plots, gauges, 3D views and tables of a window share one: QPlcPanelContext::timeAxis(). A chart that
/// has a time of its own, as one with a trigger, makes another one, and tells it the newest time.
///
/// ```cpp
/// void Chart::wheelEvent(QWheelEvent *event)
/// {
///     context()->timeAxis()->zoom(event->angleDelta().y() > 0 ? 0.8 : 1.25, timeAt(event->position().x()));
/// }
/// ```
/// A live axis ends with the newest values. When a person zooms or pans, the axis freezes; the data go on, and
/// goLive() comes back to the newest ones. Each plant has a clock of its own, which may run ahead (lockstep):
/// QPlcPanelContext::end() is where the live axis of one panel ends.
///
/// Times are in nanoseconds since 1970, on the clock of the plant.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcTimeAxis : public QObject
{
    Q_OBJECT
public:
    using Time = qint64;  ///< [ns] since 1970
    enum Cursor { A, B };

    static constexpr Time shortestSpan = 100'000;                ///< 0.1 ms
    static constexpr Time longestSpan = 24 * 3'600'000'000'000;  ///< one day
    static constexpr Time defaultSpan = 30'000'000'000;          ///< 30 s

    using QObject::QObject;

    /// Whether the axis follows the newest values.
    bool isLive() const { return m_isLive; }
    /// Returns the right end; of a live axis newest().
    Time end() const { return m_isLive ? m_newest : m_end; }
    /// Returns the left end.
    Time begin() const { return end() - m_span; }
    /// Returns end() - begin().
    Time span() const { return m_span; }
    /// Returns the time of the newest values; 0: there are none.
    Time newest() const { return m_newest; }
    /// Returns by how much a frozen axis is behind the newest values [ns]; 0 when it is live, or ahead of them.
    Time behind() const { return std::max<Time>(m_newest - end(), 0); }

    /// Sets the span. The right end stays, and a live axis stays live.
    /// \param span  [ns], within shortestSpan and longestSpan: others become the nearest of these
    void setSpan(Time span);
    /// Shows a range, and freezes.
    void show(Time begin, Time end);
    /// Zooms, while \a about stays where it is. A live axis that is zoomed about its right end stays live.
    /// \param factor  below 1: shows less
    void zoom(double factor, Time about);
    /// Moves the range, and freezes.
    void pan(Time by);
    /// Stops following the newest values.
    void freeze();
    /// Follows the newest values again, and forgets the pointer.
    void goLive();
    /// Shows a time in the middle, and freezes.
    void jumpTo(Time time);

    /// Returns a cursor; none: a person has set none.
    std::optional<Time> cursor(Cursor which) const { return m_cursors[which]; }
    /// Sets a cursor, or removes it.
    void setCursor(Cursor which, std::optional<Time> time);
    /// Returns the time under the mouse, in any plot that shares the axis.
    std::optional<Time> pointer() const { return m_pointer; }
    /// Sets the time under the mouse; none: the mouse is elsewhere.
    void setPointer(std::optional<Time> time);
    /// Returns the time whose values gauges and tables show: the pointer of a frozen axis, without one its right
    /// end, but no time that is still to come. None: now.
    std::optional<Time> displayTime() const;

    /// Sets the time of the newest values. The window does it for the shared axis, a chart for its own.
    /// \param time  may go back when values are gone
    void setNewest(Time time);

Q_SIGNALS:
    /// Emitted when begin, end, span or isLive() changes; of a live axis not for each new value.
    void viewChanged();
    /// Emitted when a cursor changes.
    void cursorsChanged();
    /// Emitted when the pointer changes.
    void pointerChanged();
    /// Emitted when displayTime() changes.
    void displayTimeChanged();

private:
    void change(bool isLive, Time end, Time span);

    bool m_isLive = true;
    Time m_newest = 0;
    Time m_end = 0;
    Time m_span = defaultSpan;
    std::optional<Time> m_cursors[2];
    std::optional<Time> m_pointer;
};
