// SPDX-License-Identifier: Apache-2.0
#include "Help.h"

#include "TerminalText.h"

namespace tools {

namespace {

const char exitCodes[] = "Exit codes: 0 success, 1 failure, 2 could not begin (bad call, no master).";

QString optionText(const Option &option)
{
    const QString name = QStringLiteral("--%1 %2").arg(QLatin1String(option.name), QLatin1String(option.value));
    return QStringLiteral("  %1 %2\n").arg(name.trimmed(), -20).arg(QLatin1String(option.description));
}

QString optionTexts(const QVector<Option> &options)
{
    QString text;
    for (const Option &option : options)
        text += optionText(option);
    return text;
}

}  // namespace

QString generalHelp()
{
    QString text = QStringLiteral("Usage: qtplc COMMAND [ARGUMENT...] [--OPTION...]\n"
                                  "Looks at a QtPLC master and commands it.\n\nCommands:\n");
    for (const Command &command : commands())
        text += QStringLiteral("  %1 %2\n").arg(QLatin1String(command.name), -20).arg(QLatin1String(command.summary));
    text += QStringLiteral("\nOptions of every command:\n%1").arg(optionTexts(commonOptions()));
    text += optionText({"help", "", "This help; behind a command: that of the command."});
    text += optionText({"version", "", "Shows the version."});
    text += QStringLiteral("\nExamples:\n  qtplc list\n  qtplc --master 192.168.1.5:50000 state\n"
                           "  qtplc help watch\n\n%1\n")
                .arg(QLatin1String(exitCodes));
    return text;
}

QString helpOf(const Command &command)
{
    QString text
        = QStringLiteral("Usage: qtplc %1 %2").arg(QLatin1String(command.name), QLatin1String(command.usage)).trimmed();
    text += QStringLiteral(" [--OPTION...]\n%1\n").arg(QLatin1String(command.summary));
    if (*command.details)
        text += QStringLiteral("\n%1\n").arg(QLatin1String(command.details));
    text += QStringLiteral("\nOptions:\n%1%2").arg(optionTexts(command.options), optionTexts(commonOptions()));
    text += QStringLiteral("\nExamples:\n  %1\n").arg(command.examples.join(QStringLiteral("\n  ")));
    return text + QStringLiteral("\n%1\n").arg(QLatin1String(exitCodes));
}

int showHelp(const CommandCall &call)
{
    const Command *command = call.arguments.isEmpty() ? nullptr : findCommand(call.arguments.constFirst());
    if (!command && !call.arguments.isEmpty())
        return call.application.usageError(unknownCommand(call.arguments.constFirst()));
    printText(command ? helpOf(*command) : generalHelp());
    return QPlcCoreApplication::Success;
}

}  // namespace tools
