// SPDX-License-Identifier: Apache-2.0
// list, get: what the master says of its signals at this moment.
#include "Commands.h"
#include "SignalSelection.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

constexpr int signalsPerAnswer = 500;  // an answer has at most 1 MiB

/// The wanted signals as the master describes them. \return false, with the message out
bool askForSignals(const CommandCall &call, QPlcSignalTable *table, QVector<QJsonObject> *rows)
{
    QStringList names;
    if (!call.connect(table) || !selectSignalsOrAll(call.application, *table, call.arguments, &names))
        return false;
    for (int first = 0; first < names.size(); first += signalsPerAnswer) {
        QPlcMessage answer;
        const QJsonArray wanted = QJsonArray::fromStringList(names.mid(first, signalsPerAnswer));
        if (!call.ask(QPlcMessage(QPlcMessage::GetSignals, {{QStringLiteral("names"), wanted}}), &answer))
            return false;
        const QJsonArray part = answer.fields().value(QStringLiteral("signals")).toArray();
        for (const QJsonValue &row : part)
            rows->append(row.toObject());
    }
    return true;
}

QString text(const QJsonObject &row, const char *field)
{
    return row.value(QLatin1String(field)).toString();
}

QJsonValue valueOf(const QPlcSignalTable &table, const QJsonObject &row)
{
    const QPlcSignalIndex index = table.indexOf(text(row, "name"));
    return index == QPlcInvalidSignalIndex ? QJsonValue(text(row, "value"))
                                           : toJson(table.at(index), text(row, "value"));
}

/// What people read: names of values where the table has some.
QString readableValue(const QPlcSignalTable &table, const QJsonObject &row)
{
    const QString value = text(row, "value");
    const QPlcSignalIndex index = table.indexOf(text(row, "name"));
    if (index == QPlcInvalidSignalIndex || table.at(index).valueNames.isEmpty())
        return value;
    return table.at(index).textOf(QPlcValue::fromString(table.at(index).type, value));
}

QJsonObject namesOf(const QPlcSignalTable &table, const QJsonObject &row)
{
    QJsonObject names;
    const QPlcSignalIndex index = table.indexOf(text(row, "name"));
    if (index != QPlcInvalidSignalIndex) {
        for (const QPlcValueNames::Entry &entry : table.at(index).valueNames)
            names.insert(QString::number(entry.value), entry.name);
    }
    return names;
}

/// "B of A > B": of several writers the one whose values the signal has.
QString writerOf(const QJsonObject &row)
{
    const QString source = text(row, "source");
    const QString writer = text(row, "writer");
    return source.isEmpty() || source == writer ? writer : QStringLiteral("%1 of %2").arg(source, writer);
}

void printTable(const QPlcSignalTable &signalTable, const QVector<QJsonObject> &rows, bool verbose)
{
    QStringList fields{QStringLiteral("name"), QStringLiteral("type"),    QStringLiteral("value"),
                       QStringLiteral("unit"), QStringLiteral("quality"), QStringLiteral("writer")};
    if (verbose)
        fields << QStringLiteral("description");
    TextTable table;
    for (const QString &field : qAsConst(fields))
        table.addColumn(field, field == QLatin1String("value") ? Right : Left);
    for (const QJsonObject &row : rows) {
        QStringList cells;
        for (const QString &field : qAsConst(fields))
            cells << (field == QLatin1String("value")         ? readableValue(signalTable, row)
                          : field == QLatin1String("quality") ? qualityOf(row).toString()
                          : field == QLatin1String("writer")  ? writerOf(row)
                                                              : row.value(field).toString());
        table.addRow(cells);
        table.setTone(fields.indexOf(QStringLiteral("quality")), toneOfQuality(qualityOf(row).toString()));
    }
    table.print();
}

}  // namespace

int listSignals(const CommandCall &call)
{
    QPlcSignalTable table;
    QVector<QJsonObject> rows;
    if (!askForSignals(call, &table, &rows))
        return call.exitCode();
    if (!call.isJson()) {
        printTable(table, rows, call.application.isSet(QStringLiteral("verbose")));
        return QPlcCoreApplication::Success;
    }
    QJsonArray array;
    for (QJsonObject &row : rows) {
        row.insert(QStringLiteral("value"), valueOf(table, row));
        const QJsonObject names = namesOf(table, row);
        if (!names.isEmpty())
            row.insert(QStringLiteral("names"), names);
        row.insert(QStringLiteral("quality"), qualityOf(row).toString());
        array.append(row);
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
    QVector<QJsonObject> rows;
    if (!askForSignals(call, &table, &rows))
        return call.exitCode();
    QJsonObject values;
    for (const QJsonObject &row : qAsConst(rows)) {
        const QString value = printable(isPlain ? text(row, "value") : readableValue(table, row));
        const QPlcQuality quality = qualityOf(row);
        const QString doubt = quality.isGood()
            ? QString()
            : toned(QStringLiteral("  (%1)").arg(quality.toString()), toneOfQuality(quality.toString()));
        if (call.isJson())
            values.insert(text(row, "name"), valueOf(table, row));
        else
            printLine(isPlain ? value
                              : QStringLiteral("%1 = %2%3")
                                    .arg(text(row, "name"), withUnit(value, printable(text(row, "unit"))), doubt));
    }
    if (call.isJson())
        printJson(QJsonDocument(values));
    return QPlcCoreApplication::Success;
}

}  // namespace tools
