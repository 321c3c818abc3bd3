// SPDX-License-Identifier: Apache-2.0
// campaign: measures the jitter of this computer in many cases, and writes a report.
#include "CampaignPrograms.h"
#include "CampaignReport.h"
#include "Commands.h"
#include "HistogramText.h"
#include "TerminalText.h"
#include "WaitFor.h"
#include "WaitLine.h"
#include "realtime/WakeUpProbe.h"
#include "recording/OutputFile.h"
#include "signals/DurationText.h"

#include <QtCore/QDir>
#include <QtCore/QJsonObject>
#include <QtCore/QLoggingCategory>
#include <QtCore/QStandardPaths>
#include <QtCore/QStorageInfo>

#include <algorithm>

namespace tools {

namespace {

constexpr int mostCases = 200;
constexpr int mostCampaignNodes = 32;
constexpr qint64 longestCase = 24 * 3600;                   // [s]
constexpr qint64 spaceForDisk = qint64(512) * 1024 * 1024;  // [byte] that its load needs
constexpr std::chrono::milliseconds campaignPause{100};     // between two looks at the plant and its load
constexpr std::chrono::seconds longestCyclictestEnd{10};
constexpr std::int64_t shortestCampaignPeriod = 100'000;       // [ns]
constexpr std::int64_t longestCampaignPeriod = 1'000'000'000;  // [ns]

struct Campaign
{
    CampaignSettings settings;
    QVector<CampaignCase> cases;
    QVector<CampaignLoad> loads;
    QString folder;
};

QStringList words(const CommandCall &call, const char *option)
{
    QStringList list = call.listOf(option);
    for (QString &word : list)
        word = word.trimmed();
    list.removeDuplicates();
    return list;
}

bool refuse(const CommandCall &call, const QString &text)
{
    call.application.usageError(text);
    return false;
}

/// The words of \a option; all must be among \a known.
bool readChoice(const CommandCall &call, const char *option, const QStringList &known, const QStringList &usual,
                QStringList *result)
{
    *result = call.application.isSet(QLatin1String(option)) ? words(call, option) : usual;
    for (const QString &word : qAsConst(*result)) {
        if (!known.contains(word))
            return refuse(call,
                          QStringLiteral("--%1: there is no '%2'; use some of %3, with commas between them")
                              .arg(QLatin1String(option), word, known.join(QLatin1String(", "))));
    }
    return !result->isEmpty()
        || refuse(call,
                  QStringLiteral("--%1 names nothing; use some of %2")
                      .arg(QLatin1String(option), known.join(QLatin1String(", "))));
}

bool readPeriods(const CommandCall &call, QVector<std::chrono::nanoseconds> *periods)
{
    const QStringList texts = call.application.isSet(QStringLiteral("periods"))
        ? words(call, "periods")
        : QStringList{QStringLiteral("10ms"), QStringLiteral("1ms")};
    for (const QString &text : texts) {
        double period = 0.0;
        if (!qplc::durationFromText(text, &period)
            || !(period >= shortestCampaignPeriod && period <= longestCampaignPeriod))
            return refuse(
                call,
                QStringLiteral("--periods: '%1' is not a period of 100us to 1s; use for example 10ms,1ms").arg(text));
        periods->append(std::chrono::nanoseconds(qRound64(period)));
    }
    return !periods->isEmpty() || refuse(call, QStringLiteral("--periods names no period; use for example 10ms,1ms"));
}

bool readLoads(const CommandCall &call, Campaign *campaign)
{
    const QVector<CampaignLoad> known = CampaignLoad::known(campaign->folder);
    QStringList names;
    for (const CampaignLoad &load : known)
        names << load.name;
    const bool hasCommand = call.application.isSet(QStringLiteral("command"));
    QStringList wanted;
    if (!readChoice(call, "loads", names, hasCommand ? names.mid(0, 1) : names, &wanted))
        return false;
    for (const CampaignLoad &load : known) {
        if (wanted.contains(load.name))
            campaign->loads.append(load);
    }
    if (hasCommand) {
        const QString command = call.application.value(QStringLiteral("command"));
        if (command.trimmed().isEmpty())
            return refuse(call, QStringLiteral("--command is empty; give a command for the shell"));
        campaign->loads.append({QStringLiteral("command"), command});
    }
    const bool needsStress = wanted != names.mid(0, 1);
    return !needsStress || !QStandardPaths::findExecutable(QStringLiteral("stress-ng")).isEmpty()
        || refuse(call,
                  QStringLiteral("the loads need stress-ng, which is not there: sudo apt install stress-ng, or "
                                 "measure without them: --loads idle"));
}

bool readSettings(const CommandCall &call, CampaignSettings *settings)
{
    qint64 seconds = settings->duration.count();
    qint64 nodes = settings->nodes;
    qint64 priority = settings->priority;
    qint64 cpu = -1;
    if (!call.readInteger("for", 1, longestCase, &seconds) || !call.readInteger("nodes", 1, mostCampaignNodes, &nodes)
        || !call.readInteger("priority", 2, 98, &priority) || !call.readInteger("cpu", 0, 1023, &cpu))
        return false;
    settings->duration = std::chrono::seconds(seconds);
    settings->nodes = int(nodes);
    settings->priority = int(priority);
    if (cpu >= 0)
        settings->cpu = int(cpu);
    return true;
}

/// All combinations. Ordinary scheduling comes first: memory that is locked once stays locked.
bool readCases(const CommandCall &call, Campaign *campaign)
{
    const QStringList knownPolicies{QStringLiteral("other"), QStringLiteral("fifo")};
    QVector<std::chrono::nanoseconds> periods;
    QStringList transports;
    QStringList policies;
    if (!readPeriods(call, &periods)
        || !readChoice(call, "transports", {QStringLiteral("udp"), QStringLiteral("tcp"), QStringLiteral("local")},
                       {QStringLiteral("udp")}, &transports)
        || !readChoice(call, "policies", knownPolicies, knownPolicies, &policies))
        return false;
    for (const QString &policy : knownPolicies) {
        if (!policies.contains(policy))
            continue;
        for (const auto period : qAsConst(periods)) {
            for (const QString &transport : qAsConst(transports)) {
                for (const CampaignLoad &load : qAsConst(campaign->loads))
                    campaign->cases.append({transport, period, policy == knownPolicies.last(),
                                            load.command.isEmpty() ? QString() : load.name});
            }
        }
    }
    return campaign->cases.size() <= mostCases
        || refuse(call,
                  QStringLiteral("%1 cases are too many; use at most %2").arg(campaign->cases.size()).arg(mostCases));
}

/// Asks the system for what the cycles will want, so that no case is measured without it.
bool mayMeasure(const CommandCall &call, const CampaignSettings &settings, bool isRealTime)
{
    const qplc::WakeUps tried
        = qplc::probeWakeUps(settings.optionsOfMaster(isRealTime), std::chrono::milliseconds(1), 1);
    for (const QPlcRealTimeSetting &setting : tried.settings) {
        if (!setting.granted)
            return refuse(
                call,
                QStringLiteral("%1: wanted %2, obtained %3: %4%5")
                    .arg(setting.name, setting.wanted, setting.obtained, setting.remedy,
                         isRealTime ? QStringLiteral("; or measure without real time: --policies other") : QString()));
    }
    return true;
}

bool readCampaign(const CommandCall &call, Campaign *campaign)
{
    campaign->folder = call.application.value(QStringLiteral("output"));
    if (campaign->folder.isEmpty())
        return refuse(call, QStringLiteral("there is no folder for the report; use --output FOLDER"));
    if (!readSettings(call, &campaign->settings) || !readLoads(call, campaign) || !readCases(call, campaign))
        return false;
    for (const bool isRealTime : {false, true}) {
        const bool isWanted = std::any_of(campaign->cases.begin(), campaign->cases.end(),
                                          [&](const CampaignCase &of) { return of.isRealTime == isRealTime; });
        if (isWanted && !mayMeasure(call, campaign->settings, isRealTime))
            return false;
    }
    return true;
}

bool makeFolder(const CommandCall &call, const Campaign &campaign)
{
    const QString &folder = campaign.folder;
    if (QDir(folder).exists(QStringLiteral("campaign.csv")) && !call.application.isSet(QStringLiteral("force")))
        return refuse(
            call, QStringLiteral("there is a campaign in '%1' already; use another folder, or --force").arg(folder));
    if (!QDir().mkpath(folder))
        return refuse(call, QStringLiteral("cannot make the folder '%1': use another one").arg(folder));
    const qint64 space = QStorageInfo(folder).bytesAvailable();
    const bool hasDisk = std::any_of(campaign.loads.begin(), campaign.loads.end(),
                                     [](const CampaignLoad &load) { return load.name == QLatin1String("disk"); });
    return !hasDisk || space >= spaceForDisk
        || refuse(call,
                  QStringLiteral("the disk of '%1' has %2 MiB of free space, and the load 'disk' needs %3: make room, "
                                 "or measure without it (--loads)")
                      .arg(folder)
                      .arg(space >> 20)
                      .arg(spaceForDisk >> 20));
}

/// Replaces the files of a campaign, each as a whole: what was measured before stays if this
/// program is ended.
bool writeCampaign(const QString &folder, const CampaignReport &report, QString *error)
{
    const QVector<QPair<QString, QByteArray>> files{{QStringLiteral("campaign.csv"), report.csv()},
                                                    {QStringLiteral("histograms.csv"), report.histogramCsv()},
                                                    {QStringLiteral("computer.csv"), report.computerCsv()},
                                                    {QStringLiteral("campaign.html"), report.html()}};
    return std::all_of(files.begin(), files.end(), [&](const QPair<QString, QByteArray> &content) {
        qplc::OutputFile file(QDir(folder).filePath(content.first), qplc::OutputFile::Replace);
        return file.open(error) && file.write(content.second, error) && file.commit(error);
    });
}

/// Adds what cyclictest has found, once it ends.
void takeCyclictest(const CampaignProgram &program, CampaignResult *result)
{
    (void)waitFor(longestCyclictestEnd, campaignPause, [&program] { return !program.isRunning(); });
    result->cyclictest = cyclictestResult(program.output());
    if (result->cyclictest.count == 0)
        result->notes << QStringLiteral("cyclictest has measured nothing: %1")
                             .arg(program.isRunning() ? QStringLiteral("it does not end") : program.endText());
}

void takePlant(const CampaignPlant &plant, CampaignResult *result)
{
    result->plant = plant.statistics();
    const QVector<QPlcRealTimeSetting> settings = plant.realTimeSettings();
    for (const QPlcRealTimeSetting &setting : settings) {
        if (setting.name == QLatin1String("scheduling"))
            result->scheduling = setting.obtained;
        if (!setting.granted)
            result->notes << QStringLiteral("%1 was refused").arg(setting.name);
    }
}

/// One case, with its load and cyclictest. It ends early when one of them is of no use.
CampaignResult measureCase(const Campaign &campaign, const CampaignCase &of)
{
    const CampaignSettings &settings = campaign.settings;
    CampaignResult result;
    result.of = of;
    std::unique_ptr<CampaignProgram> load;
    for (const CampaignLoad &known : campaign.loads) {
        if (known.name == of.load)
            load = std::make_unique<CampaignProgram>(known.command);
    }
    CampaignPlant plant;
    QString error;
    if (!plant.prepare(of, settings, &error)) {
        result.notes << error;
        return result;
    }
    // Before the cycles start, since the birth of a process delays all threads of this one.
    const QString test = cyclictestCommand(of.period, of.isRealTime ? settings.priority - 1 : 0, settings.duration);
    const auto beside = test.isEmpty() ? nullptr : std::make_unique<CampaignProgram>(test);
    if (!plant.start(&error)) {
        result.notes << error;
        return result;
    }
    const auto isOver = [&] { return !plant.isRunning() || (load && !load->isRunning()); };
    const Waited waited = waitFor(settings.duration, campaignPause, isOver);
    takePlant(plant, &result);
    if (!plant.isRunning())
        result.notes << QStringLiteral("the cycles have ended early");
    if (load && !load->isRunning())
        result.notes << QStringLiteral("the load has ended early: %1").arg(load->endText());
    if (waited == Waited::TimeIsUp && beside)
        takeCyclictest(*beside, &result);
    return result;
}

QString hoursText(qint64 seconds)
{
    return seconds < 120 ? QStringLiteral("%1 s").arg(seconds)
        : seconds < 7200 ? QStringLiteral("%1 min").arg((seconds + 30) / 60)
                         : QStringLiteral("%1 h").arg(double(seconds) / 3600.0, 0, 'f', 1);
}

void showPlan(const Campaign &campaign)
{
    constexpr qint64 around = 2;  // [s] of each case, to start and to end
    const qint64 seconds = campaign.settings.duration.count();
    QString text = QStringLiteral("cases: %1, each %2, %3 in total")
                       .arg(campaign.cases.size())
                       .arg(hoursText(seconds), hoursText(campaign.cases.size() * (seconds + around)));
    if (cyclictestCommand(std::chrono::milliseconds(1), 0, campaign.settings.duration).isEmpty())
        text += QStringLiteral("; cyclictest is not installed, so it does not run beside them (package rt-tests)");
    printLine(text);
}

void showCase(const CampaignResult &result, int number, int count)
{
    const QPlcDistribution &lateness = result.plant.lateness.sinceStart;
    QString text = QStringLiteral("%1 of %2  %3: ").arg(number).arg(count).arg(caseText(result.of));
    if (lateness.count > 0)
        text += QStringLiteral("lateness p50 %1, p99 %2; longest delay %3, %4 cycles left out")
                    .arg(durationText(double(lateness.p50)), durationText(double(lateness.p99)),
                         durationText(double(result.longestDelay())))
                    .arg(result.plant.skippedCycles);
    if (!result.notes.isEmpty())
        text += (lateness.count > 0 ? QStringLiteral("; ") : QString()) + result.notes.join(QLatin1String("; "));
    printLine(printable(text));
}

/// \return false when a result could not be written
bool measureAll(const CommandCall &call, const Campaign &campaign, const bool &endIsWanted, CampaignReport *report)
{
    const int count = campaign.cases.size();
    for (int i = 0; i < count; ++i) {
        CampaignResult result;
        {
            WaitLine line;
            line.show(QStringLiteral("%1 of %2: %3, %4")
                          .arg(i + 1)
                          .arg(count)
                          .arg(caseText(campaign.cases.at(i)), hoursText(campaign.settings.duration.count())));
            result = measureCase(campaign, campaign.cases.at(i));
        }
        if (endIsWanted)
            return true;
        report->add(result);
        if (!call.isJson())
            showCase(result, i + 1, count);
        QString error;
        if (!writeCampaign(campaign.folder, *report, &error)) {
            QPlcCoreApplication::printError(error);
            return false;
        }
    }
    return true;
}

}  // namespace

int runCampaign(const CommandCall &call)
{
    Campaign campaign;
    if (!readCampaign(call, &campaign) || !makeFolder(call, campaign))
        return call.application.exitCode();
    const auto endIsWanted = call.quitOnSignals();
    // The report has what a master says in the log: who comes, and who is late under load.
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*.info=false\nqtplc.*.warning=false"));
    CampaignReport report(campaign.settings, computerFacts());
    QString error;
    if (!writeCampaign(campaign.folder, report, &error))
        return call.application.usageError(error);
    if (!call.isJson())
        showPlan(campaign);
    if (!measureAll(call, campaign, *endIsWanted, &report))
        return QPlcCoreApplication::Failure;
    const QVector<CampaignResult> &results = report.results();
    const int count = campaign.cases.size();
    const bool isWell = results.size() == count
        && std::all_of(results.begin(), results.end(),
                       [](const CampaignResult &result) { return result.notes.isEmpty(); });
    if (call.isJson())
        printJson(QJsonDocument(QJsonObject{{QStringLiteral("folder"), campaign.folder},
                                            {QStringLiteral("cases"), results.size()},
                                            {QStringLiteral("planned"), count},
                                            {QStringLiteral("ok"), isWell}}));
    else
        printLine(printable(QStringLiteral("%1 of %2 cases are in '%3'; open campaign.html")
                                .arg(results.size())
                                .arg(count)
                                .arg(campaign.folder)));
    return isWell ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace tools
