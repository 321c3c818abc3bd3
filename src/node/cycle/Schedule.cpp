// SPDX-License-Identifier: Apache-2.0
#include "Schedule.h"

#include <algorithm>

namespace qplc {

Schedule::Schedule(const std::vector<Node> &nodes)
    : m_dependents(nodes.size())
    , m_stages(nodes.size())
{
    findDependents(nodes);
    if (placeInStages() == nodes.size())
        return;
    for (std::size_t node = nodes.size(); node-- > 0 && m_loop.empty();)
        m_loop = shortestLoop(node);
}

std::size_t Schedule::writer(QPlcSignalIndex signal) const
{
    const auto found = m_writers.find(signal);
    return found == m_writers.end() ? Nobody : found->second.front();
}

void Schedule::findDependents(const std::vector<Node> &nodes)
{
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        for (QPlcSignalIndex output : nodes[node].outputs)
            m_writers[output].push_back(node);
    }
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        for (const Input &input : nodes[node].inputs) {
            const auto writers = input.sameCycle ? m_writers.find(input.signal) : m_writers.end();
            if (writers == m_writers.end())
                continue;
            for (const std::size_t from : writers->second) {
                if (!nodes[from].twoPhase)
                    m_dependents[from].push_back({node, input.signal});
            }
        }
    }
}

/// Takes nodes away that depend on nobody, as long as there are some (Kahn's algorithm). \return
/// how many; the others are in, or behind, a loop
std::size_t Schedule::placeInStages()
{
    std::vector<std::size_t> open(m_dependents.size());  // dependencies not placed yet
    for (const std::vector<Dependent> &dependents : m_dependents) {
        for (const Dependent &dependent : dependents)
            ++open[dependent.node];
    }
    std::vector<std::size_t> placed;
    for (std::size_t node = 0; node < open.size(); ++node) {
        if (open[node] == 0)
            placed.push_back(node);
    }
    for (std::size_t next = 0; next < placed.size(); ++next) {
        const std::size_t node = placed[next];
        m_stageCount = std::max(m_stageCount, m_stages[node] + 1);
        for (const Dependent &dependent : m_dependents[node]) {
            m_stages[dependent.node] = std::max(m_stages[dependent.node], m_stages[node] + 1);
            if (--open[dependent.node] == 0)
                placed.push_back(dependent.node);
        }
    }
    return placed.size();
}

/// The shortest way from \a start back to it (breadth first); empty when there is none.
std::vector<Schedule::Hop> Schedule::shortestLoop(std::size_t start) const
{
    std::vector<Hop> arrivals(m_dependents.size(),
                              {Nobody, QPlcInvalidSignalIndex});  // from which node, by which input
    std::vector<std::size_t> reached{start};
    for (std::size_t next = 0; next < reached.size(); ++next) {
        for (const Dependent &dependent : m_dependents[reached[next]]) {
            if (arrivals[dependent.node].node != Nobody)
                continue;
            arrivals[dependent.node] = {reached[next], dependent.input};
            reached.push_back(dependent.node);
        }
    }
    std::vector<Hop> loop;
    if (arrivals[start].node == Nobody)
        return loop;
    for (std::size_t node = start; loop.empty() || node != start; node = arrivals[node].node)
        loop.push_back({node, arrivals[node].input});
    std::reverse(loop.begin() + 1, loop.end());
    return loop;
}

}  // namespace qplc
