// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QString>
#include <QtCore/QVector>

#include <optional>

/// The names of the values of an integer or boolean signal: what its numbers mean to people.
///
/// \code
/// const QPlcValueNames phases = QPlcValueNames::fromText("0: Off, 1: ReelOut, 2: ReelIn");
/// const QString name = phases.nameOf(2);                            // "ReelIn"
/// const std::optional<qint64> value = phases.valueOf("reelin");     // 2
/// \endcode
///
/// Each value has at most one name, and each name stands for one value. Windows show a value
/// without a name as a number. A name has 1 to 63 characters, none of them `,` or `:`, and it must
/// not read as a number. Frames and messages always carry the number. In the signal table the key
/// `values` holds the names.
///
/// \threadsafe a value type: several threads may read one object
///
/// \ingroup signals
class QTPLC_EXPORT QPlcValueNames
{
public:
    /// A value and its name.
    struct Entry
    {
        qint64 value = 0;  ///< the number that the signal has
        QString name;      ///< its name, 1 to 63 characters
    };

    /// Makes an object without names.
    QPlcValueNames() = default;
    /// Reads names from a text such as "0: Off, 1: ReelOut". Their order does not matter.
    /// \param text  pairs of integer and name, separated by commas
    /// \param error  if given: the reason and the remedy when \a text is wrong, empty otherwise
    /// \return no names when \a text is wrong
    static QPlcValueNames fromText(const QString &text, QString *error = nullptr);
    /// Returns a text that fromText() reads back as the same names, sorted by value; empty without
    /// names.
    QString toText() const;

    /// Returns true if no value has a name.
    bool isEmpty() const { return m_entries.isEmpty(); }
    /// Returns the number of named values.
    int size() const { return m_entries.size(); }
    /// Returns an iterator to the entry with the smallest value. Entries are sorted by value.
    QVector<Entry>::const_iterator begin() const { return m_entries.cbegin(); }
    /// Returns an iterator behind the entry with the largest value.
    QVector<Entry>::const_iterator end() const { return m_entries.cend(); }

    /// Returns the name of \a value; an empty text if the value has no name.
    QString nameOf(qint64 value) const;
    /// Returns the value that \a name stands for, or nothing if there is no such name. An exact
    /// match wins; if there is none, the first entry that differs only in upper and lower case
    /// counts.
    std::optional<qint64> valueOf(const QString &name) const;

    /// Returns true if both objects have the same values and names.
    friend bool operator==(const QPlcValueNames &a, const QPlcValueNames &b) { return a.toText() == b.toText(); }
    /// Returns true if a value or a name differs.
    friend bool operator!=(const QPlcValueNames &a, const QPlcValueNames &b) { return !(a == b); }

private:
    /// \return why not, and the remedy; empty: done
    Q_DECL_HIDDEN QString add(const QString &text);

    QVector<Entry> m_entries;
};
