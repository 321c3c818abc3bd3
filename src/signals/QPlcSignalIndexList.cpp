// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalIndexList.h"

#include "QPlcSignalIndexTable.h"

QPlcSignalIndex QPlcSignalIndexList::insert(const QString &name)
{
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(name);
    if (index != QPlcInvalidSignalIndex)
        return insert(index);
    if (!m_unknownNames.contains(name))
        m_unknownNames.append(name);
    return QPlcInvalidSignalIndex;
}

QPlcSignalIndex QPlcSignalIndexList::insert(QPlcSignalIndex index)
{
    if (index == QPlcInvalidSignalIndex)
        return insert(QStringLiteral("index 65535"));
    if (!m_indices.contains(index))
        m_indices.append(index);
    return index;
}
