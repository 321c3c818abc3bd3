// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QVector>

#include <cstdint>

namespace qplc {

/// Where a time axis has ticks, and what is written there: times of the day, or seconds before or
/// after a reference.
///
/// The reference is the live edge today; another one, the moment of a trigger, makes a view of what
/// happened around it.
class TimeTicks
{
public:
    using Time = std::int64_t;  // [ns] since 1970

    /// \param widest  labels that fit beside each other, >= 1
    TimeTicks(Time begin, Time end, int widest);
    /// The same with ticks at whole steps from \a reference, which is written as 0.
    TimeTicks(Time begin, Time end, int widest, Time reference);
    /// The same with units, ms below 10 s between ticks: for times around an event, "-200 ms", "0",
    /// "200 ms".
    static TimeTicks aroundEvent(Time begin, Time end, int widest, Time event);

    const QVector<Time> &major() const { return m_major; }
    const QVector<Time> &minor() const { return m_minor; }
    /// Between major ticks [ns]
    Time step() const { return m_step; }
    /// "12:03:15", "12:03", "12:03:15.25", "-2.5"; "27 Nov" where a day begins, if more than a day
    /// is seen.
    QString label(Time time) const;

    /// A time of the day with what is needed to tell times apart that are \a resolution [ns] from
    /// each other: "12:03:15.250".
    static QString clockText(Time time, Time resolution);

private:
    void place(Time begin, Time end, Time zero);
    static Time stepFor(Time span, int widest);

    bool m_isRelative = false;
    bool m_hasDates = false;  // more than a day is seen
    bool m_hasUnits = false;
    Time m_reference = 0;
    Time m_step = 1;
    QVector<Time> m_major;
    QVector<Time> m_minor;
};

/// 00:00 of the day, on the clock of this computer, [ns] since 1970.
std::int64_t beginOfDay(std::int64_t time);

}  // namespace qplc
