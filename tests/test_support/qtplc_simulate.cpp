// SPDX-License-Identifier: Apache-2.0
// qtplc_simulate: the soak in virtual time. Treats a simulated plant as a seed says, and judges it
// by the gates of the soak.
#include "Scenario.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QCoreApplication>
#include <QtCore/QLoggingCategory>

#include <cstdio>
#include <limits>
#include <optional>

namespace {

struct Options
{
    const soak::Scenario *scenario = nullptr;
    int seconds = 60;
    bool isVerbose = false;
};

/// \return whether all gates hold
bool simulate(quint64 seed, const Options &options)
{
    const std::vector<soak::Fault> plan = planOf(*options.scenario, options.seconds, seed);
    const soak::SimulatedRun result = run(*options.scenario, options.seconds, seed, plan);
    if (options.isVerbose) {
        std::fputs(qPrintable(result.report.toText()), stdout);
        for (const soak::DoneFault &fault : result.report.evidence.faults)
            std::printf("%9.3f ... %.3f s, all well at %.3f s: %s (%d)\n", double(fault.begin) * 1e-9,
                        double(fault.end) * 1e-9, double(fault.recovered) * 1e-9,
                        soak::FaultNames[std::size_t(fault.kind)], fault.node);
        std::printf("digest %016llx\n", qulonglong(result.digest));
    }
    if (result.violation().isEmpty())
        return true;
    std::printf("seed %llu: %s\n", qulonglong(seed), qPrintable(result.violation()));
    std::fflush(stdout);
    const QString gate = result.violation().section(QLatin1Char(':'), 0, 0);
    const auto fails = [&](const std::vector<soak::Fault> &shorter) {
        return run(*options.scenario, options.seconds, seed, shorter).violation().startsWith(gate);
    };
    const std::vector<soak::Fault> shortest = soak::shrunk(plan, fails);
    std::printf("%zu of %zu faults are enough: %s\n", shortest.size(), plan.size(),
                qPrintable(run(*options.scenario, options.seconds, seed, shortest).violation()));
    for (const soak::Fault &fault : shortest)
        std::printf("  %s\n", qPrintable(fault.toString()));
    std::printf("again: qtplc_simulate --scenario %s --seed %llu --seconds %d --report\n",
                qPrintable(options.scenario->profile.name), qulonglong(seed), options.seconds);
    std::fflush(stdout);
    return false;
}

QStringList names()
{
    QStringList all;
    for (const soak::Scenario &scenario : soak::Scenario::all())
        all << scenario.profile.name;
    return all;
}

QCommandLineOption option(const char *name, const QString &description, const char *valueName, const QString &value)
{
    return QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName), value);
}

/// A whole number that an option has to have. \return nothing: it is none, or too small
std::optional<quint64> number(const QCommandLineParser &parser, const char *name, quint64 least)
{
    const QString text = parser.value(QString::fromLatin1(name));
    bool isNumber = false;
    const quint64 value = text.toULongLong(&isNumber);
    if (isNumber && value >= least && value <= quint64(std::numeric_limits<int>::max()))
        return value;
    std::fprintf(stderr, "qtplc_simulate: '--%s %s': use a whole number from %llu to %d\n", name, qPrintable(text),
                 qulonglong(least), std::numeric_limits<int>::max());
    return std::nullopt;
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    QCommandLineParser parser;
    parser.setApplicationDescription(
        QStringLiteral("Runs a simulated plant with random faults. Exit code 1: a gate does not hold; 2: an option is "
                       "wrong."));
    parser.addHelpOption();
    parser.addOptions(
        {option("seed", QStringLiteral("First seed (1)."), "N", QStringLiteral("1")),
         option("seeds", QStringLiteral("How many seeds (1)."), "COUNT", QStringLiteral("1")),
         option("seconds", QStringLiteral("Virtual time with faults (60)."), "S", QStringLiteral("60")),
         option("scenario", names().join(QStringLiteral(", ")) + QStringLiteral(" (all)."), "NAME",
                QStringLiteral("all")),
         {QStringLiteral("list"), QStringLiteral("Lists the scenarios.")},
         {QStringLiteral("report"), QStringLiteral("Prints the report of each run and the digest of its traffic.")},
         {QStringLiteral("log"), QStringLiteral("Shows the log of the plant.")}});
    parser.process(application);
    if (parser.isSet(QStringLiteral("list"))) {
        for (const soak::Scenario &scenario : soak::Scenario::all())
            std::printf("%-10s %s\n", qPrintable(scenario.profile.name), qPrintable(scenario.description));
        return 0;
    }
    if (!parser.isSet(QStringLiteral("log")))
        QLoggingCategory::setFilterRules(QStringLiteral("*=false"));
    const std::optional<quint64> seconds = number(parser, "seconds", 1);
    const std::optional<quint64> first = number(parser, "seed", 0);
    const std::optional<quint64> count = number(parser, "seeds", 1);
    Options options;
    options.isVerbose = parser.isSet(QStringLiteral("report"));
    options.scenario = soak::Scenario::named(parser.value(QStringLiteral("scenario")));
    if (!options.scenario)
        std::fprintf(stderr, "qtplc_simulate: use --scenario %s\n", qPrintable(names().join(QStringLiteral("|"))));
    if (!parser.positionalArguments().isEmpty())
        std::fprintf(stderr, "qtplc_simulate: '%s' is no option\n", qPrintable(parser.positionalArguments().first()));
    if (!seconds || !first || !count || !options.scenario || !parser.positionalArguments().isEmpty())
        return 2;
    options.seconds = int(*seconds);
    quint64 failed = 0;
    for (quint64 seed = *first; seed < *first + *count; ++seed)
        failed += simulate(seed, options) ? 0 : 1;
    std::printf("%llu of %llu seeds fail\n", qulonglong(failed), qulonglong(*count));
    return failed == 0 ? 0 : 1;
}
