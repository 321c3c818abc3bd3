// SPDX-License-Identifier: Apache-2.0
#include "CursorStatistics.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

double scaled(const CursorStatistics::Scaling &scaling, float value)
{
    return scaling.gain * double(value) + scaling.offset;
}

}  // namespace

void CursorStatistics::set(const SignalStore *store, int channel, const Scaling &scaling, Time first, Time second)
{
    const Time from = std::min(first, second);
    const Time to = std::max(first, second);
    const bool isSame
        = store == m_store && channel == m_channel && scaling == m_scaling && from == m_first && to == m_second;
    if (!isSame) {
        reset();
        m_store = store;
        m_channel = channel;
        m_scaling = scaling;
        m_first = from;
        m_second = to;
        m_row = store ? store->rowAt(from) : 0;
    }
    m_end = store ? std::max(store->rowAt(to + 1), m_row) : 0;
}

bool CursorStatistics::advance(int mostRows)
{
    if (m_store && m_row < m_store->firstRow()) {  // overwritten before they were looked at
        m_row = std::min(m_store->firstRow(), m_end);
        m_last = NAN;
    }
    const Row until = std::min(m_end, m_row + Row(mostRows));
    for (; m_row < until; ++m_row)
        take(m_row);
    return isComplete();
}

void CursorStatistics::take(Row row)
{
    const double value = scaled(m_scaling, m_store->value(m_channel, row));
    const Time time = m_store->time(row);
    if (!std::isnan(m_last) && !std::isnan(value) && !m_store->beginsAnew(row)) {
        const double height = m_scaling.isStepped ? m_last : 0.5 * (m_last + value);
        m_integral += height * double(time - m_lastTime) * 1e-9;
    }
    m_last = value;
    m_lastTime = time;
    if (std::isnan(value))
        return;
    if (m_count == 0) {
        m_shift = value;
        m_minimum = m_maximum = value;
    }
    ++m_count;
    m_sum += value - m_shift;
    m_squares += (value - m_shift) * (value - m_shift);
    m_minimum = std::min(m_minimum, value);
    m_maximum = std::max(m_maximum, value);
}

CursorStatistics::Result CursorStatistics::result() const
{
    if (m_count == 0)
        return {0, NAN, NAN, NAN, NAN, NAN, NAN};
    const double count = double(m_count);
    const double shiftedMean = m_sum / count;
    const double mean = m_shift + shiftedMean;
    const double variance = std::max(m_squares / count - shiftedMean * shiftedMean, 0.0);
    return {m_count, m_minimum, m_maximum, mean, std::sqrt(mean * mean + variance), std::sqrt(variance), m_integral};
}

double CursorStatistics::valueAt(const SignalStore &store, int channel, const Scaling &scaling, Time time)
{
    const std::optional<Row> row = store.rowHoldingAt(time);
    return row ? scaled(scaling, store.value(channel, *row)) : NAN;
}

}  // namespace qplc
