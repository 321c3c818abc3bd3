// SPDX-License-Identifier: Apache-2.0
#include "PastFilter.h"

#include <cmath>

namespace qplc {

PastFilter::PastFilter(Formula::Function function, double seconds)
    : m_function(function)
    , m_seconds(seconds)
{
}

/// After an interruption.
void PastFilter::goOnAt(Time time)
{
    m_isInterrupted = false;
    m_hasLast = false;
    if (time - m_last.time <= longestLoss)
        return;
    m_result = 0.0;
    m_window.clear();
    m_sum = 0.0;
    m_forgotten = 0;
}

double PastFilter::next(Time time, double value)
{
    if (m_isInterrupted)
        goOnAt(time);
    const Row row{time, value};
    const bool isValue = std::isfinite(value);
    double result = NAN;
    if (isValue) {
        switch (m_function) {
        case Formula::Derivative:
            result = derivative(row);
            break;
        case Formula::Integral:
            result = integral(row);
            break;
        case Formula::LowPass:
            result = lowPass(row);
            break;
        case Formula::Mean:
            result = mean(row);
            break;
        case Formula::Plain:
            result = value;
            break;
        }
    }
    m_last = row;
    m_hasLast = isValue;
    return result;
}

double PastFilter::derivative(Row row) const
{
    return m_hasLast ? (row.value - m_last.value) / secondsTo(row.time) : NAN;
}

double PastFilter::integral(Row row)
{
    if (m_hasLast)
        m_result += 0.5 * (m_last.value + row.value) * secondsTo(row.time);
    return m_result;
}

/// Exact for a value that holds since the row before.
double PastFilter::lowPass(Row row)
{
    if (!m_hasLast) {
        m_result = row.value;
        return m_result;
    }
    const double time = secondsTo(row.time);
    if (time != m_weightTime) {
        m_weightTime = time;
        m_weight = -std::expm1(-time / m_seconds);
    }
    m_result += m_weight * (row.value - m_result);
    return m_result;
}

double PastFilter::mean(Row row)
{
    forgetBefore(row.time - Time(std::llround(m_seconds * 1e9)));
    m_window.push_back(row);
    m_sum += row.value;
    return m_sum / double(m_window.size());
}

/// Forgets rows up to \a time. Now and then the sum is made anew, lest the errors of all sums and
/// differences add up.
void PastFilter::forgetBefore(Time time)
{
    while (!m_window.empty() && m_window.front().time <= time) {
        m_sum -= m_window.front().value;
        m_window.pop_front();
        ++m_forgotten;
    }
    if (m_forgotten <= m_window.size())
        return;
    m_forgotten = 0;
    m_sum = 0.0;
    for (const Row &row : m_window)
        m_sum += row.value;
}

}  // namespace qplc
