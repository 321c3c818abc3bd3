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

/// The signal table of a plant: all signals, in the order of the file.
///
/// \code{.ini}
/// ; the winch
/// [tetherSpeed]
/// type = Real
/// unit = m/s
/// min  = -10
/// max  = 10
/// safe = 0
/// \endcode
///
/// Each section is a signal. The key `type` is required (QPlcSignalType); `unit` and `description`
/// are texts for people. The other keys say which values are allowed, and what the signal is
/// without a value:
///
/// - `initial`: value before a node writes the signal. Default 0.
/// - `min`, `max`: limits of every element. A value outside is counted and not taken; NaN and
///   infinity likewise.
/// - `hold`: number of cycles (0 or more) for which the last good value is kept when no new one
///   comes. By default the profile of the plant decides (QPlcProfile): forever in a simulation, 3
///   in a plant.
/// - `safe`: value after that, until a good one comes. Default 0, or the limit closest to 0.
/// - `writer`: `A` means that only node A may write the signal. `A > B > C` means that these nodes
///   may; the first one with a fresh value is the source.
/// - `values`: names of the values of an integer or boolean signal: `values = 0: Off, 1: ReelOut`
///   (QPlcValueNames).
/// - `nan`: `allowed` means that NaN ("no measurement") is taken like a number.
/// - `slope`: `5 per second` means that a value which a person or a program sets moves each element
///   by at most 5 per second, while cycles run. Real types only.
/// - `volatile`: `yes` means that the signal measures the wall clock, as a workload does: two equal
///   runs give other values, and a replay does not compare them.
///
/// Comments begin with `;` or `#` at the start of a line, or with ` ;` behind a value. Commas
/// separate the values of an array ("0, 0, 1"); one number stands for all elements. The file is
/// UTF-8 with or without byte order mark. Lines end with LF or CRLF and have at most 4096 bytes. A
/// value that begins with `"` ends with `"`; inside, a backslash begins an escape as in C++
/// (newline, carriage return, tab, quotation mark, backslash). A signal name is a letter or
/// underscore followed by letters, digits, `_` or `.`, at most 63 characters.
///
/// \code
/// QVector<QPlcParseError> errors;
/// const QPlcSignalTable table = QPlcSignalTable::fromIniFile("signals.ini", &errors);
/// for (const QPlcSignalDefinition &signal : table)
///     qInfo("%s [%s]", qPrintable(signal.name), qPrintable(signal.unit));
/// \endcode
///
/// \threadsafe a value type that shares its data: several threads may read one object
///
/// \ingroup signals
class QTPLC_EXPORT QPlcSignalTable
{
public:
    /// Largest number of signals in a table: 65534.
    static constexpr int MaximumSignals = 65534;

    /// Makes an empty table.
    QPlcSignalTable() = default;

    /// Reads a table from the text of a file.
    /// \param errors  if given: all errors in the order of the text; behind the first hundred one
    ///     more entry says how many there are. Empty on success
    /// \param fileName  appears in the errors only
    /// \return an empty table on any error
    static QPlcSignalTable fromIni(const QByteArray &text, QVector<QPlcParseError> *errors = nullptr,
                                   const QString &fileName = QString());
    /// Reads a table that a master has sent, as fromIni() does. Keys that this version does not
    /// know are skipped, because the master may be newer.
    static QPlcSignalTable fromMaster(const QByteArray &text, QVector<QPlcParseError> *errors = nullptr);
    /// Reads a table from a file of at most 64 MiB, as fromIni() does. A file that cannot be read
    /// is one error.
    static QPlcSignalTable fromIniFile(const QString &fileName, QVector<QPlcParseError> *errors = nullptr);
    /// Returns the table as a text that fromIni() reads back as an equal table. Comments of the
    /// original file are lost.
    QByteArray toIni() const;

    /// Adds a signal at the end. Limits, initial and safe value are converted to its type; an
    /// initial value that is not set becomes zero.
    /// \param error  if given: why the definition is not valid; empty on success
    /// \return false when the definition is not valid, the name exists already, or the table is
    ///     full; the table has not changed then
    bool append(const QPlcSignalDefinition &definition, QString *error = nullptr);

    /// Returns true if the table has no signals.
    bool isEmpty() const { return m_signals.isEmpty(); }
    /// Returns the number of signals.
    int size() const { return m_signals.size(); }
    /// Returns the definition of a signal.
    /// \pre \a index < size()
    const QPlcSignalDefinition &at(QPlcSignalIndex index) const { return m_signals.at(index); }
    /// Returns an iterator to the definition of signal 0.
    QVector<QPlcSignalDefinition>::const_iterator begin() const { return m_signals.cbegin(); }
    /// Returns an iterator behind the last definition.
    QVector<QPlcSignalDefinition>::const_iterator end() const { return m_signals.cend(); }

    /// Returns the index of a signal; QPlcInvalidSignalIndex if the table has no such signal. Upper
    /// and lower case matter.
    QPlcSignalIndex indexOf(const QString &name) const { return m_indices.value(name, QPlcInvalidSignalIndex); }
    /// Returns true if the table has a signal of this name.
    bool contains(const QString &name) const { return m_indices.contains(name); }
    /// Returns the names in the table that resemble \a name, closest first, for a message.
    /// \param count  at most so many names
    QStringList closeNames(const QString &name, int count = 3) const;
    /// Returns a sentence about a name that the table does not have: "unknown signal 'x'; did you
    /// mean 'y'?"
    QString unknownSignalText(const QString &name) const;

    /// Returns the FNV-1a-64 hash of two lines for each signal, in their order: its name, canonical
    /// type and unit, and its safety parameters (`min`, `max`, `safe`, `hold`, `writer`, `nan`,
    /// `slope`). Section 6.3 of docs/protocol.md has the exact text. Equal tables have equal hashes
    /// on all machines. Descriptions, names of values and initial values do not count.
    quint64 hash() const { return m_hash; }
    /// Returns the FNV-1a-64 hash of the safety parameters of a signal: of the second one of these
    /// lines.
    /// \pre \a index < size()
    quint64 safetyHash(QPlcSignalIndex index) const { return m_safetyHashes.at(index); }
    /// Returns true if fromMaster() has read the table, and nothing has been appended since. A node
    /// with such a table takes a newer one of its master if the signals are the same.
    bool isFromMaster() const { return m_isFromMaster; }

private:
    Q_DECL_HIDDEN static QPlcSignalTable read(qplc::TableReader reader, QVector<QPlcParseError> *errors);
    Q_DECL_HIDDEN void add(const QPlcSignalDefinition &definition);

    QVector<QPlcSignalDefinition> m_signals;
    QHash<QString, QPlcSignalIndex> m_indices;
    QVector<quint64> m_safetyHashes;      // of each signal
    quint64 m_hash = 0xCBF29CE484222325;  // as FNV-1a-64 begins
    bool m_isFromMaster = false;
};

Q_DECLARE_METATYPE(QPlcSignalTable)
