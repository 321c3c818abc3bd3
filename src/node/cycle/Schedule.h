// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace qplc {

/// The order of nodes within a cycle by direct feed-through. Pure arithmetic on what the nodes
/// declare.
///
/// Node B depends on node A when B reads a signal of A in the same cycle and A is not two-phase:
/// the outputs of a two-phase node are there before the cycle begins, and nobody has to wait for
/// them. A node is in the stage behind those that it depends on, so there are as few stages as can
/// be; when nodes depend on each other in a ring, there is no order: an algebraic loop.
class Schedule
{
public:
    struct Input
    {
        QPlcSignalIndex signal = QPlcInvalidSignalIndex;
        bool sameCycle = false;
    };
    struct Node
    {
        bool twoPhase = false;
        std::vector<Input> inputs;
        std::vector<QPlcSignalIndex> outputs;  // of no other node
    };
    /// A node of a loop, and the input by which the loop enters it.
    struct Hop
    {
        std::size_t node = 0;
        QPlcSignalIndex input = QPlcInvalidSignalIndex;
    };
    static constexpr std::size_t Nobody = std::size_t(-1);

    explicit Schedule(const std::vector<Node> &nodes);

    bool isValid() const { return m_loop.empty(); }
    /// The way around an algebraic loop: each node writes the input of the next one, the last one
    /// that of the first. Empty: there is none. When the last node closes one, it begins with that
    /// node, and none through it is shorter.
    const std::vector<Hop> &loop() const { return m_loop; }

    // \pre isValid()
    std::size_t stageCount() const { return m_stageCount; }
    /// From 0.
    std::size_t stage(std::size_t node) const { return m_stages[node]; }
    /// Whether a later stage reads what \a node writes in this cycle.
    bool feedsLaterStage(std::size_t node) const { return !m_dependents[node].empty(); }

    /// Node that writes \a signal, of several the first one; Nobody: none of them.
    std::size_t writer(QPlcSignalIndex signal) const;

private:
    struct Dependent
    {
        std::size_t node;
        QPlcSignalIndex input;  // by which it depends
    };

    void findDependents(const std::vector<Node> &nodes);
    std::size_t placeInStages();
    std::vector<Hop> shortestLoop(std::size_t start) const;

    std::unordered_map<QPlcSignalIndex, std::vector<std::size_t>> m_writers;
    std::vector<std::vector<Dependent>> m_dependents;  // of each node
    std::vector<std::size_t> m_stages;
    std::size_t m_stageCount = 0;
    std::vector<Hop> m_loop;
};

}  // namespace qplc
