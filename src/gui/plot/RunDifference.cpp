// SPDX-License-Identifier: Apache-2.0
#include "RunDifference.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

/// Moves a time that may be the smallest or the largest one.
RunDifference::Time moved(RunDifference::Time time, RunDifference::Time shift)
{
    RunDifference::Time sum = 0;
    if (__builtin_add_overflow(time, shift, &sum))
        return time;
    return sum;
}

}  // namespace

RunDifference::RunDifference(const Reference &reference, const Run &run, bool isStepped, int mostRows)
    : m_reference(reference)
    , m_run(run)
    , m_isStepped(isStepped)
    , m_next(reference.store->rowAt(moved(run.begin, run.shift)))
    , m_guess(run.store->firstRow())
{
    const Row end = reference.store->rowAt(moved(run.end, run.shift));
    const Row rows = std::max(end, m_next) - m_next;
    m_isCut = rows > Row(mostRows);
    if (m_isCut)
        m_next = end - Row(mostRows);
    const bool goesOn = end == reference.store->endRow();
    const Row capacity = goesOn ? std::max(rows, Row(reference.store->capacity())) : rows;
    m_store = std::make_shared<SignalStore>(1, int(std::clamp<Row>(capacity, 16, Row(mostRows))));
}

bool RunDifference::advance(int mostRows)
{
    const SignalStore &reference = *m_reference.store;
    m_next = std::max(m_next, reference.firstRow());
    const Time newestOfRun = m_run.store->newestTime();
    for (int i = 0; i < mostRows; ++i, ++m_next) {
        if (m_next >= reference.endRow())
            return true;
        const Time time = reference.time(m_next) - m_run.shift;
        if (time >= m_run.end || m_run.store->isEmpty() || time > newestOfRun)
            return true;
        if (reference.beginsAnew(m_next))
            m_store->interrupt();
        const float difference = runAt(time) - reference.value(m_reference.channel, m_next);
        m_store->append(reference.time(m_next), &difference);
    }
    return false;
}

/// \param time  of the run
float RunDifference::runAt(Time time)
{
    const SignalStore &run = *m_run.store;
    const Row row = run.rowAt(time, std::clamp(m_guess, run.firstRow(), run.endRow()));
    m_guess = row;
    if (row >= run.endRow() || time < m_run.begin)
        return NAN;
    if (run.time(row) == time)
        return run.value(m_run.channel, row);
    if (row == run.firstRow() || run.beginsAnew(row))
        return NAN;
    const float before = run.value(m_run.channel, row - 1);
    if (m_isStepped)
        return before;
    const double share = double(time - run.time(row - 1)) / double(run.time(row) - run.time(row - 1));
    return float(double(before) + share * (double(run.value(m_run.channel, row)) - double(before)));
}

}  // namespace qplc
