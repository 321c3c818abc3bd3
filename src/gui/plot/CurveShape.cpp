// SPDX-License-Identifier: Apache-2.0
#include "gui/plot/CurveShape.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

using Row = SignalStore::Row;

constexpr Row fewestRowsOfColumn = 2;          // below: single rows
constexpr std::int64_t farthestX = 1'000'000;  // [px]: so far away the direction of a line is the same

/// Rows of a view, and of its left and right edge.
struct Rows
{
    Row begin;
    Row end;
    bool isEmpty() const { return begin >= end; }
};

Rows rowsOf(const SignalStore &store, const TimeColumns &columns)
{
    return {store.rowAt(columns.beginOf(columns.first())), store.rowAt(columns.beginOf(columns.end()))};
}

bool hasManyRows(const SignalStore &store, const TimeColumns &columns, const Rows &rows)
{
    if (rows.isEmpty())
        return false;
    const std::int64_t used = columns.columnOf(store.time(rows.end - 1)) - columns.columnOf(store.time(rows.begin)) + 1;
    return rows.end - rows.begin >= fewestRowsOfColumn * Row(used);
}

}  // namespace

void CurveShape::read(const SignalStore &store, int channel, const TimeColumns &columns, Row least, Row most)
{
    m_points.clear();
    m_points.reserve(std::size_t(fewestRowsOfColumn) * std::size_t(columns.count()) + 4);
    least = std::max(least, store.firstRow());
    most = std::min(most, store.endRow());
    Rows inside = rowsOf(store, columns);
    inside = {std::max(inside.begin, least), std::min(inside.end, most)};
    m_isDense = hasManyRows(store, columns, inside);
    const Row end = std::min(inside.end + 1, most);
    Row begin = inside.begin > least ? inside.begin - 1 : inside.begin;
    m_hasMarks = begin < end && store.greatestMark(channel, begin, end) != RowMarks::None;
    while (begin < end) {
        const Row next = store.nextBeginAnew(begin + 1, end);
        m_isInterrupted = true;
        m_isDense ? readColumns(store, channel, columns, begin, next) : readRows(store, channel, columns, begin, next);
        begin = next;
    }
}

void CurveShape::readRows(const SignalStore &store, int channel, const TimeColumns &columns, Row begin, Row end)
{
    for (Row row = begin; row < end; ++row) {
        const float value = store.value(channel, row);
        add(columns.columnOf(store.time(row)) - columns.first(), value, value, {value, value},
            markOf(store, channel, row, row + 1));
    }
}

void CurveShape::readColumns(const SignalStore &store, int channel, const TimeColumns &columns, Row begin, Row end)
{
    Row guess = begin;
    for (Row row = begin; row < end;) {
        const std::int64_t column = columns.columnOf(store.time(row));
        const Row next = std::min(store.rowAt(columns.beginOf(column + 1), guess), end);
        add(column - columns.first(), store.value(channel, row), store.value(channel, next - 1),
            store.range(channel, row, next), markOf(store, channel, row, next));
        guess = std::min(next + (next - row), end);
        store.prefetch(channel, guess);
        row = next;
    }
}

void CurveShape::add(std::int64_t x, float first, float last, SignalStore::Range range, SignalStore::Mark mark)
{
    if (!range.isEmpty()) {
        const bool isJoined = !m_isInterrupted && !std::isnan(first);
        m_points.push_back(
            {int(std::clamp(x, -farthestX, farthestX)), isJoined, first, last, range.minimum, range.maximum, mark});
    }
    m_isInterrupted = std::isnan(last);
}

}  // namespace qplc
