// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace {

/// Reads "SIGNAL VALUE SIGNAL VALUE ...". \return false, with the message out, when a value cannot be meant
bool readValues(const CommandCall &call, const QPlcSignalTable &table, QJsonObject *values, QStringList *texts)
{
    QStringList names;
    for (int i = 0; i < call.arguments.size(); i += 2)
        names << call.arguments.at(i);
    if (!knowsSignals(call.application, table, names))
        return false;
    for (int i = 0; i < names.size(); ++i) {
        const QPlcSignalDefinition &definition = table.at(table.indexOf(names.at(i)));
        QString error;
        const QPlcValue value = QPlcValue::fromString(definition.type, call.arguments.at(2 * i + 1), &error);
        if (!value.isValid())
            error = QStringLiteral("signal '%1': %2").arg(definition.name, error);
        else if (values->contains(definition.name))
            error = QStringLiteral("signal '%1' is there twice; give it one value").arg(definition.name);
        if (!error.isEmpty()) {
            call.application.usageError(error);
            return false;
        }
        values->insert(definition.name, value.toString());
        *texts << QStringLiteral("%1 = %2").arg(
            definition.name, QStringList{value.toString(), definition.unit}.join(QLatin1Char(' ')).trimmed());
    }
    return true;
}

}  // namespace

int setSignals(const CommandCall &call)
{
    if (call.arguments.size() % 2 != 0)
        return call.application.usageError(
            QStringLiteral("signal '%1' has no value; use qtplc set SIGNAL VALUE ...").arg(call.arguments.constLast()));
    const QPlcSignalTable table = call.client.table();
    if (table.isEmpty())
        return reportFailure(call.client);
    QJsonObject values;
    QStringList texts;
    if (!readValues(call, table, &values, &texts))
        return call.application.exitCode();
    if (!call.client.ask(QPlcMessage(QPlcMessage::SetSignals, {{QStringLiteral("values"), values}})))
        return reportFailure(call.client);
    for (const QString &text : qAsConst(texts))
        printLine(text);
    return QPlcCoreApplication::Success;
}

}  // namespace tools
