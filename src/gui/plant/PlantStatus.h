// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/State.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// One node of a plant, as its master sees it.
struct NodeStatus
{
    QPlcNodeInfo info;
    QPlcNodeStatistics statistics;
    bool isLate = false;  // there were late answers since the statistics before

    /// As of the master: whether it is SafeStop or Fault.
    bool isLatched() const { return messages::isLatched(messages::stateNamed(info.state)); }
};

/// A master and its nodes, put together of its answers State, Statistics and Schedule. A value
/// type.
///
/// What people are to read is fit to be shown: see printable().
struct PlantStatus
{
    messages::State master;          // as it answers; what it says of its nodes is in `nodes`
    QPlcCycleStatistics statistics;  // likewise
    bool isCounted = false;          // the statistics have come: what they show more from now on is new
    bool isOverrunning = false;      // there were overruns since the statistics before
    QVector<NodeStatus> nodes;
    QStringList gone;  // nodes of the newest phase which have left and are not back; listeners come and go as they like
    QPlcSchedule schedule;

    /// Whether cycles run, or stand still for a moment; safe ones, too.
    bool isRunning() const { return messages::hasCycles(master.state); }
    /// Whether it is SafeStop or Fault: nothing moves until it is reset.
    bool isLatched() const { return messages::isLatched(master.state); }
    const NodeStatus *node(const QString &name) const;
    /// Null: this name is not evicted.
    const messages::EvictedEntry *evicted(const QString &name) const;

    /// Figures of nodes that were there before stay.
    void handleState(const messages::State &answer);
    void handleStatistics(const messages::Statistics &answer);
    void handleSchedule(const messages::Schedule &answer);

private:
    void missNodes(const QVector<NodeStatus> &before);
};

}  // namespace qplc
