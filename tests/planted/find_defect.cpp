// SPDX-License-Identifier: Apache-2.0
// Looks for the defect that is planted into this program: find_defect SEEDS. Exit code 0: one of
// that many seeds finds it.
#include "Scenario.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QLoggingCategory>

#include <cstdio>

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(QStringLiteral("*=false"));
    constexpr int seconds = 20;
    const quint64 seeds = application.arguments().value(1).toULongLong();
    const soak::Scenario *scenarios[]
        = {soak::Scenario::named(QStringLiteral("all")), soak::Scenario::named(QStringLiteral("storm")),
           soak::Scenario::named(QStringLiteral("restarts")), soak::Scenario::named(QStringLiteral("admissions"))};
    for (quint64 seed = 1; seed <= seeds; ++seed) {
        for (const soak::Scenario *scenario : scenarios) {
            const soak::SimulatedRun result = run(*scenario, seconds, seed, planOf(*scenario, seconds, seed));
            if (result.violation().isEmpty())
                continue;
            std::printf("seed %llu of scenario %s finds it: %s\n", qulonglong(seed), qPrintable(scenario->profile.name),
                        qPrintable(result.violation()));
            return 0;
        }
    }
    std::printf("%llu seeds do not find it\n", qulonglong(seeds));
    return 1;
}
