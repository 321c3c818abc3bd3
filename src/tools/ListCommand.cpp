// SPDX-License-Identifier: Apache-2.0
// list, get: what the master says of its signals at this moment.
#include "Commands.h"
#include "SignalSelection.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace messages = qplc::messages;

namespace {

using Row = messages::SignalEntry;

/// The wanted signals as the master describes them. \return false, with the message out
bool askForSignals(const CommandCall &call, QPlcSignalTable *table, std::vector<Row> *rows)
{
    QStringList names;
    return call.connect(table) && selectSignalsOrAll(call.application, *table, call.arguments, &names)
        && call.tell(call.client.askForSignals(names, rows));
}

QJsonValue valueOf(const QPlcSignalTable &table, const Row &row)
{
    const QPlcSignalIndex index = table.indexOf(row.name);
    return index == QPlcInvalidSignalIndex ? QJsonValue(row.value) : toJson(table.at(index), row.value);
}

/// What people read: names of values where the table has some.
QString readableValue(const QPlcSignalTable &table, const Row &row)
{
    const QPlcSignalIndex index = table.indexOf(row.name);
    if (index == QPlcInvalidSignalIndex || table.at(index).valueNames.isEmpty())
        return row.value;
    return table.at(index).textOf(QPlcValue::fromString(table.at(index).type, row.value));
}

QJsonObject namesOf(const QPlcSignalTable &table, const Row &row)
{
    QJsonObject names;
    const QPlcSignalIndex index = table.indexOf(row.name);
    if (index != QPlcInvalidSignalIndex) {
        for (const QPlcValueNames::Entry &entry : table.at(index).valueNames)
            names.insert(QString::number(entry.value), entry.name);
    }
    return names;
}

QString qualityOf(const Row &row)
{
    return QPlcQuality::fromByte(row.quality).toString();
}

/// "B of A > B": of several writers the one whose values the signal has.
QString writerOf(const Row &row)
{
    const QString source = row.source.value_or(QString());
    return source.isEmpty() || source == row.writer ? row.writer : QStringLiteral("%1 of %2").arg(source, row.writer);
}

void printTable(const QPlcSignalTable &signalTable, const std::vector<Row> &rows, bool verbose)
{
    constexpr int qualityColumn = 4;
    TextTable table;
    table.addColumn(QStringLiteral("name"));
    table.addColumn(QStringLiteral("type"));
    table.addColumn(QStringLiteral("value"), Right);
    for (const char *title : {"unit", "quality", "writer"})
        table.addColumn(QString::fromLatin1(title));
    if (verbose)
        table.addColumn(QStringLiteral("description"));
    for (const Row &row : rows) {
        QStringList cells{row.name, row.type, readableValue(signalTable, row), row.unit, qualityOf(row), writerOf(row)};
        if (verbose)
            cells << row.description;
        table.addRow(cells);
        table.setTone(qualityColumn, toneOfQuality(qualityOf(row)));
    }
    table.print();
}

}  // namespace

int listSignals(const CommandCall &call)
{
    QPlcSignalTable table;
    std::vector<Row> rows;
    if (!askForSignals(call, &table, &rows))
        return call.exitCode();
    if (!call.isJson()) {
        printTable(table, rows, call.application.isSet(QStringLiteral("verbose")));
        return QPlcCoreApplication::Success;
    }
    QJsonArray array;
    for (const Row &row : rows) {
        QJsonObject object = messages::toObject(row);
        object.insert(QStringLiteral("value"), valueOf(table, row));
        const QJsonObject names = namesOf(table, row);
        if (!names.isEmpty())
            object.insert(QStringLiteral("names"), names);
        object.insert(QStringLiteral("quality"), qualityOf(row));
        const QPlcSignalIndex index = table.indexOf(row.name);
        if (index != QPlcInvalidSignalIndex && table.at(index).isVolatile)
            object.insert(QStringLiteral("volatile"), true);
        array.append(object);
    }
    printJson(QJsonDocument(array));
    return QPlcCoreApplication::Success;
}

int getSignals(const CommandCall &call)
{
    const bool isPlain = call.application.isSet(QStringLiteral("plain"));
    if (isPlain && call.isJson())
        return call.application.usageError(QStringLiteral("--plain and --json exclude each other; use one of them"));
    QPlcSignalTable table;
    std::vector<Row> rows;
    if (!askForSignals(call, &table, &rows))
        return call.exitCode();
    QJsonObject values;
    for (const Row &row : rows) {
        const QString value = printable(isPlain ? row.value : readableValue(table, row));
        const QString doubt = QPlcQuality::fromByte(row.quality).isGood()
            ? QString()
            : toned(QStringLiteral("  (%1)").arg(qualityOf(row)), toneOfQuality(qualityOf(row)));
        if (call.isJson())
            values.insert(row.name, valueOf(table, row));
        else
            printLine(isPlain ? value
                              : QStringLiteral("%1 = %2%3").arg(row.name, withUnit(value, printable(row.unit)), doubt));
    }
    if (call.isJson())
        printJson(QJsonDocument(values));
    return QPlcCoreApplication::Success;
}

}  // namespace tools
