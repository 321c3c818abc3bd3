// SPDX-License-Identifier: Apache-2.0
// qtplc_fmu: FMUs, models and controllers that simulation tools have exported, as nodes and alone.
#include "Commands.h"
#include "CrashReport.h"
#include "QPlcCoreApplication.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <cstdio>

namespace {

QString helpText()
{
    QString text = QStringLiteral("Usage: qtplc_fmu COMMAND FILE [options]\n"
                                  "FMUs (FMI 2.0 and 3.0, co-simulation) as nodes of a plant, and alone.\n\n"
                                  "An FMU is a program of somebody else, with all your rights: run only those that you "
                                  "trust.\n\nCommands:\n");
    for (const fmu::Command &command : fmu::commands())
        text += QStringLiteral("  %1 %2\n").arg(QLatin1String(command.name), -8).arg(QLatin1String(command.summary));
    return text
        + QStringLiteral("\nqtplc_fmu COMMAND --help shows the options of a command.\n\nExamples:\n"
                         "  qtplc_fmu info model.fmu\n  qtplc_fmu run model.fmu --stop 10 --out model.csv\n"
                         "  qtplc_fmu node model.ini --master 192.168.1.5");
}

int explain(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setHelpText(helpText);
    application.addPositionalArgument(QStringLiteral("COMMAND"), QString());
    if (!application.parseOptions())
        return application.exitCode();
    QStringList names;
    for (const fmu::Command &command : fmu::commands())
        names << QString::fromLatin1(command.name);
    const QString name = application.positionalArguments().value(0);
    if (name.isEmpty())
        return application.usageError(
            QStringLiteral("name a command: %1 (see --help)").arg(names.join(QStringLiteral(", "))));
    return application.usageError(QStringLiteral("there is no command %1%2 (see --help)")
                                      .arg(qplc::quoted(name), qplc::didYouMean(qplc::closeNames(name, names))));
}

}  // namespace

int main(int argc, char **argv)
{
    fmu::CrashReport::install();
    const QByteArray name = argc > 1 ? argv[1] : "";
    const auto command = std::find_if(fmu::commands().begin(), fmu::commands().end(),
                                      [&](const fmu::Command &other) { return name == other.name; });
    const int code = command == fmu::commands().end() ? explain(argc, argv) : command->run(argc, argv);
    if (code != QPlcCoreApplication::Success || (std::fflush(stdout) == 0 && !std::ferror(stdout)))
        return code;
    QPlcCoreApplication::printError(
        QStringLiteral("the output cannot be written: its disk is full, or nobody reads it"));
    return QPlcCoreApplication::Failure;
}
