// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalList.h"

#include "QPlcSignalIndexTable.h"

#include <algorithm>

/// \return position of the entry; -1: there is none
int QPlcSignalList::find(QPlcSignalIndex index) const
{
    const auto isIt = [index](const Entry &entry) { return entry.index == index; };
    const auto found = m_isAscending
        ? std::lower_bound(begin(), end(), index,
                           [](const Entry &entry, QPlcSignalIndex wanted) { return entry.index < wanted; })
        : std::find_if(begin(), end(), isIt);
    return found != end() && isIt(*found) ? int(found - begin()) : -1;
}

void QPlcSignalList::insert(QPlcSignalIndex index, const QPlcValue &value)
{
    if (index == QPlcInvalidSignalIndex)
        return;
    const int position = find(index);
    if (position >= 0) {
        m_entries[position].value = value;
        return;
    }
    m_isAscending = m_isAscending && (isEmpty() || m_entries.last().index < index);
    m_entries.append(Entry{index, value});
}

bool QPlcSignalList::insert(const QString &name, const QPlcValue &value)
{
    const QPlcSignalIndex index = QPlcSignalIndexTable::index(name);
    insert(index, value);
    return index != QPlcInvalidSignalIndex;
}

QPlcValue QPlcSignalList::value(QPlcSignalIndex index) const
{
    const int position = find(index);
    return position >= 0 ? m_entries.at(position).value : QPlcValue();
}

QPlcValue QPlcSignalList::value(const QString &name) const
{
    return value(QPlcSignalIndexTable::index(name));
}

bool QPlcSignalList::contains(QPlcSignalIndex index) const
{
    return find(index) >= 0;
}

QPlcSignalIndexList QPlcSignalList::indices() const
{
    QPlcSignalIndexList result;
    for (const Entry &entry : m_entries)
        result.insert(entry.index);
    return result;
}
