// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"
#include "WaitLine.h"
#include "realtime/SystemCheck.h"
#include "transport/LoopbackProbe.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace tools {

namespace {

using qplc::Finding;

constexpr int wakeUps = 1000;
constexpr std::chrono::milliseconds wakeUpPeriod{1};
constexpr int datagrams = 2000;
constexpr int tryPriority = 49;

const char *verdictText(Finding::Verdict verdict)
{
    switch (verdict) {
    case Finding::Ok:
        return "ok";
    case Finding::ToCure:
        return "to cure";
    case Finding::Unknown:
        break;
    }
    return "unknown";
}

qplc::WakeUps tryOrdinary()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Other;
    return qplc::probeWakeUps(options, wakeUpPeriod, wakeUps);
}

qplc::WakeUps tryRealTime()
{
    QPlcRealTimeOptions options;
    options.policy = QPlcRealTimeOptions::Fifo;
    options.priority = tryPriority;
    options.lockMemory = true;
    return qplc::probeWakeUps(options, wakeUpPeriod, wakeUps);
}

QVector<Finding> examine()
{
    WaitLine line;
    const qplc::SystemFacts facts = qplc::SystemFacts::read();
    QVector<Finding> findings{qplc::judgeVersions(facts)};
    findings += qplc::judgeFacts(facts);
    line.show(QStringLiteral("measures 1 of 3: wakes up %1 times, 1 s").arg(wakeUps));
    const qplc::WakeUps ordinary = tryOrdinary();
    line.show(QStringLiteral("measures 2 of 3: wakes up %1 times with real-time priority, 1 s").arg(wakeUps));
    findings += qplc::judgeEffects(facts, ordinary, tryRealTime());
    line.show(QStringLiteral("measures 3 of 3: sends %1 datagrams to itself").arg(datagrams));
    qplc::Histogram roundTrips;
    qplc::probeLoopback(
        datagrams, [] { return qplc::monotonicNow(); }, [&roundTrips](std::int64_t time) { roundTrips.record(time); });
    findings += qplc::judgeLoopback(roundTrips);
    return findings;
}

Tone toneOf(Finding::Verdict verdict)
{
    return verdict == Finding::Ok ? Tone::Good : verdict == Finding::ToCure ? Tone::Bad : Tone::Caution;
}

QStringList subjectsWith(const QVector<Finding> &findings, Finding::Verdict verdict)
{
    QStringList subjects;
    for (const Finding &finding : findings) {
        if (finding.verdict == verdict)
            subjects << finding.subject;
    }
    subjects.removeDuplicates();
    return subjects;
}

/// "Not ready for real time: cure scheduling, memory."
QString summaryOf(const QVector<Finding> &findings)
{
    const QStringList toCure = subjectsWith(findings, Finding::ToCure);
    const QStringList unknown = subjectsWith(findings, Finding::Unknown);
    QString text = toCure.isEmpty()
        ? QStringLiteral("Ready for real time.")
        : QStringLiteral("Not ready for real time: cure %1.").arg(toCure.join(QStringLiteral(", ")));
    if (!unknown.isEmpty())
        text += QStringLiteral(" Not known: %1.").arg(unknown.join(QStringLiteral(", ")));
    return text;
}

void print(const QVector<Finding> &findings, bool isHealthy)
{
    constexpr int verdictWidth = 9;
    int subjectWidth = 0;
    for (const Finding &finding : findings)
        subjectWidth = qMax(subjectWidth, displayWidth(finding.subject) + 1);
    for (const Finding &finding : findings) {
        const QString verdict = padded(QLatin1String(verdictText(finding.verdict)), verdictWidth);
        printWrapped(toned(verdict, toneOf(finding.verdict)) + padded(finding.subject, subjectWidth),
                     verdictWidth + subjectWidth, printable(finding.found));
        QString label = QStringLiteral("cure:");
        for (const QString &way : finding.remedy.split(QStringLiteral("; or "), Qt::SkipEmptyParts)) {
            printLine(QStringLiteral("         %1 %2").arg(label, -5).arg(printable(way)));
            label = QStringLiteral("  or:");
        }
    }
    printLine(QString());
    printLine(toned(printable(summaryOf(findings)), isHealthy ? Tone::Good : Tone::Bad));
}

void printAsJson(const QVector<Finding> &findings, bool isHealthy)
{
    QJsonArray array;
    for (const Finding &finding : findings) {
        QJsonObject object{{QStringLiteral("subject"), finding.subject},
                           {QStringLiteral("verdict"), QLatin1String(verdictText(finding.verdict))},
                           {QStringLiteral("found"), finding.found}};
        if (!finding.remedy.isEmpty())
            object.insert(QStringLiteral("cure"), finding.remedy);
        array.append(object);
    }
    printJson(QJsonDocument(QJsonObject{{QStringLiteral("ok"), isHealthy},
                                        {QStringLiteral("summary"), summaryOf(findings)},
                                        {QStringLiteral("findings"), array}}));
}

}  // namespace

int examineComputer(const CommandCall &call)
{
    const QVector<Finding> findings = examine();
    const bool isHealthy = std::none_of(findings.begin(), findings.end(),
                                        [](const Finding &finding) { return finding.verdict == Finding::ToCure; });
    call.isJson() ? printAsJson(findings, isHealthy) : print(findings, isHealthy);
    return isHealthy ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
}

}  // namespace tools
