// SPDX-License-Identifier: Apache-2.0
#include "NodeSessions.h"

#include <algorithm>
#include <iterator>

namespace qplc {

template<typename Condition>
NodeSessions::List NodeSessions::those(Condition condition) const
{
    List found;
    std::copy_if(m_nodes.begin(), m_nodes.end(), std::back_inserter(found), condition);
    return found;
}

void NodeSessions::add(const std::shared_ptr<NodeSession> &node)
{
    const auto comesLater = [&](const auto &other) { return !node->answersAtOnce() && other->answersAtOnce(); };
    m_nodes.insert(std::find_if(m_nodes.begin(), m_nodes.end(), comesLater), node);
}

void NodeSessions::remove(const NodeSession &node)
{
    const auto isIt = [&](const auto &other) { return other.get() == &node; };
    m_nodes.erase(std::remove_if(m_nodes.begin(), m_nodes.end(), isIt), m_nodes.end());
}

NodeSessions::List NodeSessions::awaited() const
{
    return those([](const auto &node) { return node->isAwaited(); });
}

NodeSessions::List NodeSessions::listeners() const
{
    return those([](const auto &node) { return !node->isAwaited(); });
}

std::shared_ptr<NodeSession> NodeSessions::of(const NodeSlot *slot) const
{
    const List found = those([slot](const auto &node) { return node->slot().get() == slot; });
    return found.empty() ? nullptr : found.front();
}

std::shared_ptr<NodeSession> NodeSessions::of(const QPlcSlaveNode *object) const
{
    const List found = those([object](const auto &node) { return node->object() == object; });
    return found.empty() ? nullptr : found.front();
}

}  // namespace qplc
