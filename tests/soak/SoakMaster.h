// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "NodeOptions.h"

#include <QtCore/QTimer>

#include <atomic>

namespace soak {

/// Records each cycle on the cycle thread itself.
class CycleRecorder : public QPlcCompactSlaveNode
{
public:
    explicit CycleRecorder(HistoryWriter &history);

    /// That runs, or comes next; 0: none.
    quint64 phase() const { return m_phase; }

private:
    void reset() override { ++m_phase; }
    void step(const QPlcCycle &cycle) override;

    HistoryWriter &m_history;
    std::atomic<quint64> m_phase{0};
    QPlcInput<quint32> m_counter{this, "n0.counter"};
};

/// The master of the soak's plant, with a history of every cycle, of what happens to its nodes, and
/// of its counters.
class SoakMaster : public QPlcMasterNode
{
public:
    SoakMaster(const NodeOptions &options, HistoryWriter &history);
    ~SoakMaster() override;

    bool start(std::chrono::microseconds period, const QPlcUnderlyingProtocol &place);

private:
    void recordNodes();
    void count();

    const NodeOptions m_options;
    HistoryWriter &m_history;
    CycleRecorder m_recorder;
    QTimer m_timer;
    quint64 m_phase = 0;  // whose counters there are; 0: none
};

}  // namespace soak
