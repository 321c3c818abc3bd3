// SPDX-License-Identifier: Apache-2.0
#include "NeededNodes.h"

#include "protocol/messages/Vocabulary.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <algorithm>

namespace qplc {

namespace {

Refusal mismatch(const QString &node, const QString &what, const QString &remedy)
{
    return {messages::errorWord::manifestMismatch, QStringLiteral("node '%1' %2; %3").arg(node, what, remedy)};
}

}  // namespace

NeededNodes::NeededNodes(const NodeSessions &nodes, std::function<std::chrono::nanoseconds()> usualWatchdog)
    : m_nodes(nodes)
    , m_usualWatchdog(std::move(usualWatchdog))
{
}

QString NeededNodes::identityFault() const
{
    for (const QPlcManifest::Node &node : m_manifest.nodes) {
        if (!node.identity.isEmpty())
            return QStringLiteral(
                       "the manifest says identity = %1 for node '%2', and the master has no security; start "
                       "the master with --security, or remove the line")
                .arg(node.identity, node.name);
    }
    return {};
}

// ---- registration ----

Refusal NeededNodes::judge(NodeDeclaration *node, const QString &transport, const QString &identity)
{
    const QPlcManifest::Node *needed = m_manifest.find(node->name);
    const bool hasToBeCritical = needed ? needed->need == QPlcManifest::Critical : m_critical.contains(node->name);
    node->critical = (node->critical || hasToBeCritical) && !node->listener;
    if (needed)
        return contradiction(*needed, *node, transport, identity);
    return node->critical ? remember(*node) : Refusal();
}

/// What \a node says can only be made stricter where the master decides alone.
Refusal NeededNodes::contradiction(const QPlcManifest::Node &needed, const NodeDeclaration &node,
                                   const QString &transport, const QString &identity) const
{
    const QString says = QStringLiteral("the manifest says ");
    if (node.listener && needed.need != QPlcManifest::Optional)
        return mismatch(node.name, QStringLiteral("is a listener"),
                        says + QStringLiteral("that the plant needs it; give the listener another name"));
    if (!needed.transports.isEmpty() && !needed.transports.contains(transport))
        return mismatch(
            node.name, QStringLiteral("uses the transport '%1'").arg(transport),
            says + QStringLiteral("transport = %1; use it").arg(needed.transports.join(QStringLiteral(", "))));
    if (transport == NodeSession::inProcess())
        return {};
    if (!needed.identity.isEmpty() && needed.identity != identity)
        return mismatch(node.name,
                        identity.isEmpty() ? QStringLiteral("has proven no identity")
                                           : QStringLiteral("has the identity '%1'").arg(identity),
                        says + QStringLiteral("identity = %1; give it the key of this identity").arg(needed.identity));
    const std::chrono::nanoseconds usual = m_usualWatchdog();
    const std::chrono::nanoseconds watchdog = node.watchdog.value_or(usual);
    const bool isChecked = needed.watchdog.count() > 0 && usual.count() > 0;
    if (isChecked && (watchdog.count() == 0 || watchdog > needed.watchdog))
        return mismatch(node.name,
                        watchdog.count() == 0 ? QStringLiteral("has no watchdog that leads to its safe state")
                                              : QStringLiteral("has a watchdog of %1").arg(durationText(watchdog)),
                        says
                            + QStringLiteral("watchdog = %1; start it with --watchdog %2")
                                  .arg(durationText(needed.watchdog))
                                  .arg(double(needed.watchdog.count()) * 1e-9));
    return {};
}

Refusal NeededNodes::remember(const NodeDeclaration &node)
{
    if (!m_critical.contains(node.name) && m_critical.size() >= NodeRegistry::MaximumNodes)
        return {messages::errorWord::tooManyNodes,
                QStringLiteral("node '%1' is critical, and the master remembers %2 critical nodes already; start the "
                               "master again")
                    .arg(node.name)
                    .arg(m_critical.size())};
    if (!m_critical.contains(node.name))
        m_critical.insert(node.name, QString());
    return {};
}

void NeededNodes::tellFate(const QString &node, const QString &fate)
{
    if (m_manifest.find(node))
        m_fates[node] = fate;
    if (m_critical.contains(node))
        m_critical[node] = fate;
}

// ---- what is missing ----

QSet<QString> NeededNodes::namesOf(NodeSession::Stage least) const
{
    QSet<QString> names;
    for (const auto &node : m_nodes.all()) {
        if (!node->isListener() && node->stage() >= least)
            names.insert(node->name());
    }
    return names;
}

QString NeededNodes::fateOf(const QString &name) const
{
    const QString fate = m_fates.value(name, m_critical.value(name));
    return fate.isEmpty() ? QStringLiteral("has not registered") + closeNamesText(name) : fate;
}

/// "; did you mean 'Model'?": nodes that are there, and that the manifest does not name.
QString NeededNodes::closeNamesText(const QString &name) const
{
    QStringList others;
    for (const auto &node : m_nodes.all()) {
        if (!m_manifest.find(node->name()))
            others << node->name();
    }
    constexpr int nearest = 1;
    return didYouMean(closeNames(name, others, nearest));
}

QString NeededNodes::missingText(NodeSession::Stage least) const
{
    QStringList missing;
    bool areRegistered = true;
    const QSet<QString> there = namesOf(least);
    const QSet<QString> registered = namesOf(NodeSession::Idle);
    const auto check = [&](const QString &name, QPlcManifest::Need need) {
        if (there.contains(name))
            return;
        const bool isLate = registered.contains(name);
        missing << QStringLiteral("%1 node '%2' (%3)")
                       .arg(QPlcManifest::needName(need), name,
                            isLate ? QStringLiteral("came too late for the initialization") : fateOf(name));
        areRegistered = areRegistered && isLate;
    };
    for (const QPlcManifest::Node &node : m_manifest.nodes) {
        if (node.need != QPlcManifest::Optional)
            check(node.name, node.need);
    }
    const bool isManifestFulfilled = missing.isEmpty();
    for (auto node = m_critical.begin(); node != m_critical.end(); ++node)
        check(node.key(), QPlcManifest::Critical);
    if (missing.isEmpty())
        return {};
    const bool isOne = missing.size() == 1;
    const QString them = isOne ? QStringLiteral("it") : QStringLiteral("them");
    const QString text
        = firstOf(missing) + (isOne ? QStringLiteral(" is missing; ") : QStringLiteral(" are missing; "));
    if (areRegistered)
        return text + QStringLiteral("initialize again");
    return text + QStringLiteral("start %1").arg(them)
        + (isManifestFulfilled
               ? QStringLiteral(" again, or start the master again if the plant may run without %1").arg(them)
               : QString());
}

}  // namespace qplc
