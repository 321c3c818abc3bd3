// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

#include <QtCore/QJsonArray>

namespace tools {

namespace {

void printStages(const QJsonArray &stages)
{
    TextTable table;
    table.addColumn(QStringLiteral("stage"), Right);
    table.addColumn(QStringLiteral("node"));
    table.addColumn(QStringLiteral("phase"));
    for (int i = 0; i < stages.size(); ++i) {
        const QJsonArray steps = stages.at(i).toArray();
        for (const QJsonValue &step : steps)
            table.addRow({QString::number(i + 1), step[QStringLiteral("node")].toString(),
                          step[QStringLiteral("phase")].toString()});
    }
    table.print();
}

void printLinks(const QJsonArray &links)
{
    TextTable table;
    for (const char *title : {"signal", "from", "to"})
        table.addColumn(QString::fromLatin1(title));
    table.addColumn(QStringLiteral("age [cycles]"), Right);
    table.addColumn(QStringLiteral("same cycle"));
    for (const QJsonValue &link : links)
        table.addRow({link[QStringLiteral("signal")].toString(), link[QStringLiteral("from")].toString(),
                      link[QStringLiteral("to")].toString(), QString::number(link[QStringLiteral("age")].toInt()),
                      link[QStringLiteral("sameCycle")].toBool() ? QStringLiteral("yes") : QString()});
    table.print();
}

}  // namespace

int showSchedule(const CommandCall &call)
{
    QPlcMessage answer;
    if (!call.connect() || !call.askFor(QPlcMessage::GetSchedule, QPlcMessage::Schedule, {}, &answer))
        return call.exitCode();
    if (call.isJson()) {
        printJson(QJsonDocument(answer.fields()));
        return QPlcCoreApplication::Success;
    }
    const QJsonArray stages = answer.fields().value(QStringLiteral("stages")).toArray();
    const QJsonArray links = answer.fields().value(QStringLiteral("links")).toArray();
    if (stages.isEmpty() && links.isEmpty()) {
        printLine(QStringLiteral("no nodes"));
        return QPlcCoreApplication::Success;
    }
    printStages(stages);
    printLine(QString());
    printLinks(links);
    return QPlcCoreApplication::Success;
}

}  // namespace tools
