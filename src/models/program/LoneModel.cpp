// SPDX-License-Identifier: Apache-2.0
#include "LoneModel.h"

#include "Commands.h"
#include "QPlcApplicationOptions.h"
#include "QPlcValue.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <cmath>

namespace fmu {

using qplc::FmuDescription;
using qplc::FmuModel;
using qplc::FmuVariable;

namespace {

constexpr double shortestStep = 1e-9;  // [s]
constexpr double longestTime = 1e9;    // [s]
constexpr double mostSteps = 1e12;

}  // namespace

void LoneModel::addOptions(QPlcApplicationOptions &application)
{
    application.addOption({QStringLiteral("step"), QStringLiteral("Communication step [s]. Default: that of the FMU."),
                           QStringLiteral("SECONDS")});
    application.addOption({QStringLiteral("stop"),
                           QStringLiteral("End of the simulation [s]. Default: that of the FMU."),
                           QStringLiteral("SECONDS")});
    application.addOption({QStringLiteral("tolerance"), QStringLiteral("Relative tolerance. Default: that of the FMU."),
                           QStringLiteral("NUMBER")});
    application.addOption({QStringLiteral("set"),
                           QStringLiteral("Start value of a parameter or input; may be repeated."),
                           QStringLiteral("VARIABLE=VALUE")});
    application.addOption(
        {QStringLiteral("log"), QStringLiteral("The FMU reports more than warnings and errors, if it can.")});
}

std::unique_ptr<LoneModel> LoneModel::open(QPlcApplicationOptions &application, qint64 usualSteps)
{
    const QString file = fileOf(application);
    if (file.isEmpty())
        return nullptr;
    QString error;
    auto result = std::make_unique<LoneModel>();
    result->m_model = FmuModel::open(file, &error);
    if (!result->m_model || !result->m_model->load(&error)) {
        application.usageError(error);
        return nullptr;
    }
    if (!result->readSettings(application, usualSteps))
        return nullptr;
    for (const FmuVariable &variable : result->m_model->description().variables) {
        if (variable.causality == FmuVariable::Output && variable.isNumber() && variable.count > 0)
            result->m_outputs.append({&variable, result->m_model->outputs().add(variable)});
    }
    return result;
}

bool LoneModel::readSettings(QPlcApplicationOptions &application, qint64 usualSteps)
{
    const FmuDescription &description = m_model->description();
    const double start = description.startTime.value_or(0.0);
    double step = description.stepSize.value_or(description.fixedInternalStep.value_or(0.0));
    double stop = description.stopTime.value_or(start);
    FmuModel::Settings settings;
    double tolerance = 0.0;
    const auto read = [&](const char *name, double minimum, double maximum, double *number) {
        const QString option = QString::fromLatin1(name);
        return !application.isSet(option) || application.number(option, minimum, maximum, number);
    };
    if (!read("step", shortestStep, longestTime, &step) || !read("stop", start, longestTime, &stop)
        || !read("tolerance", 1e-300, 1.0, &tolerance) || !readStarts(application, &settings))
        return false;
    if (!application.isSet(QStringLiteral("stop")) && !description.stopTime)
        stop = start + double(usualSteps) * step;
    if (!(step >= shortestStep) || !(stop > start)) {
        application.usageError(QStringLiteral("the FMU does not say how long it should run; add --%1 SECONDS")
                                   .arg(step >= shortestStep ? QStringLiteral("stop") : QStringLiteral("step")));
        return false;
    }
    const double count = (stop - start) / step;
    if (count > mostSteps) {
        application.usageError(QStringLiteral("%1 steps are too many; choose a longer --step").arg(count));
        return false;
    }
    m_step = step;
    m_stepCount = std::max<qint64>(std::llround(std::ceil(count - 1e-6)), 1);
    settings.stopTime
        = std::max(stop, start + FmuModel::multipleOf(step, m_stepCount));  // an FMU need not go beyond it
    settings.logs = application.isSet(QStringLiteral("log"));
    if (application.isSet(QStringLiteral("tolerance")))
        settings.tolerance = tolerance;
    m_model->setSettings(settings);
    return true;
}

bool LoneModel::readStarts(QPlcApplicationOptions &application, FmuModel::Settings *settings)
{
    for (const QString &text : application.values(QStringLiteral("set"))) {
        const int equals = text.indexOf(QLatin1Char('='));
        QString error = QStringLiteral("%1 is not 'variable=value'").arg(qplc::quoted(text));
        FmuModel::Start start;
        if (equals <= 0
            || !FmuModel::readStart(m_model->description(), text.left(equals).trimmed(), text.mid(equals + 1).trimmed(),
                                    &start, &error)) {
            application.usageError(QStringLiteral("--set: %1").arg(error));
            return false;
        }
        settings->starts.append(start);
    }
    return true;
}

int LoneModel::elementSizeOf(const FmuVariable &variable) const
{
    return QPlcSignalType(variable.scalar(m_model->description().version)).elementSize();
}

QString LoneModel::textOf(const Output &output)
{
    const QPlcSignalType type(output.variable->scalar(m_model->description().version));
    const char *bytes = bytesOf(output);
    QStringList texts;
    for (int i = 0; i < output.variable->count; ++i)
        texts << QPlcValue::fromBytes(type, bytes + i * type.size()).toString();
    return texts.join(QLatin1Char(' '));
}

void LoneModel::printLog()
{
    qplc::FmuLog::Line line;
    while (m_model->log().take(&line))
        QPlcApplicationOptions::printError(QStringLiteral("FMU: %1").arg(qplc::FmuLog::textOf(line)));
    if (const quint64 lost = m_model->log().takeLost())
        QPlcApplicationOptions::printError(QStringLiteral("FMU: %1 lines were too many and are missing").arg(lost));
}

}  // namespace fmu
