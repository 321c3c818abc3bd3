// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "QPlcCoreApplication.h"
#include "QPlcSignalTable.h"
#include "models/FmuModel.h"
#include "models/FmuWiring.h"
#include "signals/MessageText.h"

#include <QtCore/QRegularExpression>

namespace fmu {

namespace {

using qplc::FmuElement;
using qplc::FmuVariable;

/// The name of the signal that stands for a variable: other characters become '_'.
QString signalName(const QString &variable)
{
    static const QRegularExpression strange(QStringLiteral("[^A-Za-z0-9_.]+"));
    QString name = QString(variable).replace(strange, QStringLiteral("_"));
    while (name.endsWith(QLatin1Char('_')) && !variable.endsWith(QLatin1Char('_')))
        name.chop(1);
    if (name.isEmpty() || name.at(0).isDigit() || name.at(0) == QLatin1Char('.'))
        name.prepend(QLatin1Char('_'));
    return name.left(63);
}

/// Limits and start values that the type does not have are left out.
QPlcSignalDefinition definitionOf(const QString &name, const QVector<FmuElement> &elements, int version)
{
    const FmuVariable &variable = *elements.first().variable;
    QPlcSignalDefinition signal;
    signal.name = signalName(name);
    const QPlcSignalType::Scalar scalar
        = variable.kind == FmuVariable::Boolean ? QPlcSignalType::Int8 : variable.scalar(version);
    signal.type = QPlcSignalType(scalar, elements.size());
    signal.typeName
        = variable.kind == FmuVariable::Boolean && elements.size() == 1 ? QStringLiteral("Bool") : QString();
    signal.unit = variable.unit;
    signal.description = qplc::printable(variable.description.simplified());
    const QPlcSignalType single(scalar);
    if (!variable.minimum.isEmpty())
        signal.minimum = QPlcValue::fromString(single, variable.minimum);
    if (!variable.maximum.isEmpty())
        signal.maximum = QPlcValue::fromString(single, variable.maximum);
    QStringList starts;
    for (const FmuElement &element : elements) {
        const QStringList own = element.variable->start.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
        if (!own.isEmpty())
            starts << own.value(own.size() == 1 ? 0 : element.element);
    }
    if (starts.size() == elements.size())
        signal.initial = QPlcValue::fromString(signal.type, starts.join(QStringLiteral(", ")));
    QStringList names;
    for (const QPair<qint64, QString> &item : variable.items)
        names << QStringLiteral("%1: %2")
                     .arg(item.first)
                     .arg(
                         QString(item.second).replace(QRegularExpression(QStringLiteral("[,:]")), QStringLiteral("_")));
    signal.valueNames = QPlcValueNames::fromText(names.join(QStringLiteral(", ")));
    return signal;
}

/// What the node file needs, because signals and variables have different names.
QString wireComment(const QString &variable, const QString &signal, bool isInput)
{
    const QString line
        = isInput ? QStringLiteral("%1 = %2").arg(variable, signal) : QStringLiteral("%1 = %2").arg(signal, variable);
    return QStringLiteral("; in the file of the node: [fmu.%1] %2\n")
        .arg(isInput ? QStringLiteral("write") : QStringLiteral("read"), line);
}

}  // namespace

int printSignals(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(QStringLiteral("Prints a signal table with the inputs and outputs of an FMU. It runs no "
                                              "code of the FMU."));
    application.setExamples({QStringLiteral("qtplc_fmu signals model.fmu > signals.ini")});
    addArguments(application, "signals");
    const QString file = application.parseOptions() ? fileOf(application) : QString();
    if (file.isEmpty())
        return application.exitCode();
    QString error;
    const std::unique_ptr<qplc::FmuModel> model = qplc::FmuModel::open(file, &error);
    if (!model)
        return application.usageError(error);
    const qplc::FmuWiring wiring(model->description());
    QPlcSignalTable table;
    QString comments = QStringLiteral("; signals of the FMU %1\n").arg(qplc::printable(model->description().modelName));
    for (const QString &name : wiring.names()) {
        const QVector<FmuElement> elements = wiring.find(name, &error);
        const FmuVariable::Causality causality = elements.first().variable->causality;
        if (causality != FmuVariable::Input && causality != FmuVariable::Output)
            continue;
        const QPlcSignalDefinition signal = definitionOf(name, elements, model->description().version);
        if (!table.append(signal, &error))
            QPlcCoreApplication::printError(QStringLiteral("%1 is left out: %2").arg(qplc::quoted(name), error));
        else if (signal.name != name)
            comments += wireComment(qplc::printable(name), signal.name, causality == FmuVariable::Input);
    }
    if (table.isEmpty())
        return application.usageError(
            QStringLiteral("%1: the FMU has no inputs and outputs that signals can have").arg(file));
    print(comments + QString::fromUtf8(table.toIni()).trimmed());
    return QPlcCoreApplication::Success;
}

}  // namespace fmu
