// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalIndexList.h"

#include "QPlcSignalIndexTable.h"

QPlcSignalIndex QPlcSignalIndexList::insert(const QString &name, QPlcInputTiming::Value timing)
{
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(name);
    if (timing == QPlcInputTiming::SameCycle && !m_sameCycle.contains(index))
        m_sameCycle.append(index);
    if (index != QPlcInvalidSignalIndex)
        return insert(index, timing);
    if (!m_unknownNames.contains(name))
        m_unknownNames.append(name);
    return QPlcInvalidSignalIndex;
}

QPlcSignalIndex QPlcSignalIndexList::insert(QPlcSignalIndex index, QPlcInputTiming::Value timing)
{
    if (index == QPlcInvalidSignalIndex)
        return insert(QStringLiteral("index 65535"), timing);
    if (timing == QPlcInputTiming::SameCycle && !m_sameCycle.contains(index))
        m_sameCycle.append(index);
    if (contains(index))
        return index;
    m_indices.append(index);
    if (index >= m_isIn.size())
        m_isIn.resize(index + 1);
    m_isIn.setBit(index);
    return index;
}
