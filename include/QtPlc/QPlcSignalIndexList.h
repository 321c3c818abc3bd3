// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcInputTiming.h"

#include <QtCore/QBitArray>
#include <QtCore/QMetaType>
#include <QtCore/QStringList>
#include <QtCore/QVector>

/// An ordered set of signals: the inputs or the outputs of a node. An entry is the index of a
/// signal in the table of the process (QPlcSignalIndexTable).
///
/// \code
/// QPlcSignalIndexList inputs;
/// const QPlcSignalIndex speed = inputs.insert("tetherSpeed");
/// inputs.insert("windSpeed", QPlcInputTiming::SameCycle);
/// QPlcIOSlaveNode node("Operator");
/// node.setInputSignalIndices(inputs);
/// \endcode
///
/// \threadsafe a value type: several threads may read one object
///
/// \ingroup signals
class QTPLC_EXPORT QPlcSignalIndexList
{
public:
    /// Iterator over the indices, in the order of insertion.
    using const_iterator = QVector<QPlcSignalIndex>::const_iterator;

    /// Makes an empty list.
    QPlcSignalIndexList() = default;

    /// Adds a signal by its name in the table of the process. A signal that is in the list already
    /// is not added again.
    /// \param timing  which value a node reads, in a list of inputs. SameCycle stays once it was
    ///     set
    /// \return the index; QPlcInvalidSignalIndex for a name that the table does not have.
    ///     unknownNames() then has the name, and the registration of the node fails with a sentence
    ///     about it
    QPlcSignalIndex insert(const QString &name, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    /// Adds a signal by its index, by the rules above. The index is not checked against the table.
    /// QPlcInvalidSignalIndex counts as an unknown name.
    QPlcSignalIndex insert(QPlcSignalIndex index, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);

    /// Returns true if the signal is in the list.
    bool contains(QPlcSignalIndex index) const { return index < m_isIn.size() && m_isIn.testBit(index); }
    /// Returns true if the list has no signals. Unknown names do not count.
    bool isEmpty() const { return m_indices.isEmpty(); }
    /// Returns the number of signals.
    int size() const { return m_indices.size(); }
    /// Returns the index at a position.
    /// \pre 0 <= \a position < size()
    QPlcSignalIndex at(int position) const { return m_indices.at(position); }
    /// Returns an iterator to the index that was inserted first.
    const_iterator begin() const { return m_indices.cbegin(); }
    /// Returns an iterator behind the last index.
    const_iterator end() const { return m_indices.cend(); }
    /// Returns all indices, in the order of insertion.
    QVector<QPlcSignalIndex> toVector() const { return m_indices; }
    /// Returns the names that insert() did not find in the table of the process, each once.
    QStringList unknownNames() const { return m_unknownNames; }
    /// Returns true if \a index was inserted with QPlcInputTiming::SameCycle.
    bool isSameCycle(QPlcSignalIndex index) const { return m_sameCycle.contains(index); }
    /// Returns true if at least one signal, known or not, was inserted with
    /// QPlcInputTiming::SameCycle.
    bool hasSameCycle() const { return !m_sameCycle.isEmpty(); }

    /// Returns true if both lists have the same signals in the same order with the same timing.
    /// Unknown names do not count.
    friend bool operator==(const QPlcSignalIndexList &a, const QPlcSignalIndexList &b)
    {
        return a.m_indices == b.m_indices && a.m_sameCycle == b.m_sameCycle;
    }
    /// Returns true if signals, order or timing differ.
    friend bool operator!=(const QPlcSignalIndexList &a, const QPlcSignalIndexList &b) { return !(a == b); }

private:
    QVector<QPlcSignalIndex> m_indices;
    QBitArray m_isIn;                      // for each index up to the largest one
    QVector<QPlcSignalIndex> m_sameCycle;  // of them; an unknown name is QPlcInvalidSignalIndex
    QStringList m_unknownNames;
};

Q_DECLARE_METATYPE(QPlcSignalIndexList)
