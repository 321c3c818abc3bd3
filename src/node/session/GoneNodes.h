// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

#include <algorithm>
#include <deque>

namespace qplc {

/// Nodes that have left a master and of whom the cycle may still report something: the last ones
/// only, however many come and go.
class GoneNodes
{
public:
    static constexpr std::size_t Most = 256;  // more do not leave before reports are read

    struct Node
    {
        quint16 id;
        QString name;
        bool isListener;
    };

    void add(const Node &node)
    {
        if (m_nodes.size() == Most)
            m_nodes.pop_front();
        m_nodes.push_back(node);
    }
    /// The last one of this number; null: there was none, or long ago.
    const Node *find(quint16 id) const
    {
        const auto found
            = std::find_if(m_nodes.rbegin(), m_nodes.rend(), [id](const Node &node) { return node.id == id; });
        return found != m_nodes.rend() ? &*found : nullptr;
    }
    bool hasName(const QString &name) const
    {
        return std::any_of(m_nodes.begin(), m_nodes.end(), [&](const Node &node) { return node.name == name; });
    }
    void clear() { m_nodes.clear(); }

private:
    std::deque<Node> m_nodes;  // in the order of leaving
};

}  // namespace qplc
