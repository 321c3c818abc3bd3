// SPDX-License-Identifier: Apache-2.0
#include "DerivedSignal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace qplc {

using Row = SignalStore::Row;

namespace {

float toFloat(double value)
{
    constexpr double largest = std::numeric_limits<float>::max();
    return std::fabs(value) <= largest ? float(value) : NAN;
}

}  // namespace

DerivedSignal::DerivedSignal(const Formula &formula, std::vector<std::vector<int>> channels, const SignalStore &source)
    : m_calculator(formula)
    , m_channels(std::move(channels))
    , m_hasPast(std::any_of(formula.parts().begin(), formula.parts().end(),
                            [](const Formula::Part &part) { return part.function != Formula::Plain; }))
    , m_operands(m_channels.size())
    , m_store(1, source.capacity())
{
    for (const Formula::Operand &operand : formula.operands())
        m_isNorm.push_back(operand.isNorm);
}

bool DerivedSignal::follow(const SignalStore &source, Row most)
{
    catchUp(source);
    const Row end = m_next + std::min(most, source.endRow() - m_next);
    for (; m_next < end; ++m_next)
        takeRow(source, m_next);
    return m_next == source.endRow();
}

/// Leaves out what the source has forgotten meanwhile.
void DerivedSignal::catchUp(const SignalStore &source)
{
    if (m_next >= source.firstRow())
        return;
    m_next = source.firstRow();
    m_store.interrupt();
    m_calculator.interrupt();
}

/// \param valueOf  a channel
template<typename ValueOf>
void DerivedSignal::takeOperands(ValueOf valueOf)
{
    for (std::size_t i = 0; i < m_operands.size(); ++i) {
        double sum = 0.0;
        for (const int channel : m_channels[i]) {
            const auto value = double(valueOf(channel));
            sum += m_isNorm[i] ? value * value : value;
        }
        m_operands[i] = m_isNorm[i] ? std::sqrt(sum) : sum;
    }
}

void DerivedSignal::takeRow(const SignalStore &source, Row row)
{
    if (source.beginsAnew(row)) {
        m_store.interrupt();
        m_calculator.interrupt();
    }
    takeOperands([&](int channel) { return source.value(channel, row); });
    const float value = toFloat(m_calculator.next(source.time(row), m_operands.data()));
    if (!m_store.append(source.time(row), &value)) {
        m_store.clear();  // the clock of the source has begun again
        m_store.append(source.time(row), &value);
    }
    if (const SignalStore::Mark mark = markOf(source, row))
        m_store.mark(0, mark);
}

/// As good as the worst of what it is calculated of in this row.
SignalStore::Mark DerivedSignal::markOf(const SignalStore &source, Row row) const
{
    SignalStore::Mark worst = RowMarks::None;
    for (const std::vector<int> &channels : m_channels) {
        for (const int channel : channels)
            worst = std::max(worst, source.greatestMark(channel, row, row + 1));
    }
    return worst;
}

double DerivedSignal::resultOf(const std::vector<float> &channels)
{
    takeOperands([&](int channel) { return channels[std::size_t(channel)]; });
    return m_calculator.next(0, m_operands.data());
}

}  // namespace qplc
