// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "CsvFile.h"
#include "LoneModel.h"
#include "QPlcCoreApplication.h"
#include "QPlcValue.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <stdexcept>

namespace fmu {

namespace {

/// A CSV file that is written line by line.
class OutputFile
{
public:
    explicit OutputFile(const QString &fileName)
        : m_file(fileName)
    {
    }
    bool open() { return m_file.open(QIODevice::WriteOnly | QIODevice::Truncate); }
    bool isTheFile(const QString &other) const
    {
        const QString place = QFileInfo(m_file.fileName()).canonicalFilePath();
        return !place.isEmpty() && place == QFileInfo(other).canonicalFilePath();
    }
    void writeHeader(LoneModel &alone)
    {
        QByteArray line = "time";
        for (const LoneModel::Output &output : alone.outputs())
            line += ',' + cell(output.variable->name);
        write(line);
    }
    void writeValues(LoneModel &alone)
    {
        QByteArray line = QPlcValue(alone.model().time()).toString().toUtf8();
        for (const LoneModel::Output &output : alone.outputs())
            line += ',' + alone.textOf(output).toUtf8();
        write(line);
    }
    bool isGood() { return m_isGood && m_file.flush(); }
    QString errorText() const
    {
        return QStringLiteral("%1 cannot be written: %2").arg(m_file.fileName(), m_file.errorString());
    }

private:
    static QByteArray cell(const QString &name)
    {
        return name.contains(QLatin1Char(',')) ? '"' + name.toUtf8() + '"' : name.toUtf8();
    }
    void write(const QByteArray &line) { m_isGood = m_isGood && m_file.write(line + '\n') == line.size() + 1; }

    QFile m_file;
    bool m_isGood = true;
};

/// \throws std::runtime_error
void simulate(LoneModel &alone, CsvFile *inputs, OutputFile &output)
{
    qplc::FmuModel &model = alone.model();
    const auto apply = [&] {
        if (inputs)
            inputs->apply(model.time());
    };
    model.setStep(alone.step());
    model.reset();
    apply();
    model.initialize();
    model.readOutputs();
    output.writeHeader(alone);
    output.writeValues(alone);
    for (qint64 i = 0; i < alone.stepCount() && !model.isOver() && output.isGood(); ++i) {
        apply();
        model.writeInputs();
        const double before = model.time();
        model.doStep();
        if (model.time() > before) {
            model.readOutputs();
            output.writeValues(alone);
        }
        alone.printLog();
    }
    model.end();
}

}  // namespace

int runAlone(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("Runs an FMU alone, without a master, and writes its outputs to a CSV file: "
                       "one line at the beginning, and one after each step."));
    application.setExamples({QStringLiteral("qtplc_fmu run model.fmu --stop 10 --step 0.01 --out model.csv"),
                             QStringLiteral("qtplc_fmu run model.fmu --in wind.csv --set mass=6.2 --out model.csv")});
    addArguments(application, "run");
    LoneModel::addOptions(application);
    application.addOption({QStringLiteral("in"),
                           QStringLiteral("Inputs over time: a line 'time,VARIABLE,...', then values. Continuous "
                                          "variables are interpolated."),
                           QStringLiteral("IN.csv")});
    application.addOption(
        {QStringLiteral("out"), QStringLiteral("Outputs over time; required."), QStringLiteral("OUT.csv")});
    if (!application.parseOptions())
        return application.exitCode();
    if (!application.isSet(QStringLiteral("out")))
        return application.usageError(QStringLiteral("say where the outputs go: --out OUT.csv"));
    const std::unique_ptr<LoneModel> alone = LoneModel::open(application);
    if (!alone)
        return application.exitCode();
    CsvFile inputs;
    QString error;
    const bool hasInputs = application.isSet(QStringLiteral("in"));
    if (hasInputs && !inputs.open(application.value(QStringLiteral("in")), &alone->model(), &error))
        return application.usageError(QStringLiteral("--in: %1").arg(error));
    OutputFile output(application.value(QStringLiteral("out")));
    if (output.isTheFile(fileOf(application))
        || (hasInputs && output.isTheFile(application.value(QStringLiteral("in")))))
        return application.usageError(QStringLiteral("--out names a file that is read; choose another one"));
    if (!output.open())
        return application.usageError(QStringLiteral("--out: %1").arg(output.errorText()));
    try {
        simulate(*alone, hasInputs ? &inputs : nullptr, output);
    } catch (const std::exception &failure) {
        alone->printLog();
        QPlcCoreApplication::printError(QString::fromUtf8(failure.what()));
        return QPlcCoreApplication::Failure;
    }
    alone->printLog();
    if (!output.isGood()) {
        QPlcCoreApplication::printError(output.errorText());
        return QPlcCoreApplication::Failure;
    }
    if (alone->model().isOver())
        QPlcCoreApplication::printError(alone->model().overText());
    return QPlcCoreApplication::Success;
}

}  // namespace fmu
