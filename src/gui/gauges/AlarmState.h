// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace qplc {

/// From where on a value is worth a look, or wrong. A value type.
struct AlarmLimits
{
    std::optional<double> alarmLow;
    std::optional<double> warningLow;
    std::optional<double> warningHigh;
    std::optional<double> alarmHigh;
    double hysteresis = 0.0;  // how far a value has to come back before a state ends, >= 0

    bool isEmpty() const { return !alarmLow && !warningLow && !warningHigh && !alarmHigh; }
    friend bool operator==(const AlarmLimits &a, const AlarmLimits &b)
    {
        return a.alarmLow == b.alarmLow && a.warningLow == b.warningLow && a.warningHigh == b.warningHigh
            && a.alarmHigh == b.alarmHigh && a.hysteresis == b.hysteresis;
    }
    friend bool operator!=(const AlarmLimits &a, const AlarmLimits &b) { return !(a == b); }
};

/// Whether a value that goes on changing is normal, with hysteresis: a value that trembles about a
/// limit does not make its colour flicker.
class AlarmState
{
public:
    enum Level { Normal, Warning, Alarm };
    enum Side { None, Low, High };

    /// Begins anew with normal.
    void setLimits(const AlarmLimits &limits);
    const AlarmLimits &limits() const { return m_limits; }
    /// Takes the next value; what is no number is normal.
    void update(double value);
    Level level() const { return m_level; }
    Side side() const { return m_side; }  // None when normal

private:
    Level levelOf(double value, Side side) const;

    AlarmLimits m_limits;
    Level m_level = Normal;
    Side m_side = None;
};

}  // namespace qplc
