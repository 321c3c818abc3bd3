// SPDX-License-Identifier: Apache-2.0
#include "BenchPlant.h"

#include <algorithm>
#include <chrono>

namespace {

QByteArray signalName(const char *direction, int slave, int number)
{
    return direction + QByteArray::number(slave) + '.' + QByteArray::number(number);
}

qint64 monotonicNow()
{
    return std::chrono::steady_clock::now().time_since_epoch().count();
}

}  // namespace

QPlcSignalTable benchTable(const BenchOptions &options)
{
    const QByteArray rest = "]\ntype = Real32\nhold = 1000000\n"
        + (options.description > 0 ? "description = " + QByteArray(options.description, 'd') + '\n' : QByteArray());
    QByteArray ini;
    for (int slave = 0; slave < options.slaves; ++slave) {
        for (int i = 0; i < options.inputs; ++i)
            ini += '[' + signalName("in", slave, i) + rest;
        for (int i = 0; i < options.outputs; ++i)
            ini += '[' + signalName("out", slave, i) + rest;
    }
    return QPlcSignalTable::fromIni(ini);
}

// ---- slave ----

BenchSlave::BenchSlave(const BenchOptions &options, int index)
    : QPlcCompactSlaveNode(nameOf(index), SilentZeroOrderHold)
{
    for (int i = 0; i < options.inputs; ++i)
        m_in.emplace_back(this, signalName("in", index, i).constData());
    for (int i = 0; i < options.outputs; ++i)
        m_out.emplace_back(this, signalName("out", index, i).constData());
}

void BenchSlave::step(const QPlcCycle &)
{
    const std::size_t inputs = m_in.size();
    for (std::size_t k = 0; k < m_out.size(); ++k)
        m_out[k] = m_in[k % inputs] + float(k);
}

// ---- probe ----

BenchProbe::BenchProbe(const BenchOptions &options)
    : QPlcCompactSlaveNode(QStringLiteral("Probe"), SilentZeroOrderHold)
    , m_options(options)
{
    for (int slave = 0; slave < options.slaves; ++slave) {
        for (int i = 0; i < options.inputs; ++i)
            m_requests.emplace_back(this, signalName("in", slave, i).constData());
        m_answers.emplace_back(this, signalName("out", slave, 0).constData());
        if (options.outputs > 1)
            m_answers.emplace_back(this, signalName("out", slave, options.outputs - 1).constData());
    }
    constexpr double mostCycles = 2e6;  // per second
    constexpr double mostIntervals = 5e7;
    constexpr double reserve = 1.1;  // the end comes by another clock
    if (options.isBackToBack())
        m_intervals.reserve(std::size_t(std::min(options.seconds * mostCycles, mostIntervals)));
    else
        m_offsets.reserve(std::size_t(reserve * options.seconds * 1e6 / options.periodUs) + 100);
}

float BenchProbe::inputValue(quint64 cycle, int slave, int k)
{
    return 1.0F + float(cycle & 1023) + float(slave) + 0.5F * float(k);
}

void BenchProbe::step(const QPlcCycle &cycle)
{
    const qint64 now = monotonicNow();
    if (m_measuring.load(std::memory_order_relaxed)) {
        record(cycle, now);
        check(cycle.number());
    }
    auto request = m_requests.begin();
    for (int slave = 0; slave < m_options.slaves; ++slave) {
        for (int k = 0; k < m_options.inputs; ++k)
            *request++ = inputValue(cycle.number(), slave, k);
    }
}

void BenchProbe::record(const QPlcCycle &cycle, qint64 now)
{
    if (m_lastStep != 0 && m_intervals.size() < m_intervals.capacity())
        m_intervals.push_back(now - m_lastStep);
    m_lastStep = now;
    if (m_offsets.size() < m_offsets.capacity())
        m_offsets.push_back(now - qint64(cycle.number()) * m_options.periodUs * 1000);
}

qint64 BenchProbe::drift() const
{
    const auto tenth = std::ptrdiff_t(m_offsets.size() / 10);
    if (tenth < 2)
        return 0;
    const auto median = [](std::vector<qint64> values) {
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return median({m_offsets.end() - tenth, m_offsets.end()}) - median({m_offsets.begin(), m_offsets.begin() + tenth});
}

/// What comes back was written two cycles ago: one to reach the slave, one to come back. With a
/// period an answer may be late, and then of an older cycle, but never a mixture of two cycles.
void BenchProbe::check(quint64 cycle)
{
    const int last = m_options.outputs - 1;
    const int lastInput = last % m_options.inputs;
    auto answer = m_answers.begin();
    for (int slave = 0; slave < m_options.slaves; ++slave) {
        const float first = *answer++;
        const float expected = m_options.isBackToBack() ? inputValue(cycle - 2, slave, 0) : first;
        bool good = first == expected && first > 0.0F;
        if (last > 0)
            good = good && *answer++ == expected + 0.5F * float(lastInput) + float(last);
        m_errors += good ? 0 : 1;
    }
}
