// SPDX-License-Identifier: Apache-2.0
#include "RateStatistics.h"

#include <cmath>

namespace tools {

void RateStatistics::add(const Arrival &arrival)
{
    if (m_cycles > 0 && arrival.cycle <= m_last.cycle)
        *this = RateStatistics();
    if (m_cycles++ == 0) {
        m_first = arrival;
    } else if (arrival.cycle == m_last.cycle + 1) {
        addInterval(double(arrival.time - m_last.time));
    } else {
        m_lost += arrival.cycle - m_last.cycle - 1;
        if (m_gaps.size() == mostGaps)
            m_hasMoreGaps = true;
        else
            m_gaps.append({m_last.cycle + 1, arrival.cycle - 1});
    }
    m_last = arrival;
}

/// Mean and squares grow step by step: the difference of large sums would lose its digits.
void RateStatistics::addInterval(double interval)
{
    m_minimum = m_intervals == 0 ? interval : std::fmin(m_minimum, interval);
    m_maximum = std::fmax(m_maximum, interval);
    const double before = interval - m_mean;
    m_mean += before / double(++m_intervals);
    m_squares += before * (interval - m_mean);
}

double RateStatistics::rate() const
{
    return duration() > 0.0 ? double(m_cycles - 1 + m_lost) / duration() : 0.0;
}

double RateStatistics::deviation() const
{
    return m_intervals > 1 ? std::sqrt(m_squares / double(m_intervals - 1)) : 0.0;
}

QString RateStatistics::gapsText() const
{
    QStringList texts;
    for (const Gap &gap : m_gaps)
        texts << (gap.first == gap.last ? QString::number(gap.first)
                                        : QStringLiteral("%1-%2").arg(gap.first).arg(gap.last));
    if (m_hasMoreGaps)
        texts << QStringLiteral("...");
    return texts.join(QStringLiteral(", "));
}

QJsonArray RateStatistics::gaps() const
{
    QJsonArray array;
    for (const Gap &gap : m_gaps)
        array.append(QJsonArray{double(gap.first), double(gap.last)});
    return array;
}

}  // namespace tools
