// SPDX-License-Identifier: Apache-2.0
#include "ViolationWatch.h"

#include "gui/WindowText.h"

namespace qplc {

namespace {

QString counted(quint64 count)
{
    return count == 1 ? WindowText::tr("1 violation") : WindowText::tr("%1 violations").arg(count);
}

}  // namespace

quint64 ViolationWatch::totalOf(const PlantStatus &status)
{
    quint64 total = status.statistics.overruns;
    for (const NodeStatus &node : status.nodes)
        total += node.statistics.late;
    return total;
}

void ViolationWatch::take(quint64 total, qint64 now)
{
    if (!m_steps.isEmpty() && total < m_steps.last().total)
        m_steps.clear();  // another phase
    if (!m_steps.isEmpty())
        m_steps.last().until = now;
    if (m_steps.isEmpty() || total > m_steps.last().total)
        m_steps.append({now, total});
    while (m_steps.size() > 1 && m_steps.at(0).until < now - Window)
        m_steps.removeFirst();
}

QString ViolationWatch::text() const
{
    return recent() > 0 ? WindowText::tr("%1 in 10 s").arg(counted(recent())) : counted(total());
}

}  // namespace qplc
