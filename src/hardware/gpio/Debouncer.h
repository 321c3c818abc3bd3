// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QtGlobal>

namespace qplc {

/// Takes the bounces out of an input: a level counts when it has stayed for a period, from its
/// first instant on. Knows no clock.
class Debouncer
{
public:
    /// \param period  [ns]; 0: every level counts at once
    explicit Debouncer(qint64 period = 0)
        : m_period(period)
    {
    }

    /// Forgets everything; the next level counts at once, and is no edge.
    void reset() { m_isKnown = false; }

    /// The input had this level at \a time [ns]. A time before that of the last call counts as
    /// that.
    /// \return whether isOn() has changed: look at edgeTime()
    bool feed(bool isOn, qint64 time)
    {
        if (!m_isKnown) {
            m_isKnown = true;
            m_isOn = m_newest = isOn;
            m_since = m_last = time;
            return false;
        }
        m_last = qMax(m_last, time);
        bool hasChanged = settle();
        if (isOn != m_newest) {
            m_newest = isOn;
            m_since = m_last;
            hasChanged = (m_period == 0 && settle()) || hasChanged;
        }
        return hasChanged;
    }

    bool isKnown() const { return m_isKnown; }
    bool isOn() const { return m_isOn; }
    /// When isOn() took its value: the first instant of that level [ns].
    qint64 edgeTime() const { return m_edge; }

private:
    bool settle()
    {
        if (m_newest == m_isOn || m_last - m_since < m_period)
            return false;
        m_isOn = m_newest;
        m_edge = m_since;
        return true;
    }

    qint64 m_period;  // [ns]
    bool m_isKnown = false;
    bool m_isOn = false;
    bool m_newest = false;  // level, bounces included
    qint64 m_since = 0;     // of m_newest [ns]
    qint64 m_last = 0;      // [ns]
    qint64 m_edge = 0;      // [ns]
};

}  // namespace qplc
