// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonArray>
#include <QtCore/QVector>

namespace tools {

/// When a cycle came to a listener.
struct Arrival
{
    quint64 cycle;
    qint64 time;  // [ns]
};

/// What is to be said of a row of arrivals: rate, intervals between cycles that follow each other,
/// and the cycles in between that never came.
class RateStatistics
{
public:
    /// A cycle that is not newer than the last one begins everything anew: the plant was started
    /// again.
    void add(const Arrival &arrival);

    quint64 cycles() const { return m_cycles; }
    quint64 lost() const { return m_lost; }
    double duration() const { return double(m_last.time - m_first.time) * 1e-9; }  // [s]
    /// Cycles per second, heard or not [Hz]; 0 with less than two.
    double rate() const;
    quint64 intervals() const { return m_intervals; }
    double mean() const { return m_mean; }  // [ns]
    double minimum() const { return m_minimum; }
    double maximum() const { return m_maximum; }
    double deviation() const;  // of a sample [ns]

    /// The lost cycles: "17, 120-125"; "..." at the end when there are more gaps.
    QString gapsText() const;
    /// The lost cycles as pairs of first and last; at most as many as gapsText() names.
    QJsonArray gaps() const;

    static constexpr int mostGaps = 20;

private:
    void addInterval(double interval);

    struct Gap
    {
        quint64 first, last;
    };
    Arrival m_first{};
    Arrival m_last{};
    quint64 m_cycles = 0;
    quint64 m_lost = 0;
    QVector<Gap> m_gaps;
    bool m_hasMoreGaps = false;
    quint64 m_intervals = 0;
    double m_mean = 0.0, m_minimum = 0.0, m_maximum = 0.0;
    double m_squares = 0.0;  // of the deviations from the mean
};

}  // namespace tools
