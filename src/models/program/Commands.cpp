// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"

#include "QPlcApplicationOptions.h"

#include <QtCore/QTextStream>

namespace fmu {

const QVector<Command> &commands()
{
    static const QVector<Command> all{
        {"node", "runs an FMU as a node of a plant", runNode},
        {"run", "runs an FMU alone and writes its outputs to a CSV file", runAlone},
        {"info", "shows what an FMU is, and its variables", showInfo},
        {"signals", "prints a signal table for an FMU", printSignals},
        {"check", "runs an FMU twice and tells what is wrong with it", check},
        {"bench", "measures how long the steps of an FMU take", bench},
    };
    return all;
}

void addArguments(QPlcApplicationOptions &application, const char *command)
{
    application.addPositionalArgument(QStringLiteral("command"),
                                      QStringLiteral("The word '%1'.").arg(QLatin1String(command)),
                                      QString::fromLatin1(command));
    application.addPositionalArgument(QStringLiteral("file"), QStringLiteral("The FMU."), QStringLiteral("FILE.fmu"));
}

QString fileOf(QPlcApplicationOptions &application)
{
    const QStringList arguments = application.positionalArguments();
    if (arguments.size() == 2)
        return arguments.at(1);
    application.usageError(QStringLiteral("name one FMU: qtplc_fmu %1 model.fmu").arg(arguments.value(0)));
    return {};
}

void print(const QString &text)
{
    QTextStream(stdout) << text << Qt::endl;
}

}  // namespace fmu
