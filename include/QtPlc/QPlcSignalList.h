// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalIndexList.h"
#include "QPlcValue.h"

#include <QtCore/QVector>

/// Values of signals: each entry is the index of a signal and its value, in the order of insertion.
///
/// \code
/// QPlcSignalList values;
/// if (!values.insert("tetherSpeed", 2.5))
///     qWarning("the table of the process has no signal 'tetherSpeed'");
/// const double speed = values.value("tetherSpeed").toReal();
/// \endcode
///
/// Indices belong to the table of the process (QPlcSignalIndexTable). A look-up takes time in
/// proportion to the size of the list, or to its logarithm if the signals were inserted in the
/// order of their indices.
///
/// \threadsafe a value type: several threads may read one object
///
/// \ingroup signals
class QTPLC_EXPORT QPlcSignalList
{
public:
    /// A signal and its value.
    struct Entry
    {
        QPlcSignalIndex index;  ///< signal in the table of the process
        QPlcValue value;        ///< its value; the list does not check the type
        /// Returns true if index and value are the same.
        friend bool operator==(const Entry &a, const Entry &b) { return a.index == b.index && a.value == b.value; }
    };
    /// Iterator over the entries, in the order of insertion.
    using const_iterator = QVector<Entry>::const_iterator;

    /// Makes an empty list.
    QPlcSignalList() = default;

    /// Sets the value of a signal. An entry of the same signal is replaced in its place. Does
    /// nothing for QPlcInvalidSignalIndex.
    void insert(QPlcSignalIndex index, const QPlcValue &value);
    /// Sets the value of a signal by its name in the table of the process, as above.
    /// \return false, without a change, when the table has no such signal
    bool insert(const QString &name, const QPlcValue &value);

    /// Returns the value of a signal; an invalid value if the list does not have it.
    QPlcValue value(QPlcSignalIndex index) const;
    /// Returns the value of a signal by its name in the table of the process; an invalid value if
    /// the list does not have it.
    QPlcValue value(const QString &name) const;
    /// Returns true if the list has a value of the signal.
    bool contains(QPlcSignalIndex index) const;
    /// Returns the signals of the list, without their values.
    QPlcSignalIndexList indices() const;

    /// Returns true if the list has no values.
    bool isEmpty() const { return m_entries.isEmpty(); }
    /// Returns the number of values.
    int size() const { return m_entries.size(); }
    /// Returns an iterator to the entry that was inserted first.
    const_iterator begin() const { return m_entries.cbegin(); }
    /// Returns an iterator behind the last entry.
    const_iterator end() const { return m_entries.cend(); }
    /// Removes all values.
    void clear()
    {
        m_entries.clear();
        m_isAscending = true;
    }
    /// Reserves memory for \a size entries, so that the next insertions do not allocate.
    void reserve(int size) { m_entries.reserve(size); }

    /// Returns true if both lists have equal entries in the same order.
    friend bool operator==(const QPlcSignalList &a, const QPlcSignalList &b) { return a.m_entries == b.m_entries; }
    /// Returns true if an entry or the order differs.
    friend bool operator!=(const QPlcSignalList &a, const QPlcSignalList &b) { return !(a == b); }

private:
    Q_DECL_HIDDEN int find(QPlcSignalIndex index) const;

    QVector<Entry> m_entries;
    bool m_isAscending = true;  // in their indices
};

Q_DECLARE_METATYPE(QPlcSignalList)
