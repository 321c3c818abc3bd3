// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalTable.h"

/// The signal table of this process: what signal names in nodes and lists are looked up in.
///
/// ```cpp
/// QPlcSignalIndexTable signalIndexTable;
/// if (!signalIndexTable.initializeFromIniFile("SignalIndexTable.ini"))
///     qFatal("%s", qPrintable(signalIndexTable.errorString()));
/// ```
///
/// The table outlives the object that read it. A program that never reads one gets the table of the first master to which one of its nodes connects.
/// \threadsafe yes: reading and replacing; a node keeps the table that it was registered with.
class QTPLC_EXPORT QPlcSignalIndexTable
{
public:
    QPlcSignalIndexTable() = default;

    /// Reads \a fileName and makes it the table of the process.
    /// \return false when the file has errors: errorString() then names all of them and the table of the process is as before
    bool initializeFromIniFile(const QString &fileName);
    bool initializeFromIni(const QByteArray &text, const QString &fileName = QString());
    /// All errors of the last call, one a line ("file:line:column: what, and the remedy"); empty: none.
    QString errorString() const { return QPlcParseError::toString(m_errors); }
    QVector<QPlcParseError> errors() const { return m_errors; }

    /// What was wrong with the table that this process read last; empty: nothing. For messages about a table that is not there.
    static QString lastErrorString();

    /// The table of the process; empty before the first.
    static QPlcSignalTable current();
    static void setCurrent(const QPlcSignalTable &table);

    // Look-ups in the table of the process.
    static QPlcSignalIndex index(const QString &name) { return current().indexOf(name); }
    static QString name(QPlcSignalIndex index);
    static QPlcSignalType type(QPlcSignalIndex index);

private:
    bool take(const QPlcSignalTable &table);

    QVector<QPlcParseError> m_errors;
};
