// SPDX-License-Identifier: Apache-2.0
#include "NodeEviction.h"

namespace qplc {

NodeEviction::NodeEviction(Plant *plant, const QString &name)
    : m_plant(plant)
    , m_name(name)
    , m_isAdmission(plant->status().evicted(name))
{
}

QString NodeEviction::titleOf(const QString &name, bool isAdmission)
{
    if (name.isEmpty())
        return isAdmission ? tr("Admit") : tr("Evict");
    return isAdmission ? tr("Admit '%1'").arg(name) : tr("Evict '%1'").arg(name);
}

QString NodeEviction::obstacle() const
{
    if (!m_plant)
        return tr("Select a node or person.");
    const PlantStatus &status = m_plant->status();
    const NodeStatus *node = status.node(m_name);
    if (m_name.isEmpty())
        return tr("This is the master.");
    if (m_plant->feed())
        return tr("A program feeds this plant; it has no master.");
    if (!m_plant->isConnected())
        return tr("There is no connection to the master.");
    if (m_isAdmission != bool(status.evicted(m_name)))
        return tr("Somebody else has done it.");
    if (!m_plant->may(m_isAdmission ? QPlcMessage::Admit : QPlcMessage::Evict))
        return tr("Your role %1 may not do this; it needs the role Operator or Engineer.").arg(m_plant->role());
    if (m_isAdmission)
        return {};
    const NodeStatus *own = m_plant->ownNode();
    if (m_name == m_plant->identity() || (own && (node == own || m_name == PlantConnection::personOf(own->info))))
        return tr("This is you; somebody else has to evict you.");
    if (node && node->info.transport == QLatin1String("inprocess"))
        return tr("This node runs in the process of the master.");
    return {};
}

QString NodeEviction::question() const
{
    if (!m_plant)
        return {};
    const bool runs = m_plant->status().isRunning();
    QStringList sentences{m_plant->name() + QLatin1String(": ") + title() + QLatin1Char('?')};
    if (m_isAdmission) {
        sentences << (runs ? tr("Cycles run: a node joins them as soon as it connects.") : tr("It may connect again."));
    } else {
        sentences << tr("Its connections end at once, and it stays out until somebody admits it again.")
                  << effectOnCycles() << effectOnLeases();
    }
    sentences.removeAll(QString());
    return sentences.join(QLatin1Char(' '));
}

QString NodeEviction::effectOnCycles() const
{
    const PlantStatus &status = m_plant->status();
    const NodeStatus *node = status.node(m_name);
    if (node && node->info.critical)
        return status.isRunning() ? tr("Cycles run, and the node is critical: the plant stops safely now.")
                                  : tr("The node is critical: the plant does not start without it.");
    if (!node || !status.isRunning())
        return {};
    return node->info.outputs > 0 ? tr("Cycles run on without it: its signals are held, then get their safe values.")
                                  : tr("Cycles run on without it.");
}

QString NodeEviction::effectOnLeases() const
{
    QStringList held;
    for (const LeaseStatus &lease : m_plant->leases()) {
        if (lease.state == LeaseStatus::Held
            && (lease.holder == m_name || lease.holder.startsWith(m_name + QLatin1String(" as "))))
            held << lease.signal;
    }
    return held.isEmpty() ? QString()
                          : tr("It controls %1: they get their neutral values.").arg(held.join(QLatin1String(", ")));
}

void NodeEviction::carryOut() const
{
    if (!m_plant || !obstacle().isEmpty())
        return;
    if (m_isAdmission)
        m_plant->admit(m_name);
    else
        m_plant->evict(m_name);
}

}  // namespace qplc
