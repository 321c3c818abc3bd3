// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace tools {

/// What a campaign measures once.
struct CampaignCase
{
    QString transport;                   // "udp", "tcp" or "local"
    std::chrono::nanoseconds period{0};  // of the cycle
    bool isRealTime = false;             // SCHED_FIFO, and locked memory
    QString load;                        // name of the load that runs beside it; empty: none
};

/// What is the same in all cases of a campaign.
struct CampaignSettings
{
    std::chrono::seconds duration{60};  // of each case
    int nodes = 3;
    int priority = 49;         // of the cycles that are real time
    std::optional<int> cpu{};  // of the cycle of the master

    /// What the cycle of the master asks of the system.
    QPlcRealTimeOptions optionsOfMaster(bool isRealTime) const;
    /// What the cycles of the nodes ask of it.
    QPlcRealTimeOptions optionsOfNodes(bool isRealTime) const;
};

/// A master and its nodes in this process, over the sockets of this computer. Each has a cycle
/// thread of its own, as in a plant of several programs.
class CampaignPlant
{
public:
    CampaignPlant();
    ~CampaignPlant();

    /// Connects the nodes, and runs cycles for a second, which load all that cycles need. Runs an
    /// event loop. \return false when they do not run, or this program is told to end
    bool prepare(const CampaignCase &of, const CampaignSettings &settings, QString *error);
    /// Starts the cycles that are measured. \pre prepare() was true
    bool start(QString *error);
    /// Whether cycles run.
    bool isRunning() const { return m_master.state() == QPlcMasterNode::RealTime; }
    /// What has been measured since start().
    QPlcCycleStatistics statistics() const { return m_master.cycleStatistics(QPlcDistribution::WithBins); }
    /// What the system has granted to the cycle of the master.
    QVector<QPlcRealTimeSetting> realTimeSettings() const { return m_master.realTimeSettings(); }

private:
    class Node;

    bool admitNodes(const CampaignCase &of, const CampaignSettings &settings, QString *error);

    QPlcMasterNode m_master;
    std::vector<std::unique_ptr<Node>> m_nodes;
};

}  // namespace tools
