// SPDX-License-Identifier: Apache-2.0
// Looks for the defect that is planted into this program: find_defect SEEDS. Exit code 0: one of
// that many seeds finds it, and its shortest plan, written and read, fails in the same way.
#include "Scenario.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QLoggingCategory>

#include <cstdio>

namespace {

/// Whether the text of \a plan says all of it, and none of its faults can be left out.
bool isShortestAndComplete(const soak::SimulatedPlan &plan)
{
    const soak::SimulatedRun result = run(plan);
    QString error;
    const auto read = soak::SimulatedPlan::fromText(plan.toText(), &error);
    if (!read) {
        std::printf("its plan cannot be read: %s\n", qPrintable(error));
        return false;
    }
    const soak::SimulatedRun again = run(*read);
    if (again.violation() != result.violation() || again.digest != result.digest) {
        std::printf("its plan gives another run: %s\n", qPrintable(again.violation()));
        return false;
    }
    for (std::size_t place = 0; place < plan.faults.size(); ++place) {
        soak::SimulatedPlan shorter = plan;
        shorter.faults.erase(shorter.faults.begin() + std::ptrdiff_t(place));
        if (run(shorter).violatedGate() == result.violatedGate()) {
            std::printf("'%s' can be left out\n", qPrintable(plan.faults[place].toString()));
            return false;
        }
    }
    return true;
}

/// \return the exit code
int shrink(const soak::SimulatedPlan &plan, const QString &gate)
{
    const soak::SimulatedPlan shortest = shrunk(plan);
    std::printf("%zu of %zu faults are enough:\n%s", shortest.faults.size(), plan.faults.size(),
                qPrintable(shortest.toText()));
    const bool isSame = run(shortest).violatedGate() == gate;
    return isSame && isShortestAndComplete(shortest) ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(QStringLiteral("*=false"));
    constexpr int seconds = 20;
    const quint64 seeds = application.arguments().value(1).toULongLong();
    const soak::Scenario *scenarios[]
        = {soak::Scenario::named(QStringLiteral("all")), soak::Scenario::named(QStringLiteral("storm")),
           soak::Scenario::named(QStringLiteral("restarts")), soak::Scenario::named(QStringLiteral("admissions")),
           soak::Scenario::named(QStringLiteral("turned"))};
    for (quint64 seed = 1; seed <= seeds; ++seed) {
        for (const soak::Scenario *scenario : scenarios) {
            const soak::SimulatedPlan plan = planOf(*scenario, seconds, seed);
            const soak::SimulatedRun result = run(plan);
            if (result.violation().isEmpty())
                continue;
            std::printf("seed %llu of scenario %s finds it: %s\n", qulonglong(seed), qPrintable(scenario->profile.name),
                        qPrintable(result.violation()));
            return shrink(plan, result.violatedGate());
        }
    }
    std::printf("%llu seeds do not find it\n", qulonglong(seeds));
    return 1;
}
