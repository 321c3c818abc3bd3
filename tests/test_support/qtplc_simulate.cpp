// SPDX-License-Identifier: Apache-2.0
// qtplc_simulate: the soak in virtual time. Treats a simulated plant as a seed says, and judges it
// by the gates of the soak.
#include "Scenario.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QCoreApplication>
#include <QtCore/QFile>
#include <QtCore/QLoggingCategory>
#include <QtCore/QSaveFile>

#include <cstdio>
#include <optional>

namespace {

/// At once: a run takes time.
void print(const QString &text)
{
    std::fputs(qPrintable(text), stdout);
    std::fflush(stdout);
}

/// How a plan ends, as comments of its text.
QString outcomeOf(const soak::SimulatedPlan &plan)
{
    const soak::SimulatedRun result = run(plan);
    return QStringLiteral("# %1\n# digest %2\n")
        .arg(result.violation().simplified(), QString::number(result.digest, 16).rightJustified(16, QLatin1Char('0')));
}

/// \return false, with the message out, when \a file cannot be written
bool write(const QString &text, const QString &file)
{
    QSaveFile target(file);
    if (target.open(QIODevice::WriteOnly) && target.write(text.toUtf8()) >= 0 && target.commit())
        return true;
    std::fprintf(stderr, "qtplc_simulate: cannot write %s: %s\n", qPrintable(file), qPrintable(target.errorString()));
    return false;
}

void report(const soak::SimulatedRun &result)
{
    print(result.report.toText());
    for (const soak::DoneFault &fault : result.report.evidence.faults)
        std::printf("%9.3f ... %.3f s, all well at %.3f s: %s (%d)\n", double(fault.begin) * 1e-9,
                    double(fault.end) * 1e-9, double(fault.recovered) * 1e-9, soak::FaultNames[std::size_t(fault.kind)],
                    fault.node);
    std::printf("digest %016llx\n", qulonglong(result.digest));
}

/// Prints the shortest plan that fails like \a plan, and how to run it again.
void shrink(const soak::SimulatedPlan &plan, const QString &writePlan)
{
    const soak::SimulatedPlan shortest = shrunk(plan);
    const QString text = outcomeOf(shortest) + shortest.toText();
    const bool isWritten = !writePlan.isEmpty() && write(text, writePlan);
    print(QStringLiteral("%1 of %2 faults are enough:\n%3")
              .arg(shortest.faults.size())
              .arg(plan.faults.size())
              .arg(text));
    print(isWritten
              ? QStringLiteral("again: qtplc_simulate --plan %1 --report\n").arg(writePlan)
              : QStringLiteral("again: save the lines above as FILE, then: qtplc_simulate --plan FILE --report\n"));
}

/// \param origin  of the plan
/// \return whether all gates hold
bool simulate(const soak::SimulatedPlan &plan, const QString &origin, const QCommandLineParser &parser, bool isFirst)
{
    const soak::SimulatedRun result = run(plan);
    if (parser.isSet(QStringLiteral("report")))
        report(result);
    if (result.violation().isEmpty())
        return true;
    print(QStringLiteral("%1: %2\n").arg(origin, result.violation()));
    shrink(plan, isFirst ? parser.value(QStringLiteral("write-plan")) : QString());
    return false;
}

QCommandLineOption option(const char *name, const QString &description, const char *valueName, const QString &value)
{
    return QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName), value);
}

/// A whole number that an option has to have. \return nothing: it is none, or too small
std::optional<quint64> number(const QCommandLineParser &parser, const char *name, quint64 least)
{
    const QString text = parser.value(QString::fromLatin1(name));
    QString error;
    const std::optional<quint64> value = soak::wholeNumber(text, least, &error);
    if (!value)
        std::fprintf(stderr, "qtplc_simulate: '--%s %s': %s\n", name, qPrintable(text), qPrintable(error));
    return value;
}

/// \return the exit code
int simulatePlan(const QString &file, const QCommandLineParser &parser)
{
    for (const char *option : {"scenario", "seed", "seeds", "seconds"}) {
        if (parser.isSet(QString::fromLatin1(option))) {
            std::fprintf(stderr, "qtplc_simulate: leave --%s out; the file of --plan says it\n", option);
            return 2;
        }
    }
    QFile source(file);
    if (!source.open(QIODevice::ReadOnly)) {
        std::fprintf(stderr, "qtplc_simulate: cannot read %s: %s\n", qPrintable(file),
                     qPrintable(source.errorString()));
        return 2;
    }
    QString error;
    const auto plan = soak::SimulatedPlan::fromText(QString::fromUtf8(source.readAll()), &error);
    if (!plan) {
        std::fprintf(stderr, "%s:%s\n", qPrintable(file), qPrintable(error));
        return 2;
    }
    const bool isGood = simulate(*plan, QStringLiteral("plan %1").arg(file), parser, true);
    std::printf("the plan %s\n", isGood ? "violates no gate" : "fails");
    return isGood ? 0 : 1;
}

/// \return the exit code
int simulateSeeds(const QCommandLineParser &parser)
{
    const std::optional<quint64> seconds = number(parser, "seconds", 1);
    const std::optional<quint64> first = number(parser, "seed", 0);
    const std::optional<quint64> count = number(parser, "seeds", 1);
    const soak::Scenario *scenario = soak::Scenario::named(parser.value(QStringLiteral("scenario")));
    if (!scenario)
        std::fprintf(stderr, "qtplc_simulate: unknown scenario '%s'; use --scenario %s\n",
                     qPrintable(parser.value(QStringLiteral("scenario"))),
                     qPrintable(soak::Scenario::names().join(QStringLiteral("|"))));
    if (!seconds || !first || !count || !scenario)
        return 2;
    quint64 failed = 0;
    for (quint64 seed = *first; seed < *first + *count; ++seed) {
        const QString origin = QStringLiteral("seed %1").arg(seed);
        failed += simulate(planOf(*scenario, int(*seconds), seed), origin, parser, failed == 0) ? 0 : 1;
    }
    std::printf("%llu of %llu seeds fail\n", qulonglong(failed), qulonglong(*count));
    return failed == 0 ? 0 : 1;
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
         option("scenario", soak::Scenario::names().join(QStringLiteral(", ")) + QStringLiteral(" (all)."), "NAME",
                QStringLiteral("all")),
         option("plan", QStringLiteral("Runs the plan of FILE, and not those of seeds."), "FILE", {}),
         option("write-plan", QStringLiteral("Writes the shortest plan of the first run that fails."), "FILE", {}),
         {QStringLiteral("list"), QStringLiteral("Lists the scenarios.")},
         {QStringLiteral("report"), QStringLiteral("Prints the report of each run and the digest of its traffic.")},
         {QStringLiteral("log"), QStringLiteral("Shows the log of the plant.")}});
    if (!parser.parse(application.arguments())) {
        std::fprintf(stderr, "qtplc_simulate: %s\n", qPrintable(parser.errorText()));
        return 2;
    }
    parser.process(application);  // --help
    if (parser.isSet(QStringLiteral("list"))) {
        for (const soak::Scenario &scenario : soak::Scenario::all())
            std::printf("%-10s %s\n", qPrintable(scenario.profile.name), qPrintable(scenario.description));
        return 0;
    }
    if (!parser.isSet(QStringLiteral("log")))
        QLoggingCategory::setFilterRules(QStringLiteral("*=false"));
    if (!parser.positionalArguments().isEmpty()) {
        std::fprintf(stderr, "qtplc_simulate: unexpected argument '%s'; use the options of --help\n",
                     qPrintable(parser.positionalArguments().first()));
        return 2;
    }
    const QString plan = parser.value(QStringLiteral("plan"));
    return plan.isEmpty() ? simulateSeeds(parser) : simulatePlan(plan, parser);
}
