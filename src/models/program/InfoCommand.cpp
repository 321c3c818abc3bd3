// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "QPlcCoreApplication.h"
#include "models/FmuModel.h"
#include "signals/MessageText.h"

namespace fmu {

namespace {

using qplc::FmuDescription;
using qplc::FmuVariable;

void printLine(const char *what, const QString &text)
{
    if (!text.isEmpty())
        print(QStringLiteral("%1 %2").arg(QLatin1String(what), -14).arg(qplc::printable(text)));
}

QString secondsText(const std::optional<double> &seconds)
{
    return seconds ? QStringLiteral("%1 s").arg(*seconds) : QString();
}

QString experimentText(const FmuDescription &description)
{
    QStringList parts;
    const auto add = [&](const char *what, const QString &text) {
        if (!text.isEmpty())
            parts << QStringLiteral("%1 %2").arg(QLatin1String(what), text);
    };
    add("from", secondsText(description.startTime));
    add("to", secondsText(description.stopTime));
    add("step", secondsText(description.stepSize));
    add("tolerance", description.tolerance ? QString::number(*description.tolerance) : QString());
    return parts.join(QStringLiteral(", "));
}

QString rangeText(const FmuVariable &variable)
{
    if (variable.minimum.isEmpty() && variable.maximum.isEmpty())
        return {};
    return QStringLiteral(" %1 ... %2").arg(variable.minimum, variable.maximum);
}

void printVariables(const FmuDescription &description, bool all)
{
    int hidden = 0;
    for (const FmuVariable &variable : description.variables) {
        if (!all
            && (variable.causality == FmuVariable::Local || variable.causality == FmuVariable::CalculatedParameter)) {
            ++hidden;
            continue;
        }
        const QString unit = variable.unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(variable.unit);
        const QString start = variable.start.isEmpty()
            ? QString()
            : QStringLiteral(" = %1").arg(variable.start.size() > 40 ? variable.start.left(37) + QStringLiteral("...")
                                                                     : variable.start);
        print(qplc::printable(
            QStringLiteral("  %1 %2 %3%4%5%6%7")
                .arg(variable.causalityText(), -10)
                .arg(variable.typeText(description.version), -12)
                .arg(variable.name, unit, start, rangeText(variable),
                     variable.description.isEmpty() ? QString() : QStringLiteral("  %1").arg(variable.description))));
    }
    if (hidden > 0)
        print(QStringLiteral("  and %1 local ones (--all shows them)").arg(hidden));
}

}  // namespace

int showInfo(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(QStringLiteral("Shows what an FMU is, and its variables. It runs no code of the FMU."));
    application.setExamples({QStringLiteral("qtplc_fmu info model.fmu")});
    addArguments(application, "info");
    application.addOption({QStringLiteral("all"), QStringLiteral("Shows local variables, too.")});
    const QString file = application.parseOptions() ? fileOf(application) : QString();
    if (file.isEmpty())
        return application.exitCode();
    QString error;
    const std::unique_ptr<qplc::FmuModel> model = qplc::FmuModel::open(file, &error);
    if (!model)
        return application.usageError(error);
    const FmuDescription &description = model->description();
    printLine("model", description.modelName);
    printLine("description", description.description);
    printLine("FMI", description.versionText);
    printLine("made by", description.generationTool);
    printLine("platforms", model->platforms().join(QStringLiteral(", ")));
    printLine("runs here", model->fitsHere() ? QStringLiteral("yes") : QStringLiteral("no"));
    printLine("experiment", experimentText(description));
    printLine("event mode", description.hasEventMode ? QStringLiteral("yes") : QString());
    print(QStringLiteral("variables"));
    printVariables(description, application.isSet(QStringLiteral("all")));
    return QPlcCoreApplication::Success;
}

}  // namespace fmu
