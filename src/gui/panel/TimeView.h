// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QObject>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace qplc {

/// The time that a window shows: one time axis, two cursors and one pointer for all of its plots, gauges, 3D views and tables.
///
/// Live, the axis ends with the newest values. Whoever zooms or pans freezes the view, never the data: goLive() comes back to the newest ones. Times are those of the rows of the stores. Each plant has a clock of
/// its own, which may run ahead (lockstep): a live plot ends with the newest values of its own plants, and whoever freezes it there freezes all of the window at that time.
///
/// Threads: that of the window.
class TimeView : public QObject
{
    Q_OBJECT
public:
    using Time = std::int64_t;  // [ns] since 1970
    enum Cursor { A, B };

    static constexpr Time shortestSpan = 100'000;                // 0.1 ms
    static constexpr Time longestSpan = 24 * 3'600'000'000'000;  // a day
    static constexpr Time defaultSpan = 30'000'000'000;

    using QObject::QObject;

    bool isLive() const { return m_isLive; }
    /// Right edge. Live: newest().
    Time end() const { return m_isLive ? m_newest : m_end; }
    Time begin() const { return end() - m_span; }
    Time span() const { return m_span; }
    /// Time of the newest values of all plants that are there; 0: there are none.
    Time newest() const { return m_newest; }
    /// How far a frozen view is behind [ns]; 0 when live, or when what it shows is still to come.
    Time behind() const { return std::max<Time>(m_newest - end(), 0); }

    /// Keeps the right edge, also when live. Spans beyond the shortest and longest one are taken as those.
    void setSpan(Time span);
    /// Shows just this, and freezes.
    void show(Time begin, Time end);
    /// Zooms about a time that stays where it is. Live views about their right edge stay live. \param factor  < 1: shows less
    void zoom(double factor, Time about);
    /// Moves the view, and freezes.
    void pan(Time by);
    void freeze();
    /// And forgets the pointer.
    void goLive();
    /// Shows a time in the middle, and freezes.
    void jumpTo(Time time);

    std::optional<Time> cursor(Cursor which) const { return m_cursors[which]; }
    void setCursor(Cursor which, std::optional<Time> time);
    /// Where the mouse is, in any plot.
    std::optional<Time> pointer() const { return m_pointer; }
    void setPointer(std::optional<Time> time);
    /// The time whose values are to be seen in gauges and 3D views: the pointer in a frozen view, its right edge without one, but no time that is still to come; empty: now.
    std::optional<Time> displayTime() const;

    /// The way in for the newest time, which goes back when values are gone.
    void setNewest(Time time);

Q_SIGNALS:
    /// Begin, end, span, or live or not; while live not for each new value.
    void viewChanged();
    void cursorsChanged();
    void pointerChanged();
    /// displayTime() is another one, or there is none any more.
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

}  // namespace qplc
