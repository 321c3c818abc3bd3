// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSession.h"

#include <vector>

namespace qplc {

/// The sessions of all nodes that can be initialized, in the order in which they are asked: those
/// that answer later come first, and compute while the others are asked.
///
/// The lists are copies: nodes may leave while somebody walks over one.
class NodeSessions
{
public:
    using List = std::vector<std::shared_ptr<NodeSession>>;

    void add(const std::shared_ptr<NodeSession> &node);
    void remove(const NodeSession &node);

    List all() const { return m_nodes; }
    /// Those that an initialization waits for.
    List awaited() const;
    /// The others: listeners over a network.
    List listeners() const;
    /// Null: there is none.
    std::shared_ptr<NodeSession> of(const NodeSlot *slot) const;
    std::shared_ptr<NodeSession> of(const QPlcSlaveNode *object) const;

private:
    template<typename Condition>
    List those(Condition condition) const;

    List m_nodes;
};

}  // namespace qplc
