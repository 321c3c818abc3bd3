// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/NodeRegistry.h"
#include "node/security/AccessRights.h"
#include "protocol/messages/State.h"

#include <QtCore/QMap>

namespace qplc {

/// Names of nodes and persons that a master does not let in, until they are admitted again or the
/// master ends.
///
/// Thread of the master.
class Evictions
{
public:
    /// That are remembered: as many as there can be nodes.
    static constexpr int Most = NodeRegistry::MaximumNodes;

    /// \param by  who has asked, as shown to people
    /// \param role  of who has asked: an Engineer is kept out by Engineers only
    /// \return false when there is no room for another name
    bool add(const QString &name, const QString &by, Role role);
    /// \return false when this name is not out
    bool remove(const QString &name) { return m_evicted.remove(name) > 0; }
    bool contains(const QString &name) const { return m_evicted.contains(name); }
    QStringList names() const { return m_evicted.keys(); }
    /// As State tells them, in the order of names().
    QVector<messages::EvictedEntry> entries() const;

    /// Why somebody may not come in as \a name, or with the identity of \a peer; no error: it may.
    Refusal refusalOf(const QString &name, const Peer &peer) const;

private:
    struct Entry
    {
        QString by;
        Role role;
        quint64 time;  // [ns] since 1970
    };

    QMap<QString, Entry> m_evicted;
};

}  // namespace qplc
