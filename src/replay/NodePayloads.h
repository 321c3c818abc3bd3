// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recording/RecordedCycles.h"

namespace qplc {

/// The inputs and outputs of a node in the cycles of a recording, byte by byte as they travelled.
class NodePayloads
{
public:
    /// \pre the indices of \a node are those of \a image, and occur once: isPossible()
    NodePayloads(const ProcessImage &image, const RosterNode &node, const QVector<QPlcSignalIndex> &ownSignals);
    static bool isPossible(const RosterNode &node);

    /// Its number in the cycle of \a row: another one after each connection.
    std::uint16_t idIn(const RecordedRow &row) const;
    const PayloadLayout &inputLayout() const { return m_inputs; }
    const PayloadLayout &outputLayout() const { return m_outputs; }
    /// What the node was sent, or would have been sent, in the cycle of \a row. \return false when
    /// the recording does not have it: cycles are missing
    bool inputs(const RecordedRow &row, QByteArray *payload) const;
    /// Values of the outputs, without qualities, that were stored in the cycle of \a row. \return
    /// false when none were stored, or the recording does not show them
    bool outputs(const RecordedRow &row, QByteArray *values) const;

private:
    QString m_name;
    std::uint16_t m_id;  // of its first connection
    PayloadLayout m_inputs;
    PayloadLayout m_outputs;
    std::vector<CopyRun> m_all;
    std::vector<CopyRun> m_own;        // written by the master in each cycle
    std::vector<CopyRun> m_sameCycle;  // read in the same cycle
    std::vector<CopyRun> m_written;    // image -> outputs
};

}  // namespace qplc
