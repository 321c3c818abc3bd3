// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

constexpr int signalsPerAnswer = 500;  // an answer has at most 1 MiB

QStringList namesOf(const QPlcSignalTable &table)
{
    QStringList names;
    for (const QPlcSignalDefinition &definition : table)
        names << definition.name;
    return names;
}

}  // namespace

int listSignals(const CommandCall &call)
{
    const QPlcSignalTable table = call.client.table();
    if (table.isEmpty())
        return reportFailure(call.client);
    const bool verbose = call.application.isSet(QStringLiteral("verbose"));
    QStringList fields{QStringLiteral("name"), QStringLiteral("type"), QStringLiteral("unit"), QStringLiteral("value"),
                       QStringLiteral("writer")};
    if (verbose)
        fields << QStringLiteral("description");
    TextTable text;
    for (const QString &field : qAsConst(fields))
        text.addColumn(field);

    const QStringList names = namesOf(table);
    for (int first = 0; first < names.size(); first += signalsPerAnswer) {
        QPlcMessage answer;
        const QJsonArray wanted = QJsonArray::fromStringList(names.mid(first, signalsPerAnswer));
        if (!call.client.ask(QPlcMessage(QPlcMessage::GetSignals, {{QStringLiteral("names"), wanted}}), &answer))
            return reportFailure(call.client);
        const QJsonArray rows = answer.fields().value(QStringLiteral("signals")).toArray();
        for (const QJsonValue &row : rows) {
            QStringList cells;
            for (const QString &field : qAsConst(fields))
                cells << row.toObject().value(field).toString();
            text.addRow(cells);
        }
    }
    text.print();
    return QPlcCoreApplication::Success;
}

}  // namespace tools
