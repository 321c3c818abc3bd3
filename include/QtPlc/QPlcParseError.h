// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// One error in a text that was read, with its place: file, line, column.
///
/// \code
/// QVector<QPlcParseError> errors;
/// const QPlcSignalTable table = QPlcSignalTable::fromIniFile("signals.ini", &errors);
/// if (!errors.isEmpty())
///     qWarning("%s", qPrintable(QPlcParseError::toString(errors)));
/// \endcode
///
/// Readers of tables and configurations report all errors at once, in the order of the file.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup signals
struct QTPLC_EXPORT QPlcParseError
{
    QString file;     ///< name of the file as the caller gave it; may be empty
    int line = 0;     ///< line, from 1; 0: the error belongs to the text as a whole
    int column = 0;   ///< column in characters, from 1; 0: the error belongs to the whole line
    QString message;  ///< what is wrong (with the offending text), and what to do

    /// Returns "file:line:column: message". Parts that are not known are left out: without a file
    /// and a line it is the message alone.
    QString toString() const;
    /// Returns one line of toString() for each of \a errors; an empty text when there are none.
    static QString toString(const QVector<QPlcParseError> &errors);
};

Q_DECLARE_METATYPE(QPlcParseError)
