// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/SignalStore.h"

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>

#include <optional>
#include <vector>

namespace qplc {

/// Finds events in a channel as an oscilloscope does, and the piece of time to show for them:
/// [event - pre, event + post].
///
/// ```cpp
/// m_trigger.setSettings(settings);
/// m_trigger.arm();
/// ...
/// m_trigger.take(*source.store, source.channel);     // after each update of the plant
/// if (const auto view = m_trigger.view())
///     timeAxis->show(view->begin, view->end);
/// ```
///
/// An event is where the line through the rows meets the level. None is seen across interruptions
/// and NaN. All events are counted but those within the hold-off after one; the view stays with the
/// event that it shows until all of it has come.
class Trigger
{
public:
    using Time = SignalStore::Time;  // [ns]

    enum Kind {
        RisingEdge,   // from below level - hysteresis to level or above
        FallingEdge,  // from above level + hysteresis to level or below
        EitherEdge,
        AboveLevel,    // level or above, also when it was before
        BelowLevel,    // level or below, also when it was before
        EntersWindow,  // from outside, by more than the hysteresis, into level ... upperLevel
        LeavesWindow   // from inside, by more than the hysteresis, out of it
    };
    enum Mode {
        Auto,    // without events for a time, shows what is live
        Normal,  // shows the last event until the next one
        Single   // shows one event, and waits for arm()
    };
    enum State {
        Armed,        // waits for an event
        Triggered,    // an event has come, and not yet all of its view
        FreeRunning,  // Auto, and no event for some time
        Done          // Single, and all of the view has come
    };

    struct Settings
    {
        Kind kind = RisingEdge;
        double level = 0.0;
        double upperLevel = 1.0;  // of windows
        double hysteresis = 0.0;  // >= 0
        Mode mode = Auto;
        double preShare = 0.2;  // of the view before the event, 0 ... 1
        double holdOff = 0.0;   // [s], after an event

        /// One, or the two of a window.
        std::vector<double> levels() const;
        bool operator==(const Settings &other) const;
        bool operator!=(const Settings &other) const { return !(*this == other); }
        /// For layouts; defaults are left out.
        QJsonObject toJson() const;
        /// Numbers that make no sense become the next ones that do.
        static Settings fromJson(const QJsonObject &object);
        /// All that toJson() may have.
        static QStringList keys();
    };
    struct View
    {
        Time begin;
        Time end;
    };

    static constexpr std::size_t mostEvents = 1000;

    const Settings &settings() const { return m_settings; }
    /// Events so far stay; what comes is looked at with these.
    void setSettings(const Settings &settings);
    /// Length of the view [ns], > 0.
    void setSpan(Time span) { m_span = span; }
    /// Forgets events and view, and waits for the next event among rows that come from now on.
    void arm();

    /// Looks at the rows that are new since the last call. The store may change only together with
    /// arm().
    /// \return whether there were events, or state() is another one
    bool take(const SignalStore &store, int channel);

    State state() const { return m_state; }
    /// Of events since arm().
    std::uint64_t count() const { return m_count; }
    /// Times of the last events, at most mostEvents, oldest first.
    const std::vector<Time> &events() const { return m_events; }
    /// The time of the event that is shown.
    std::optional<Time> shownEvent() const { return m_shown; }
    /// What to show; nothing: what is live (FreeRunning), or what was there before (Armed, before
    /// the first event).
    std::optional<View> view() const;

private:
    struct Row
    {
        Time time;
        double value;
    };

    void look(Row row);
    std::optional<double> crossedLevel(double value);
    void addEvent(Time time);
    void passTime(Time now);
    Time timeOfLevel(Row row, double level) const;
    Time pre() const;
    bool isInside(double value, double margin) const;
    double borderTowards(double value) const;
    Time freeRunAfter() const;

    Settings m_settings;
    Time m_span = 1'000'000'000;
    State m_state = Armed;
    std::uint64_t m_count = 0;
    std::vector<Time> m_events;
    std::optional<Time> m_shown;
    std::optional<SignalStore::Row> m_next;  // none: arm() was just called
    std::optional<Row> m_last;
    std::optional<Time> m_waitsSince;
    // Whether the value has been far enough away since the last event, for what begins there.
    bool m_wasBelow = false;
    bool m_wasAbove = false;
    bool m_wasOutside = false;
    bool m_wasInside = false;
};

}  // namespace qplc
