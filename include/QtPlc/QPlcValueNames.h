// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QString>
#include <QtCore/QVector>

#include <optional>

/// The names of the values of an integer or boolean plc signal: what its numbers mean, for people.
///
/// ```cpp
/// const QPlcValueNames phases = QPlcValueNames::fromText("0: Off, 1: ReelOut, 2: ReelIn");
/// phases.nameOf(2);         // "ReelIn"
/// phases.valueOf("reelin"); // 2
/// ```
///
/// Every value has one name, every name one value; values without a name are shown as numbers. A name has 1 ... 63 characters, none of them `,` or `:`, and looks like no number. What is
/// sent is always the number. A value type; reading is thread-safe.
class QTPLC_EXPORT QPlcValueNames
{
public:
    struct Entry
    {
        qint64 value = 0;
        QString name;
    };

    QPlcValueNames() = default;
    /// Reads "0: Off, 1: ReelOut", in any order. \return no names when the text is wrong: \a error (if given) then says what and the remedy; else it is emptied
    static QPlcValueNames fromText(const QString &text, QString *error = nullptr);
    /// What fromText() reads back as the same names, by ascending value.
    QString toText() const;

    bool isEmpty() const { return m_entries.isEmpty(); }
    int size() const { return m_entries.size(); }
    /// By ascending value.
    QVector<Entry>::const_iterator begin() const { return m_entries.cbegin(); }
    QVector<Entry>::const_iterator end() const { return m_entries.cend(); }

    /// Empty: the value has no name.
    QString nameOf(qint64 value) const;
    /// Upper and lower case count only where names differ in nothing else. \return nothing when there is no such name
    std::optional<qint64> valueOf(const QString &name) const;

    friend bool operator==(const QPlcValueNames &a, const QPlcValueNames &b) { return a.toText() == b.toText(); }
    friend bool operator!=(const QPlcValueNames &a, const QPlcValueNames &b) { return !(a == b); }

private:
    /// \return why not, and the remedy; empty: done
    QString add(const QString &text);

    QVector<Entry> m_entries;
};
