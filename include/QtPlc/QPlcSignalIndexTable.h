// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalTable.h"

/// The signal table of the process: nodes and lists look signal names up in it.
///
/// \code
/// QPlcSignalIndexTable signalIndexTable;
/// if (!signalIndexTable.initializeFromIniFile("SignalIndexTable.ini"))
///     qFatal("%s", qPrintable(signalIndexTable.errorString()));
/// const QPlcSignalIndex speed = QPlcSignalIndexTable::index("tetherSpeed");
/// \endcode
///
/// The table outlives the object that has read it. A program that reads no table gets the table of
/// the first master to which one of its nodes connects.
///
/// \threadsafe the static functions are; an object belongs to one thread. A node keeps the table
///     with which it was registered, even if the table of the process changes
///
/// \ingroup signals
class QTPLC_EXPORT QPlcSignalIndexTable
{
public:
    /// Makes an object that reads tables. The table of the process does not change.
    QPlcSignalIndexTable() = default;

    /// Reads a file (QPlcSignalTable::fromIniFile()) and makes it the table of the process.
    /// \return false when the file has errors: errorString() lists all of them, and the table of
    ///     the process is still the old one
    bool initializeFromIniFile(const QString &fileName);
    /// Does the same with a text.
    /// \param fileName  appears in the errors only
    bool initializeFromIni(const QByteArray &text, const QString &fileName = QString());
    /// Returns all errors of the last call, one per line ("file:line:column: what, and the
    /// remedy"); empty: there are none.
    QString errorString() const { return QPlcParseError::toString(m_errors); }
    /// Returns all errors of the last call, in the order of the file.
    QVector<QPlcParseError> errors() const { return m_errors; }

    /// Returns the errors of the table that this process has read last; empty: there were none. For
    /// messages about a table that is missing.
    static QString lastErrorString();

    /// Returns the table of the process; an empty table before the first one was read.
    static QPlcSignalTable current();
    /// Makes \a table the table of the process. Lists that were made before keep their indices,
    /// which may mean other signals now.
    static void setCurrent(const QPlcSignalTable &table);

    /// Returns the index of a signal in the table of the process; QPlcInvalidSignalIndex if there
    /// is no such signal.
    static QPlcSignalIndex index(const QString &name) { return current().indexOf(name); }
    /// Returns the name of a signal of the table of the process; empty for an index that it does
    /// not have.
    static QString name(QPlcSignalIndex index);
    /// Returns the type of a signal of the table of the process; an invalid type for an index that
    /// it does not have.
    static QPlcSignalType type(QPlcSignalIndex index);

private:
    Q_DECL_HIDDEN bool take(const QPlcSignalTable &table);

    QVector<QPlcParseError> m_errors;
};
