// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// One thing that is wrong with a text, and where.
struct QTPLC_EXPORT QPlcParseError
{
    QString file;     ///< as given by the caller, may be empty
    int line = 0;     ///< from 1; 0: the text as a whole
    int column = 0;   ///< from 1, in characters; 0: the line as a whole
    QString message;  ///< what is wrong (with the offending text), and the remedy

    /// "file:line:column: message", without the parts that are not known.
    QString toString() const;
    /// One line for each of \a errors.
    static QString toString(const QVector<QPlcParseError> &errors);
};

Q_DECLARE_METATYPE(QPlcParseError)
