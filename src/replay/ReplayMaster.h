// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeHistory.h"
#include "QPlcMasterNode.h"
#include "node/cycle/MasterCycle.h"

#include <chrono>
#include <functional>
#include <memory>

namespace qplc {

/// A master that serves one node the inputs of a recording. Its clock is turned by step(), as fast
/// as the node answers, so the node cannot tell how fast time passed in the flight.
///
/// For the thread that has made it, but for what is marked.
class ReplayMaster
{
public:
    ReplayMaster(const RingDescription &description, const QPlcSignalTable &table);
    ~ReplayMaster();

    /// Where a node of another process finds it; empty: it cannot listen.
    QString listen(QString *error);
    /// Takes a node of this process. \param node  outlives this object
    bool add(QPlcSlaveNode *node, QString *error);
    /// Waits for a node. \param isHopeless  is asked again and again
    bool waitForNode(std::chrono::milliseconds longest, const std::function<bool()> &isHopeless);
    /// The node that has registered; null: none.
    const NodeSlot *node() const { return m_slot.get(); }
    /// Gives the node its initial inputs and begins the phase.
    bool start(const NodePassage &passage, std::chrono::milliseconds longest, QString *error);
    void stop();

    /// One cycle of the node. In any thread, between start() and stop(). \threadsafe yes
    MasterCycle::Step step(std::uint64_t number, const QByteArray &inputs) noexcept;
    /// What the node has answered to the last step. As step().
    const char *outputs() const;

private:
    bool waitFor(const std::function<bool()> &isReached, std::chrono::milliseconds longest);

    QPlcMasterNode m_master;
    std::shared_ptr<NodeSlot> m_slot;
    std::vector<CopyRun> m_toImage;  // inputs -> image
};

}  // namespace qplc
