// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BenchOptions.h"

#include <atomic>
#include <deque>
#include <vector>

/// The signals of all slaves: "in7.2" is the third input of slave 7, "out7.0" its first output.
QPlcSignalTable benchTable(const BenchOptions &options);

/// A slave: output k = input (k modulo number of inputs) + k.
class BenchSlave : public QPlcCompactSlaveNode
{
public:
    BenchSlave(const BenchOptions &options, int index);
    static QString nameOf(int index) { return QStringLiteral("Slave%1").arg(index); }

private:
    void step(const QPlcCycle &cycle) override;

    std::deque<QPlcInput<float>> m_in;
    std::deque<QPlcOutput<float>> m_out;
};

/// Lives in the process of the master: writes the inputs of all slaves, new ones in each cycle,
/// checks their answers, and takes the time.
class BenchProbe : public QPlcCompactSlaveNode
{
public:
    explicit BenchProbe(const BenchOptions &options);

    /// From now on cycles count. \pre called once
    void begin() { m_measuring = true; }
    /// Ends it: the results may be read when the phase has ended.
    void end() { m_measuring = false; }
    /// Back to back: time from cycle to cycle [ns], of all that counted.
    const std::vector<qint64> &intervals() const { return m_intervals; }
    /// With a period: what t_k - k * period grows by from the first to the last tenth of the cycles
    /// that counted, by the medians [ns]. Measured by the clock of the machine and not by what the
    /// master says. 0 for less than 20 cycles.
    qint64 drift() const;
    /// Answers that were not what they should be.
    quint64 errors() const { return m_errors; }

private:
    void step(const QPlcCycle &cycle) override;
    void record(const QPlcCycle &cycle, qint64 now);
    void check(quint64 cycle);
    static float inputValue(quint64 cycle, int slave, int k);

    const BenchOptions &m_options;
    std::deque<QPlcOutput<float>> m_requests;  // all inputs of slave 0, of slave 1, ...
    std::deque<QPlcInput<float>> m_answers;    // first and last output of slave 0, of slave 1, ...
    std::atomic<bool> m_measuring{false};
    std::vector<qint64> m_intervals;
    std::vector<qint64> m_offsets;  // t_k - k * period
    qint64 m_lastStep = 0;
    quint64 m_errors = 0;
};
