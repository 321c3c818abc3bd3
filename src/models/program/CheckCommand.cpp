// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "CrashReport.h"
#include "LoneModel.h"
#include "QPlcCoreApplication.h"
#include "QPlcValue.h"

#include <cmath>
#include <stdexcept>

namespace fmu {

namespace {

constexpr qint64 mostCheckedSteps = 1000;
constexpr std::chrono::seconds longestCall{30};

/// What one simulation has given.
struct Course
{
    QByteArray values;      // of all outputs after each step, one behind the other
    QStringList notFinite;  // names of outputs
    QString end;            // why it ended early; empty: it did not
    qint64 steps = 0;
};

void record(LoneModel &alone, Course *course)
{
    alone.model().readOutputs();
    for (const LoneModel::Output &output : alone.outputs()) {
        const QPlcSignalType type(output.variable->scalar(alone.model().description().version));
        const char *bytes = alone.bytesOf(output);
        for (int i = 0; i < output.variable->count; ++i) {
            const bool isFinite = QPlcValue::fromBytes(type, bytes + i * type.size()).isFinite();
            if (!isFinite && !course->notFinite.contains(output.variable->name))
                course->notFinite << output.variable->name;
        }
        course->values.append(bytes, output.variable->count * type.size());
    }
}

/// \throws std::runtime_error
Course simulateOnce(LoneModel &alone)
{
    Course course;
    qplc::FmuModel &model = alone.model();
    model.reset();
    model.initialize();
    record(alone, &course);
    const qint64 count = std::min(alone.stepCount(), mostCheckedSteps);
    for (; course.steps < count && !model.isOver(); ++course.steps) {
        CrashReport::endAfter(longestCall);
        model.writeInputs();
        model.doStep();
        if (!model.isOver())
            record(alone, &course);
    }
    CrashReport::endAfter(std::chrono::seconds(0));
    if (model.isOver())
        course.end = model.overText();
    model.end();
    return course;
}

}  // namespace

int check(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("Loads an FMU, runs it twice (at most 1000 steps), and tells what is wrong "
                       "with it: errors, values that are not finite, results that differ."));
    application.setExamples({QStringLiteral("qtplc_fmu check model.fmu --step 0.01 --stop 10")});
    addArguments(application, "check");
    LoneModel::addOptions(application);
    if (!application.parseOptions())
        return application.exitCode();
    const std::unique_ptr<LoneModel> alone = LoneModel::open(application, mostCheckedSteps);
    if (!alone)
        return application.exitCode();
    QStringList faults;
    Course first;
    try {
        alone->model().setStep(alone->step());
        first = simulateOnce(*alone);
        const Course second = simulateOnce(*alone);
        if (first.values != second.values)
            faults << QStringLiteral(
                "two simulations give different results: its reset does not begin anew, or it uses "
                "time or chance");
    } catch (const std::exception &failure) {
        faults << QString::fromUtf8(failure.what());
    }
    alone->printLog();
    for (const QString &name : qAsConst(first.notFinite))
        faults << QStringLiteral("output '%1' has values that are not finite").arg(name);
    print(QStringLiteral("%1 steps of %2 s, %3 outputs")
              .arg(first.steps)
              .arg(alone->step())
              .arg(alone->outputs().size()));
    if (!first.end.isEmpty())
        print(first.end);
    for (const QString &fault : qAsConst(faults))
        print(QStringLiteral("FAULT: %1").arg(fault));
    if (faults.isEmpty())
        print(QStringLiteral("no faults found"));
    return faults.isEmpty() ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace fmu
