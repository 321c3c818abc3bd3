// SPDX-License-Identifier: Apache-2.0
// qtplc: looks at a QtPLC master from the command line, and commands it.
#include "Commands.h"

#include <QtCore/QLoggingCategory>

#include <cstdio>

namespace {

using tools::Command;

QCommandLineOption option(const char *name, const QString &description, const char *valueName = "",
                          const QString &defaultValue = QString())
{
    return QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName), defaultValue);
}

QString helpText()
{
    QString text = QStringLiteral("Looks at a QtPLC master and commands it.\n\nCommands:\n");
    for (const Command &command : tools::commands())
        text += QStringLiteral("  %1 %2\n")
                    .arg(QStringLiteral("%1 %2").arg(QString::fromLatin1(command.name),
                                                     QString::fromLatin1(command.arguments)),
                         -22)
                    .arg(QString::fromLatin1(command.description));
    return text.chopped(1);
}

void addOptions(QPlcCoreApplication &application)
{
    application.addOption(option(
        "master",
        QStringLiteral("Where the master is, 127.0.0.1:%1 unless said.").arg(QPlcUnderlyingProtocol::DefaultPort),
        "HOST:PORT", QStringLiteral("127.0.0.1:%1").arg(QPlcUnderlyingProtocol::DefaultPort)));
    application.addOption(option("timeout", QStringLiteral("Longest wait for an answer, 5 unless said."), "SECONDS",
                                 QStringLiteral("5")));
    application.addOption(option("verbose", QStringLiteral("list, state: every column.")));
    application.addOption(option("cycles", QStringLiteral("start: ends by itself after so many."), "N"));
    application.addOption(
        option("rate", QStringLiteral("echo: most lines per second, 10 unless said."), "HZ", QStringLiteral("10")));
    application.addOption(option("count", QStringLiteral("echo: ends after so many lines."), "N"));
    application.addPositionalArgument(QStringLiteral("COMMAND"), QStringLiteral("One of those above."),
                                      QStringLiteral("COMMAND [ARGUMENT...]"));
}

/// \return null, with the message out, when there is no such command or it is not called as it should be
const Command *findCommand(QPlcCoreApplication &application)
{
    const QVector<Command> &all = tools::commands();
    const QStringList arguments = application.positionalArguments();
    QStringList names;
    for (const Command &command : all)
        names << QString::fromLatin1(command.name);
    const int index = arguments.isEmpty() ? -1 : names.indexOf(arguments.constFirst());
    if (index < 0) {
        const QString what = arguments.isEmpty() ? QStringLiteral("no command")
                                                 : QStringLiteral("unknown command '%1'").arg(arguments.constFirst());
        application.usageError(
            QStringLiteral("%1; use one of %2 (see --help)").arg(what, names.join(QStringLiteral(", "))));
        return nullptr;
    }
    const Command &command = all.at(index);
    const int given = arguments.size() - 1;
    if (given < command.minimumArguments || given > command.maximumArguments) {
        const QString usage
            = QStringLiteral("qtplc %1 %2").arg(names.at(index), QString::fromLatin1(command.arguments)).trimmed();
        application.usageError(
            QStringLiteral("%1 of arguments for %2; use %3")
                .arg(given > 0 ? QStringLiteral("wrong number") : QStringLiteral("lack"), names.at(index), usage));
        return nullptr;
    }
    return &command;
}

/// \return false, with the message out, when an option was given that the command does not have
bool hasOnlyItsOptions(QPlcCoreApplication &application, const Command &command)
{
    for (const Command &other : tools::commands()) {
        for (const QString &name : other.options) {
            if (application.isSet(name) && !command.options.contains(name)) {
                application.usageError(
                    QStringLiteral("%1 has no option --%2; see --help").arg(QString::fromLatin1(command.name), name));
                return false;
            }
        }
    }
    return true;
}

int run(QPlcCoreApplication &application)
{
    const Command *command = findCommand(application);
    double timeout = 0.0;
    if (!command || !hasOnlyItsOptions(application, *command)
        || !application.number(QStringLiteral("timeout"), 0.01, 3600.0, &timeout))
        return application.exitCode();
    QString error;
    const QPlcUnderlyingProtocol master = QPlcUnderlyingProtocol::fromString(
        application.value(QStringLiteral("master")), QPlcUnderlyingProtocol::Tcp, &error);
    if (!master.isValid())
        return application.usageError(QStringLiteral("--master: %1").arg(error));
    tools::ControlClient client(std::chrono::milliseconds(qRound64(timeout * 1e3)));
    if (!client.connectToMaster(master))
        return tools::reportFailure(client);
    return command->run({application, client, master, application.positionalArguments().mid(1)});
}

}  // namespace

int main(int argc, char **argv)
{
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    QPlcCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(
        QStringLiteral("qtplc.slave.info=false"));  // echo is a tool, not a node of the plant
    application.setDescription(helpText());
    application.setExamples({QStringLiteral("qtplc list"), QStringLiteral("qtplc start --cycles 1000"),
                             QStringLiteral("qtplc echo tetherLength power --rate 2"),
                             QStringLiteral("qtplc set tetherSpeed -1.5"),
                             QStringLiteral("qtplc --master 192.168.1.5:50000 state")});
    addOptions(application);
    if (!application.parseOptions())
        return application.exitCode();
    return run(application);
}
