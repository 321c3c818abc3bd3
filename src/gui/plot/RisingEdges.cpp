// SPDX-License-Identifier: Apache-2.0
#include "RisingEdges.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr RisingEdges::Row rowsOfLook = 512;  // a bin of the store

}  // namespace

RisingEdges::RisingEdges(const SignalStore *store, int channel, double level, int count, Time apart)
    : m_store(store)
    , m_channel(channel)
    , m_level(level)
    , m_count(std::size_t(std::clamp(count, 1, Most)))
    , m_apart(apart)
{
}

bool RisingEdges::update()
{
    const std::deque<Time> before = m_times;
    if (m_next < m_store->firstRow()) {
        m_next = m_store->firstRow();
        m_isBelow = false;
    }
    while (m_next < m_store->endRow()) {
        const Row end = std::min((m_next / rowsOfLook + 1) * rowsOfLook, m_store->endRow());
        if (isSame(m_next, end)) {
            m_isBelow = double(m_store->value(m_channel, end - 1)) < m_level;
            m_next = end;
        }
        for (; m_next < end; ++m_next)
            look(m_next);
    }
    while (!m_times.empty() && (m_store->isEmpty() || m_times.front() < m_store->time(m_store->firstRow())))
        m_times.pop_front();
    return m_times != before;
}

/// Whether there is no edge in these rows: all are below, or, after a row that is not below, at or
/// above the level.
bool RisingEdges::isSame(Row begin, Row end) const
{
    const SignalStore::Range range = m_store->range(m_channel, begin, end);
    return range.isEmpty() || double(range.maximum) < m_level || (!m_isBelow && double(range.minimum) >= m_level);
}

void RisingEdges::look(Row row)
{
    const double value = double(m_store->value(m_channel, row));
    const bool isAbove = value >= m_level;
    const Time time = m_store->time(row);
    const bool isApart = m_times.empty() || time - m_times.back() >= m_apart;
    if (isAbove && m_isBelow && isApart && !m_store->beginsAnew(row)) {
        m_times.push_back(time);
        if (m_times.size() > m_count)
            m_times.pop_front();
    }
    m_isBelow = value < m_level;  // not with NaN
}

}  // namespace qplc
