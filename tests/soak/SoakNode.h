// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "History.h"
#include "NodeOptions.h"
#include "SoakPlant.h"

#include <atomic>

namespace soak {

/// A node of the soak's plant. It writes its group, moves a drive as its neighbour says, and keeps
/// a history of both.
class SoakNode : public QPlcCompactSlaveNode
{
public:
    SoakNode(const NodeOptions &options, HistoryWriter &history);
    ~SoakNode() override { disconnectFromMaster(); }

private:
    void reset() override;
    void step(const QPlcCycle &cycle) override;
    void stopped() override;
    void safeState(SafeStateReason reason) override;
    void recordPhase();

    const NodeOptions m_options;
    HistoryWriter &m_history;
    Group<QPlcOutput> m_written;
    Group<QPlcInput> m_seen;
    QPlcInput<double> m_limit{this, "limit"};
    quint32 m_counter = 0;
    std::atomic<bool> m_isPhaseRecorded{false};
};

}  // namespace soak
