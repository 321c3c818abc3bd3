// SPDX-License-Identifier: Apache-2.0
#include "PlantStatus.h"

#include "node/Logging.h"
#include "protocol/messages/Texts.h"

#include <algorithm>

namespace qplc {

namespace {

template<typename Answer>
Answer fitToBeShown(Answer answer)
{
    messages::changeTexts(&answer, [](QString *text) { *text = printable(*text); });
    return answer;
}

}  // namespace

const NodeStatus *PlantStatus::node(const QString &name) const
{
    const auto found
        = std::find_if(nodes.begin(), nodes.end(), [&](const NodeStatus &node) { return node.info.name == name; });
    return found == nodes.end() ? nullptr : &*found;
}

const messages::EvictedEntry *PlantStatus::evicted(const QString &name) const
{
    const auto found = std::find_if(master.evicted.begin(), master.evicted.end(),
                                    [&](const messages::EvictedEntry &entry) { return entry.name == name; });
    return found == master.evicted.end() ? nullptr : &*found;
}

void PlantStatus::handleState(const messages::State &answer)
{
    const bool wasRunning = isRunning();
    master = fitToBeShown(answer);
    QVector<NodeStatus> now;
    for (const QPlcNodeInfo &info : qAsConst(master.nodes)) {
        const NodeStatus *before = node(info.name);
        NodeStatus status = before ? *before : NodeStatus();
        status.info = info;
        now.append(status);
    }
    master.nodes.clear();
    nodes.swap(now);
    if (isRunning() && !wasRunning)
        gone.clear();  // a phase that begins has all of its nodes
    missNodes(now);
}

void PlantStatus::missNodes(const QVector<NodeStatus> &before)
{
    for (const NodeStatus &other : before) {
        if (!other.info.listener && !gone.contains(other.info.name))
            gone.append(other.info.name);
    }
    gone.erase(std::remove_if(gone.begin(), gone.end(), [this](const QString &name) { return node(name) != nullptr; }),
               gone.end());
}

void PlantStatus::handleStatistics(const messages::Statistics &answer)
{
    const quint64 overrunsBefore = statistics.overruns;
    statistics = messages::statisticsOf(answer.master);
    isOverrunning = isCounted && statistics.overruns > overrunsBefore;
    for (const messages::NodeMeasures &measures : answer.nodes) {
        const QString name = printable(measures.name);
        const auto known
            = std::find_if(nodes.begin(), nodes.end(), [&](const NodeStatus &node) { return node.info.name == name; });
        if (known == nodes.end())
            continue;  // the next State tells of it
        const quint64 lateBefore = known->statistics.late;
        known->statistics = messages::statisticsOf(measures);
        known->isLate = isCounted && known->statistics.late > lateBefore;
    }
    isCounted = true;
}

void PlantStatus::handleSchedule(const messages::Schedule &answer)
{
    schedule = fitToBeShown(answer);
}

}  // namespace qplc
