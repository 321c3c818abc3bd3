// SPDX-License-Identifier: Apache-2.0
#include "SignalSelection.h"

#include "TerminalText.h"

#include <QtCore/QJsonArray>
#include <QtCore/QRegularExpression>

namespace tools {

namespace {

constexpr double largestInteger = 9007199254740992.0;  // that a JSON number holds exactly

QStringList matching(const QPlcSignalTable &table, const QString &pattern)
{
    const QRegularExpression expression(QRegularExpression::wildcardToRegularExpression(pattern));
    QStringList names;
    for (const QPlcSignalDefinition &definition : table) {
        if (expression.isValid() && expression.match(definition.name).hasMatch())
            names << definition.name;
    }
    return names;
}

/// A float keeps its few digits: 0.1, not 0.10000000149011612.
QJsonValue realToJson(const QString &text)
{
    bool isNumber = false;
    const double number = text.toDouble(&isNumber);
    return isNumber ? QJsonValue(number) : QJsonValue(QJsonValue::Null);
}

QJsonValue elementToJson(const QPlcSignalType &type, const QString &text)
{
    const QJsonValue number = realToJson(text);
    const bool isExact = qAbs(number.toDouble()) < largestInteger;
    return type.isInteger() && !isExact ? QJsonValue(text) : number;
}

}  // namespace

bool isPattern(const QString &text)
{
    return text.contains(QLatin1Char('*')) || text.contains(QLatin1Char('?')) || text.contains(QLatin1Char('['));
}

bool selectSignals(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &wanted,
                   QStringList *names)
{
    QStringList errors;
    for (const QString &text : wanted) {
        const QStringList found = isPattern(text) ? matching(table, text) : QStringList{text};
        if (found.isEmpty())
            errors << QStringLiteral("no signal matches '%1'; qtplc list shows all").arg(text);
        else if (!table.contains(found.constFirst()))
            errors << table.unknownSignalText(text);
        *names += found;
    }
    names->removeDuplicates();
    errors.removeDuplicates();
    if (!errors.isEmpty())
        application.usageError(errors.join(QStringLiteral("; ")));
    return errors.isEmpty();
}

bool selectSignalsOrAll(QPlcCoreApplication &application, const QPlcSignalTable &table, const QStringList &wanted,
                        QStringList *names)
{
    return selectSignals(application, table, wanted.isEmpty() ? QStringList{QStringLiteral("*")} : wanted, names);
}

QJsonValue toJson(const QPlcValue &value)
{
    const QPlcSignalType type = value.type();
    const QString text = value.toString();
    if (!type.isReal() && !type.isInteger())
        return text;
    if (type.count() == 1)
        return elementToJson(type, text);
    QJsonArray elements;
    const QStringList texts = text.split(QStringLiteral(", "));
    for (const QString &element : texts)
        elements.append(elementToJson(type, element));
    return elements;
}

QJsonValue toJson(const QPlcSignalDefinition &definition, const QString &text)
{
    return toJson(QPlcValue::fromString(definition.type, text));
}

QString withUnit(const QString &value, const QString &unit)
{
    return unit.isEmpty() ? value : QStringLiteral("%1 %2").arg(value, unit);
}

}  // namespace tools
