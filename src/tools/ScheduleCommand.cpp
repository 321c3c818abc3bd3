// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace {

void printStages(const QPlcSchedule &schedule)
{
    TextTable table;
    table.addColumn(QStringLiteral("stage"), Right);
    table.addColumn(QStringLiteral("node"));
    table.addColumn(QStringLiteral("phase"));
    for (int i = 0; i < schedule.stages.size(); ++i) {
        for (const QPlcSchedule::Turn &turn : schedule.stages.at(i))
            table.addRow({QString::number(i + 1), turn.node, QPlcSchedule::phaseName(turn.phase)});
    }
    table.print();
}

void printLinks(const QPlcSchedule &schedule)
{
    TextTable table;
    for (const char *title : {"signal", "from", "to"})
        table.addColumn(QString::fromLatin1(title));
    table.addColumn(QStringLiteral("age [cycles]"), Right);
    table.addColumn(QStringLiteral("same cycle"));
    for (const QPlcSchedule::Link &link : schedule.links)
        table.addRow({link.signal, link.from, link.to, QString::number(link.age),
                      link.sameCycle ? QStringLiteral("yes") : QString()});
    table.print();
}

}  // namespace

int showSchedule(const CommandCall &call)
{
    qplc::messages::Schedule schedule;
    if (!call.connect() || !call.askFor(qplc::messages::GetSchedule(), &schedule))
        return call.exitCode();
    if (call.isJson()) {
        printJson(call.client.lastAnswer());
        return QPlcCoreApplication::Success;
    }
    if (schedule.stages.isEmpty() && schedule.links.isEmpty()) {
        printLine(QStringLiteral("no nodes"));
        return QPlcCoreApplication::Success;
    }
    printStages(schedule);
    printLine(QString());
    printLinks(schedule);
    return QPlcCoreApplication::Success;
}

}  // namespace tools
