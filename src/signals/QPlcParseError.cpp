// SPDX-License-Identifier: Apache-2.0
#include "QPlcParseError.h"

#include <QtCore/QStringList>

QString QPlcParseError::toString() const
{
    QStringList place;
    if (!file.isEmpty())
        place.append(file);
    if (line > 0)
        place.append(QString::number(line));
    if (line > 0 && column > 0)
        place.append(QString::number(column));
    return place.isEmpty() ? message : place.join(QLatin1Char(':')) + QStringLiteral(": ") + message;
}

QString QPlcParseError::toString(const QVector<QPlcParseError> &errors)
{
    QStringList lines;
    for (const QPlcParseError &error : errors)
        lines.append(error.toString());
    return lines.join(QLatin1Char('\n'));
}
