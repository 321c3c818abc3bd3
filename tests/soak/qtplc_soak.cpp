// SPDX-License-Identifier: Apache-2.0
// qtplc_soak: treats a plant of real processes badly, judges it by what its processes have written
// down, and reports.
#include "PlantProcesses.h"
#include "SoakReport.h"
#include "SoakRun.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QJsonDocument>
#include <QtCore/QLoggingCategory>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTemporaryDir>

#include <cstdio>

namespace {

constexpr int NotJudged = 77;  // as test runners expect it of what could not be tested

struct Options
{
    soak::Profile profile;
    quint64 seed = 0;
    int seconds = 0;
    QString json;
    bool keep = false;
};

QCommandLineOption option(const char *name, const QString &description, const char *valueName, const QString &value)
{
    return QCommandLineOption(QString::fromLatin1(name), description, QString::fromLatin1(valueName), value);
}

void addOptions(QPlcCoreApplication &application)
{
    application.setDescription(QStringLiteral("Runs a plant of real processes, does to it what a seed says, and judges "
                                              "it by what its processes wrote down."));
    application.setExamples(
        {QStringLiteral("qtplc_soak"), QStringLiteral("qtplc_soak --profile faults --seed 7 --keep")});
    application.addOption(option("profile", soak::Profile::names().join(QStringLiteral(", ")) + QLatin1Char('.'),
                                 "NAME", QStringLiteral("short")));
    application.addOption(
        option("seed", QStringLiteral("What happens, and when. Without one: another each time."), "N", QString()));
    application.addOption(
        option("nodes", QStringLiteral("Nodes of the plant. 0: those of the profile."), "N", QStringLiteral("0")));
    application.addOption(
        option("hz", QStringLiteral("Cycles in a second. 0: as the profile says."), "HZ", QStringLiteral("0")));
    application.addOption(
        option("duration", QStringLiteral("Seconds. 0: that of the profile."), "S", QStringLiteral("0")));
    application.addOption(
        option("json", QStringLiteral("Report for programs."), "FILE", QStringLiteral("soak-report.json")));
    application.addOption(QCommandLineOption(QStringLiteral("keep"),
                                             QStringLiteral("Keeps histories and logs also when all went well.")));
}

bool readOptions(QPlcCoreApplication &application, Options *options)
{
    const QString name = application.value(QStringLiteral("profile"));
    const std::optional<soak::Profile> profile = soak::Profile::named(name);
    if (!profile) {
        application.usageError(
            QStringLiteral("--profile %1: use one of %2").arg(name, soak::Profile::names().join(QStringLiteral(", "))));
        return false;
    }
    options->profile = *profile;
    bool isSeed = true;
    options->seed = application.isSet(QStringLiteral("seed"))
        ? application.value(QStringLiteral("seed")).toULongLong(&isSeed)
        : QRandomGenerator::system()->generate();
    if (!isSeed) {
        application.usageError(
            QStringLiteral("--seed %1: use a number").arg(application.value(QStringLiteral("seed"))));
        return false;
    }
    qint64 seconds = 0;
    qint64 nodes = 0;
    qint64 hz = 0;
    if (!application.integer(QStringLiteral("duration"), 0, 86'400, &seconds)
        || !application.integer(QStringLiteral("nodes"), 0, 254, &nodes)
        || !application.integer(QStringLiteral("hz"), 0, 1000, &hz))
        return false;
    if (nodes > 0)
        options->profile.shape.nodes = std::max(2, int(nodes));
    if (hz > 0)
        options->profile.periodUs = 1'000'000 / hz;
    options->seconds = seconds > 0 ? int(seconds) : profile->seconds;
    options->json = application.value(QStringLiteral("json"));
    options->keep = application.isSet(QStringLiteral("keep"));
    return true;
}

/// \return why the run ended early; empty: it did not
QString runIn(const QString &folder, const Options &options)
{
    QString error;
    soak::HistoryFile history;
    if (!history.open(QDir(folder).filePath(QStringLiteral("Runner.history")), &error))
        return error;
    const soak::Profile &profile = options.profile;
    const int count = profile.faultCount > 0 ? profile.faultCount * options.seconds / profile.seconds
        : profile.faultEvery > 0             ? options.seconds * 1000 / profile.faultEvery
                                             : 0;
    const std::vector<soak::Fault> plan = planOf(profile, count, options.seed);
    soak::PlantProcesses plant(profile, options.seed, folder, history);
    soak::SoakRun run(profile, options.seconds, plan, plant, history);
    return run.run() ? QString() : run.errorString();
}

bool writeJson(const QString &fileName, const QJsonObject &report)
{
    QFile file(fileName);
    const QByteArray text = QJsonDocument(report).toJson();
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.flush())
        return true;
    QPlcCoreApplication::printError(QStringLiteral("cannot write %1: %2").arg(fileName, file.errorString()));
    return false;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*=false"));
    addOptions(application);
    Options options;
    if (!application.parseOptions() || !readOptions(application, &options))
        return application.exitCode();
    QTemporaryDir folder;
    if (!folder.isValid())
        return application.usageError(QStringLiteral("no folder for the histories: %1").arg(folder.errorString()));

    soak::SoakReport report;
    report.profile = options.profile.name;
    report.seed = options.seed;
    report.seconds = options.seconds;
    report.error = runIn(folder.path(), options);
    QString unreadable;
    if (soak::Evidence::read(folder.path(), options.profile, &report.evidence, &unreadable))
        report.gates = soak::judge(report.evidence, options.profile);
    else
        report.error = unreadable;
    folder.setAutoRemove(!options.keep && report.passed());
    if (!folder.autoRemove())
        report.folder = folder.path();
    std::fputs(qPrintable(report.toText()), stdout);
    const bool isWritten = writeJson(options.json, report.toJson());
    if (!isWritten || report.verdict() == soak::SoakReport::Failed)
        return QPlcCoreApplication::Failure;
    return report.passed() ? int(QPlcCoreApplication::Success) : NotJudged;
}
