// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcInputTiming.h"

#include <QtCore/QMetaType>
#include <QtCore/QStringList>
#include <QtCore/QVector>

/// An ordered set of signals, named by their index in the table of the process (QPlcSignalIndexTable).
/// A value type.
class QTPLC_EXPORT QPlcSignalIndexList
{
public:
    using const_iterator = QVector<QPlcSignalIndex>::const_iterator;

    QPlcSignalIndexList() = default;

    /// Adds the signal \a name (once: a second insert changes nothing).
    /// \return its index; QPlcInvalidSignalIndex when the table has no such signal, and then unknownNames() holds the name, so that the
    /// registration of the node fails with a sentence instead of running without the signal
    /// \param timing  which value of the signal is read, in a list of inputs; SameCycle stays once it was said
    QPlcSignalIndex insert(const QString &name, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);
    QPlcSignalIndex insert(QPlcSignalIndex index, QPlcInputTiming::Value timing = QPlcInputTiming::LastCycle);

    bool contains(QPlcSignalIndex index) const { return m_indices.contains(index); }
    bool isEmpty() const { return m_indices.isEmpty(); }
    int size() const { return m_indices.size(); }
    QPlcSignalIndex at(int position) const { return m_indices.at(position); }
    const_iterator begin() const { return m_indices.cbegin(); }
    const_iterator end() const { return m_indices.cend(); }
    QVector<QPlcSignalIndex> toVector() const { return m_indices; }
    QStringList unknownNames() const { return m_unknownNames; }
    /// Whether \a index was inserted with QPlcInputTiming::SameCycle.
    bool isSameCycle(QPlcSignalIndex index) const { return m_sameCycle.contains(index); }
    /// Whether anything was inserted with QPlcInputTiming::SameCycle, known or not.
    bool hasSameCycle() const { return !m_sameCycle.isEmpty(); }

    friend bool operator==(const QPlcSignalIndexList &a, const QPlcSignalIndexList &b)
    {
        return a.m_indices == b.m_indices && a.m_sameCycle == b.m_sameCycle;
    }
    friend bool operator!=(const QPlcSignalIndexList &a, const QPlcSignalIndexList &b) { return !(a == b); }

private:
    QVector<QPlcSignalIndex> m_indices;
    QVector<QPlcSignalIndex> m_sameCycle;  // of them; an unknown name is QPlcInvalidSignalIndex
    QStringList m_unknownNames;
};

Q_DECLARE_METATYPE(QPlcSignalIndexList)
