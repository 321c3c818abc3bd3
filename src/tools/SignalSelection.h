// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <QtCore/QJsonObject>
#include <QtCore/QJsonValue>

namespace tools {

/// Whether \a text has *, ? or [: it then names all signals that match.
bool isPattern(const QString &text);
/// Names and patterns to names, each once, in the order in which they were given (those of a
/// pattern in the order of the table).
/// \return false, with the message out, when a name is unknown or a pattern matches nothing
bool selectSignals(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &wanted,
                   QStringList *names);
/// As above; all signals when nothing is wanted.
bool selectSignalsOrAll(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &wanted,
                        QStringList *names);

/// A value as JSON: numbers, arrays of numbers, texts. Not finite: null; an integer that a JSON
/// number cannot hold: its digits as a text.
QJsonValue toJson(const QPlcValue &value);
/// As above, from the text that the master sends.
QJsonValue toJson(const QPlcSignalDefinition &definition, const QString &text);
/// "1.5 m/s"
QString withUnit(const QString &value, const QString &unit);

}  // namespace tools
