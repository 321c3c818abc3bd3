// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeSessions.h"
#include "QPlcManifest.h"
#include "node/cycle/NodeRegistry.h"

#include <QtCore/QMap>
#include <QtCore/QSet>

#include <functional>

namespace qplc {

/// The nodes without which a master does not begin: those that its manifest needs, and critical
/// nodes that have registered, or have been refused, since the master was started.
///
/// Thread of the master.
class NeededNodes
{
public:
    /// \param nodes  of the master
    /// \param usualWatchdog  of a node that has set none; 0: watchdogs only report
    NeededNodes(const NodeSessions &nodes, std::function<std::chrono::nanoseconds()> usualWatchdog);

    void setManifest(const QPlcManifest &manifest) { m_manifest = manifest; }
    const QPlcManifest &manifest() const { return m_manifest; }

    /// Why a master that asks nobody for an identity cannot have this manifest; empty: it can.
    QString identityFault() const;

    /// A node wants to register: makes it critical if it has to be, and remembers critical ones.
    /// \param transport  that it wants
    /// \param identity  that it has proven; empty: none
    /// \return why the manifest does not permit it; no error: it does
    Refusal judge(NodeDeclaration *node, const QString &transport, const QString &identity);
    /// Whether it is needed, or may be by the manifest.
    bool contains(const QString &node) const { return m_manifest.find(node) || m_critical.contains(node); }
    /// For the reason why it is missing: what has become of a node.
    /// \param fate  "has left: it closed the connection"
    void tellFate(const QString &node, const QString &fate);
    /// The plant may do without a critical node that has been there. What the manifest needs stays
    /// needed.
    void forget(const QString &node) { m_critical.remove(node); }

    /// Which nodes are missing, why, and what to do; empty: none.
    /// \param least  a node that has not come so far is missing
    QString missingText(NodeSession::Stage least) const;

private:
    /// Of the nodes that have come so far at \a least, without listeners.
    QSet<QString> namesOf(NodeSession::Stage least) const;
    QString fateOf(const QString &name) const;
    QString closeNamesText(const QString &name) const;
    Refusal contradiction(const QPlcManifest::Node &needed, const NodeDeclaration &node, const QString &transport,
                          const QString &identity) const;
    Refusal remember(const NodeDeclaration &node);

    const NodeSessions &m_nodes;
    const std::function<std::chrono::nanoseconds()> m_usualWatchdog;
    QPlcManifest m_manifest;
    QMap<QString, QString> m_critical;  // that have been there, with their fates: not those of the manifest
    QMap<QString, QString> m_fates;     // of nodes of the manifest
};

}  // namespace qplc
