// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonObject>
#include <QtCore/QString>

namespace awe {

/// What a person wants to know of the report of a flight, in a few lines.
QString summary(const QJsonObject &report);
/// Writes \a report as JSON; the file is there as a whole or not at all. \return false with a
/// sentence in \a error
bool writeReport(const QString &fileName, const QJsonObject &report, QString *error);
/// Whether writeReport() could write the file now; it is left as it is. \return false with a
/// sentence in \a error
bool canWriteReport(const QString &fileName, QString *error);

}  // namespace awe
