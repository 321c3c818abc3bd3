// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcParseError.h"
#include "QPlcSignalDefinition.h"

#include <QtCore/QHash>
#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {
class TableReader;
}

/// All plc signals of a controller, in the order of the file.
///
/// ```ini
/// ; the winch
/// [tetherSpeed]
/// type = Real
/// unit = m/s
/// min  = -10
/// max  = 10
/// safe = 0
/// ```
///
/// Keys: `type` (required, see QPlcSignalType), `unit`, `description`, and what is a value of the signal, and what becomes of it without one:
/// | key       | meaning                                                                                                           |
/// |-----------|-------------------------------------------------------------------------------------------------------------------|
/// | `initial` | value before anybody has written the signal; zero unless said                                                     |
/// | `min`, `max` | limits of every element. A value outside, like NaN or infinity, is counted and never taken                     |
/// | `hold`    | cycles for which the last good value is kept when no new one comes, an integer >= 0; 3 unless said                |
/// | `safe`    | value after that, until a good one comes; unless said 0, or the limit nearest to 0                                |
/// | `writer`  | `A`: the node A alone may write the signal. `A > B > C`: these nodes may, and the first one that has a fresh value is the source |
/// | `values`  | names of the values of an integer or boolean signal: `values = 0: Off, 1: ReelOut` (see QPlcValueNames)         |
/// | `nan`     | `allowed`: NaN ("no measurement") is taken like a number                                                          |
/// | `slope`   | `5 per second`: a value that a person or program sets moves each element by at most so much in a second, while cycles run. Real types only |
///
/// Comments begin with `;` or `#` at the start of a line, or with ` ;` behind a value. Values of arrays are
/// separated by commas ("0, 0, 1"); one number stands for all elements. UTF-8 with or without byte order mark, lines
/// ended by LF or CRLF, at most 4096 bytes each. A value that begins with `"` ends with `"`; inside, `\n \r \t \" \\` stand for what they do in C++.
/// A signal name is a letter or underscore followed by letters, digits, `_` or `.`, at most 63 characters.
///
/// A value type with implicit sharing of its members; reading is thread-safe.
class QTPLC_EXPORT QPlcSignalTable
{
public:
    /// Most signals of a table: the last index is kept for "none".
    static constexpr int MaximumSignals = 65534;

    QPlcSignalTable() = default;

    /// Reads a table. On any error the result is empty and \a errors (if given) holds all of them, in file order;
    /// behind the first hundred, one more says how many there are. Without an error it is emptied.
    /// \param fileName  only for the errors
    static QPlcSignalTable fromIni(const QByteArray &text, QVector<QPlcParseError> *errors = nullptr,
                                   const QString &fileName = QString());
    /// Reads what a master has sent: the same, but keys that this version does not know are left out, for the master may be a newer one.
    static QPlcSignalTable fromMaster(const QByteArray &text, QVector<QPlcParseError> *errors = nullptr);
    /// Reads the file \a fileName; a file that cannot be read is one error.
    static QPlcSignalTable fromIniFile(const QString &fileName, QVector<QPlcParseError> *errors = nullptr);
    /// The table as a text that fromIni() reads back as an equal table.
    QByteArray toIni() const;

    /// Adds a signal at the end. Values are converted to its type; without an initial value it gets zero. \return false, with the reason in \a error, when the definition is not valid or the name is taken.
    bool append(const QPlcSignalDefinition &definition, QString *error = nullptr);

    bool isEmpty() const { return m_signals.isEmpty(); }
    int size() const { return m_signals.size(); }
    /// \pre index < size()
    const QPlcSignalDefinition &at(QPlcSignalIndex index) const { return m_signals.at(index); }
    QVector<QPlcSignalDefinition>::const_iterator begin() const { return m_signals.cbegin(); }
    QVector<QPlcSignalDefinition>::const_iterator end() const { return m_signals.cend(); }

    /// Index of the signal \a name, QPlcInvalidSignalIndex when there is none.
    QPlcSignalIndex indexOf(const QString &name) const { return m_indices.value(name, QPlcInvalidSignalIndex); }
    bool contains(const QString &name) const { return m_indices.contains(name); }
    /// Known names that look like \a name, closest first, at most \a count.
    QStringList closeNames(const QString &name, int count = 3) const;
    /// A sentence for a name that is not in the table: "unknown signal 'x'; did you mean 'y'?"
    QString unknownSignalText(const QString &name) const;

    /// FNV-1a-64 of "name:type:unit\n" of all signals in order, the type by its canonical name: equal tables have equal hashes on all machines.
    quint64 hash() const { return m_hash; }

private:
    static QPlcSignalTable read(qplc::TableReader reader, QVector<QPlcParseError> *errors);
    void add(const QPlcSignalDefinition &definition);

    QVector<QPlcSignalDefinition> m_signals;
    QHash<QString, QPlcSignalIndex> m_indices;
    quint64 m_hash = 0xCBF29CE484222325;  // as FNV-1a-64 begins
};

Q_DECLARE_METATYPE(QPlcSignalTable)
