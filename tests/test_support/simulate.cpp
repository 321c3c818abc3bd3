// SPDX-License-Identifier: Apache-2.0
#include "RandomFaults.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QCoreApplication>
#include <QtCore/QLoggingCategory>

#include <cstdio>

namespace {

/// \return whether all gates hold
bool run(quint64 seed, int seconds)
{
    const FaultPlanOfPlant plan = planFor(seed, seconds);
    const PlantVerdict verdict = runPlan(seed, plan);
    if (verdict.violation.isEmpty())
        return true;
    const auto fails = [seed](const FaultPlanOfPlant &shorter) { return !runPlan(seed, shorter).violation.isEmpty(); };
    const FaultPlanOfPlant shortest = shrunk(plan, fails);
    std::printf("seed %llu fails: %s\n", qulonglong(seed), qPrintable(verdict.violation));
    std::printf("%zu of %zu faults are enough:\n", shortest.size(), plan.size());
    for (const PlannedFault &fault : shortest)
        std::printf("  %s\n", qPrintable(fault.toString()));
    return false;
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    QCommandLineParser parser;
    parser.setApplicationDescription(
        QStringLiteral("Runs a simulated plant with random faults. Exit code 1: a gate does not hold."));
    parser.addHelpOption();
    parser.addOptions(
        {{QStringLiteral("seed"), QStringLiteral("First seed (1)."), QStringLiteral("N"), QStringLiteral("1")},
         {QStringLiteral("seeds"), QStringLiteral("How many seeds (1)."), QStringLiteral("COUNT"), QStringLiteral("1")},
         {QStringLiteral("seconds"), QStringLiteral("Virtual time with faults (60)."), QStringLiteral("S"),
          QStringLiteral("60")},
         {QStringLiteral("log"), QStringLiteral("Show the log of the plant.")}});
    parser.process(application);
    if (!parser.isSet(QStringLiteral("log")))
        QLoggingCategory::setFilterRules(QStringLiteral("*=false"));
    const quint64 first = parser.value(QStringLiteral("seed")).toULongLong();
    const quint64 count = parser.value(QStringLiteral("seeds")).toULongLong();
    quint64 failed = 0;
    for (quint64 seed = first; seed < first + count; ++seed)
        failed += run(seed, parser.value(QStringLiteral("seconds")).toInt()) ? 0 : 1;
    std::printf("%llu of %llu seeds fail\n", qulonglong(failed), qulonglong(count));
    return failed == 0 ? 0 : 1;
}
