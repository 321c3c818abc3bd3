// SPDX-License-Identifier: Apache-2.0
// qtplc: looks at a QtPLC master from the command line, and commands it.
#include "Commands.h"
#include "Help.h"
#include "TerminalText.h"

#include <QtCore/QLoggingCategory>

#include <cstdio>

namespace {

using tools::Command;
using tools::Option;

const QString defaultMaster = QStringLiteral("127.0.0.1:%1").arg(QPlcUnderlyingProtocol::DefaultPort);

void addOptions(QPlcCoreApplication &application)
{
    QVector<Option> options = tools::commonOptions();
    for (const Command &command : tools::commands())
        options += command.options;
    QStringList added;
    for (const Option &option : qAsConst(options)) {
        const QString name = QString::fromLatin1(option.name);
        QStringList names{name, QString::fromLatin1(option.letter)};
        names.removeAll(QString());
        if (!added.contains(name))
            application.addOption(QCommandLineOption(names, QString(), QString::fromLatin1(option.value)));
        added << name;
    }
    application.addPositionalArgument(QStringLiteral("COMMAND"), QString());
}

/// \return null, with the message out, when there is no such command
const Command *commandOf(QPlcCoreApplication &application)
{
    const QString name = application.positionalArguments().value(0);
    const Command *command = tools::findCommand(name);
    if (!command)
        application.usageError(QStringLiteral("%1 (see --help)").arg(tools::unknownCommand(name)));
    return command;
}

/// \return false, with the message out, when the command has not as many arguments as it should
bool hasItsArguments(QPlcCoreApplication &application, const Command &command)
{
    const int given = application.positionalArguments().size() - 1;
    if (given >= command.minimumArguments && given <= command.maximumArguments)
        return true;
    const QString name = QString::fromLatin1(command.name);
    const QString usage = QStringLiteral("qtplc %1 %2").arg(name, QString::fromLatin1(command.usage)).trimmed();
    const QString text = given > 0 ? QStringLiteral("wrong number of arguments for %1; use %2")
                                   : QStringLiteral("%1 needs arguments; use %2");
    application.usageError(text.arg(name, usage));
    return false;
}

/// \return false, with the message out, when an option was given that the command does not have
bool hasOnlyItsOptions(QPlcCoreApplication &application, const Command &command)
{
    QStringList own;
    for (const Option &option : command.options)
        own << QString::fromLatin1(option.name);
    for (const Command &other : tools::commands()) {
        for (const Option &option : other.options) {
            const QString name = QString::fromLatin1(option.name);
            if (application.isSet(name) && !own.contains(name)) {
                application.usageError(QStringLiteral("%1 has no option --%2; see qtplc %1 --help")
                                           .arg(QString::fromLatin1(command.name), name));
                return false;
            }
        }
    }
    return true;
}

/// Help of the command that was named, or of all.
QString helpText(const QPlcCoreApplication &application)
{
    const Command *command = tools::findCommand(application.positionalArguments().value(0));
    return command ? tools::helpOf(*command) : tools::generalHelp();
}

int run(QPlcCoreApplication &application)
{
    const Command *command = commandOf(application);
    double timeout = 5.0;
    if (!command || !hasItsArguments(application, *command) || !hasOnlyItsOptions(application, *command)
        || (application.isSet(QStringLiteral("timeout"))
            && !application.number(QStringLiteral("timeout"), 0.01, 3600.0, &timeout)))
        return application.exitCode();
    QString error;
    const QString address
        = application.isSet(QStringLiteral("master")) ? application.value(QStringLiteral("master")) : defaultMaster;
    const QPlcUnderlyingProtocol master
        = QPlcUnderlyingProtocol::fromString(address, QPlcUnderlyingProtocol::Automatic, &error);
    if (!master.isValid())
        return application.usageError(QStringLiteral("--master: %1").arg(error));
    QPlcSecurity security;
    if (command->run != &tools::manageKeys) {  // which has --keys of its own
        if (!application.readSecurityOptions(QPlcSecurity::NodeSide, &security))
            return application.exitCode();
        QPlcSecurity::setCurrent(security);
    }
    tools::BlockingClient client(std::chrono::milliseconds(qRound64(timeout * 1e3)));
    return command->run({application, client, master, application.positionalArguments().mid(1)});
}

}  // namespace

int main(int argc, char **argv)
{
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    QPlcCoreApplication application(argc, argv);
    application.setHelpText([&application] { return helpText(application); });
    QLoggingCategory::setFilterRules(
        QStringLiteral("qtplc.slave.info=false"));  // a tool that listens is no node of the plant
    addOptions(application);
    if (!application.parseOptions())
        return application.exitCode();
    return run(application);
}
