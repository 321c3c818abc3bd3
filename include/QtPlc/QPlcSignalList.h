// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalIndexList.h"
#include "QPlcValue.h"

#include <QtCore/QVector>

/// Values of signals, each under its index, in the order of insertion.
/// A value type.
class QTPLC_EXPORT QPlcSignalList
{
public:
    struct Entry
    {
        QPlcSignalIndex index;
        QPlcValue value;
        friend bool operator==(const Entry &a, const Entry &b) { return a.index == b.index && a.value == b.value; }
    };
    using const_iterator = QVector<Entry>::const_iterator;

    QPlcSignalList() = default;

    /// Sets the value of a signal; the last value counts. Nothing is added for QPlcInvalidSignalIndex.
    void insert(QPlcSignalIndex index, const QPlcValue &value);
    /// As above, by name in the table of the process. \return false when there is no such signal
    bool insert(const QString &name, const QPlcValue &value);

    /// The value of a signal; invalid when the list has none.
    QPlcValue value(QPlcSignalIndex index) const;
    QPlcValue value(const QString &name) const;
    bool contains(QPlcSignalIndex index) const;
    QPlcSignalIndexList indices() const;

    bool isEmpty() const { return m_entries.isEmpty(); }
    int size() const { return m_entries.size(); }
    const_iterator begin() const { return m_entries.cbegin(); }
    const_iterator end() const { return m_entries.cend(); }
    void clear() { m_entries.clear(); }
    void reserve(int size) { m_entries.reserve(size); }

    friend bool operator==(const QPlcSignalList &a, const QPlcSignalList &b) { return a.m_entries == b.m_entries; }
    friend bool operator!=(const QPlcSignalList &a, const QPlcSignalList &b) { return !(a == b); }

private:
    QVector<Entry> m_entries;
};

Q_DECLARE_METATYPE(QPlcSignalList)
