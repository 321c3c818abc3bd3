// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "LoneModel.h"
#include "QPlcCoreApplication.h"
#include "realtime/TimeSource.h"

#include <algorithm>
#include <stdexcept>

namespace fmu {

namespace {

constexpr qint64 mostMeasuredSteps = 10'000'000;

/// Durations of the steps, and of the steps with all inputs and outputs [ns].
struct Durations
{
    std::vector<qint64> steps;
    std::vector<qint64> cycles;
};

/// An FMU that ends is begun again. \throws std::runtime_error
Durations measure(LoneModel &alone, qint64 count)
{
    Durations durations;
    durations.steps.reserve(std::size_t(count));
    durations.cycles.reserve(std::size_t(count));
    qplc::FmuModel &model = alone.model();
    model.setStep(alone.step());
    qint64 left = 0;
    for (qint64 i = 0; i < count; ++i) {
        if (left == 0 || model.isOver()) {
            model.end();
            model.reset();
            model.initialize();
            left = alone.stepCount();
        }
        --left;
        const qint64 begin = qplc::monotonicNow();
        model.writeInputs();
        const qint64 written = qplc::monotonicNow();
        model.doStep();
        const qint64 done = qplc::monotonicNow();
        model.readOutputs();
        const qint64 end = qplc::monotonicNow();
        durations.steps.push_back(done - written);
        durations.cycles.push_back(end - begin);
    }
    model.end();
    return durations;
}

void printDistribution(const char *what, std::vector<qint64> &durations)
{
    std::sort(durations.begin(), durations.end());
    const auto quantile = [&](double share) {
        const auto index = std::size_t(share * double(durations.size() - 1));
        return QStringLiteral("%1").arg(double(durations[index]) * 1e-3, 11, 'f', 3);
    };
    print(QStringLiteral("%1 %2 %3 %4 %5 %6")
              .arg(QLatin1String(what), -18)
              .arg(quantile(0.0), quantile(0.5), quantile(0.99), quantile(0.999), quantile(1.0)));
}

}  // namespace

int bench(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("Measures how long an FMU computes: each step alone, and each step with all "
                       "its outputs, as a node has them."));
    application.setExamples({QStringLiteral("qtplc_fmu bench model.fmu --step 0.01 --period 0.01")});
    addArguments(application, "bench");
    LoneModel::addOptions(application);
    application.addOption({QStringLiteral("count"), QStringLiteral("Number of steps. Default: 10000."),
                           QStringLiteral("NUMBER"), QStringLiteral("10000")});
    application.addOption({QStringLiteral("period"),
                           QStringLiteral("Tells how many steps take longer than the period of a plant [s]."),
                           QStringLiteral("SECONDS")});
    application.addRealTimeOptions();
    qint64 count = 0;
    double period = 0.0;
    if (!application.parseOptions() || !application.integer(QStringLiteral("count"), 1, mostMeasuredSteps, &count)
        || (application.isSet(QStringLiteral("period"))
            && !application.number(QStringLiteral("period"), 1e-6, 3600.0, &period)))
        return application.exitCode();
    const std::unique_ptr<LoneModel> alone = LoneModel::open(application, count);
    if (!alone)
        return application.exitCode();
    Durations durations;
    try {
        durations = measure(*alone, count);
    } catch (const std::exception &failure) {
        alone->printLog();
        QPlcCoreApplication::printError(QString::fromUtf8(failure.what()));
        return QPlcCoreApplication::Failure;
    }
    alone->printLog();
    print(QStringLiteral("%1 steps of %2 s [us]     min         p50         p99       p99.9         max")
              .arg(count)
              .arg(alone->step()));
    printDistribution("doStep", durations.steps);
    printDistribution("with its outputs", durations.cycles);
    if (period > 0.0) {
        const auto late = std::count_if(durations.cycles.begin(), durations.cycles.end(),
                                        [&](qint64 duration) { return double(duration) * 1e-9 > period; });
        print(QStringLiteral("%1 of %2 take longer than the period of %3 s").arg(late).arg(count).arg(period));
    }
    return QPlcCoreApplication::Success;
}

}  // namespace fmu
