// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalList.h"

#include "QPlcSignalIndexTable.h"

#include <algorithm>

namespace {

template<typename Iterator>
Iterator find(Iterator begin, Iterator end, QPlcSignalIndex index)
{
    return std::find_if(begin, end, [index](const QPlcSignalList::Entry &entry) { return entry.index == index; });
}

}  // namespace

void QPlcSignalList::insert(QPlcSignalIndex index, const QPlcValue &value)
{
    if (index == QPlcInvalidSignalIndex)
        return;
    const auto entry = find(m_entries.begin(), m_entries.end(), index);
    if (entry != m_entries.end())
        entry->value = value;
    else
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
    const auto entry = find(begin(), end(), index);
    return entry != end() ? entry->value : QPlcValue();
}

QPlcValue QPlcSignalList::value(const QString &name) const
{
    return value(QPlcSignalIndexTable::index(name));
}

bool QPlcSignalList::contains(QPlcSignalIndex index) const
{
    return find(begin(), end(), index) != end();
}

QPlcSignalIndexList QPlcSignalList::indices() const
{
    QPlcSignalIndexList result;
    for (const Entry &entry : m_entries)
        result.insert(entry.index);
    return result;
}
