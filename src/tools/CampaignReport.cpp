// SPDX-License-Identifier: Apache-2.0
#include "CampaignReport.h"

#include "realtime/Host.h"
#include "realtime/SystemCheck.h"
#include "recording/RecordingReport.h"
#include "recording/ReportDrawing.h"
#include "signals/DurationText.h"

#include <QtCore/QDateTime>
#include <QtCore/QRegularExpression>

#include <algorithm>

namespace tools {

namespace {

constexpr int worstCyclesShown = 5;

QString loadText(const CampaignCase &of)
{
    return of.load.isEmpty() ? QStringLiteral("idle") : of.load;
}

QString policyText(const CampaignCase &of)
{
    return of.isRealTime ? QStringLiteral("fifo") : QStringLiteral("other");
}

QString micro(qint64 nanoseconds)
{
    return QString::number(double(nanoseconds) * 1e-3, 'f', 1);
}

/// p50, p99, p99.9 and the largest one [us]; nothing where there are no values.
QStringList figures(const QPlcDistribution &of)
{
    if (of.count == 0)
        return {QString(), QString(), QString(), QString()};
    return {micro(of.p50), micro(of.p99), micro(of.p999), micro(of.maximum)};
}

QByteArray quotedForCsv(QString text)
{
    return '"' + text.replace(QLatin1Char('"'), QLatin1String("\"\"")).toUtf8() + '"';
}

QString row(const QStringList &cells)
{
    QStringList safe;
    for (QString cell : cells)
        safe << cell.replace(QLatin1Char('|'), QLatin1Char('/')).replace(QLatin1Char('\n'), QLatin1Char(' '));
    return QStringLiteral("| %1 |\n").arg(safe.join(QLatin1String(" | ")));
}

QString tableHead(const QStringList &titles)
{
    return row(titles) + QLatin1Char('|') + QStringLiteral("---|").repeated(titles.size()) + QLatin1Char('\n');
}

QByteArray drawingOf(const QPlcDistribution &of)
{
    qplc::LatenessHistogram histogram;
    for (const QPlcDistribution::Bin &bin : of.bins)
        histogram.add(bin.upperBorder, bin.count);
    return qplc::drawingOf(histogram);
}

/// As the drawings have it; the unit stays beside its number.
QString shown(qint64 nanoseconds)
{
    return qplc::shortDuration(double(nanoseconds) * 1e-9).replace(QLatin1Char(' '), QChar(QChar::Nbsp));
}

QString worstTable(const QVector<QPlcWorstCycle> &cycles)
{
    QString text = tableHead({QStringLiteral("worst cycle"), QStringLiteral("lateness"), QStringLiteral("round trip"),
                              QStringLiteral("execution"), QStringLiteral("left out before")});
    for (const QPlcWorstCycle &cycle : cycles.mid(0, worstCyclesShown))
        text += row({QString::number(cycle.cycle), shown(cycle.lateness),
                     cycle.roundTrip == 0 ? QStringLiteral("no answer") : shown(cycle.roundTrip),
                     shown(cycle.execution), QString::number(cycle.skipped)});
    return text;
}

QString durationOf(const QPlcDistribution &of, qint64 value)
{
    return of.count == 0 ? QStringLiteral("-") : shown(value);
}

QString summaryRow(const CampaignResult &result)
{
    const QPlcDistribution &lateness = result.plant.lateness.sinceStart;
    const QPlcDistribution &roundTrip = result.plant.roundTrip.sinceStart;
    const QPlcDistribution &other = result.cyclictest;
    return row({caseText(result.of), QString::number(result.plant.cycles), QString::number(result.plant.skippedCycles),
                durationOf(lateness, lateness.p50), durationOf(lateness, lateness.p99),
                durationOf(lateness, lateness.p999), durationOf(lateness, lateness.maximum),
                durationOf(roundTrip, roundTrip.p99), durationOf(roundTrip, roundTrip.maximum),
                durationOf(other, other.p99), durationOf(other, other.maximum),
                result.notes.join(QLatin1String("; "))});
}

/// The histogram of a case beside its worst cycles.
QByteArray detailsOf(const CampaignResult &result)
{
    return qplc::htmlOfMarkdown(QStringLiteral("## %1\n").arg(caseText(result.of))) + "<div class=\"plots\">"
        + drawingOf(result.plant.lateness.sinceStart) + "<div>" + qplc::htmlOfMarkdown(worstTable(result.plant.worst))
        + "</div></div>\n";
}

QString orUnknown(const QString &text)
{
    return text.isEmpty() ? QStringLiteral("unknown") : text;
}

/// Those of \a all that change when threads run; others may name disks or users.
QString kernelParameters(const QStringList &all)
{
    static const QRegularExpression matters(QStringLiteral(
        "^(isolcpus|nohz|nohz_full|rcu_nocbs|irqaffinity|threadirqs|preempt|idle|skew_tick|tsc|clocksource|mitigations|"
        "nosmt|maxcpus|cpufreq\\..*|cpuidle\\..*|processor\\..*|intel_idle\\..*|intel_pstate|amd_pstate|dwc_otg\\..*)"
        "(=.*)?$"));
    const QStringList words = all.filter(matters);
    return words.isEmpty() ? QStringLiteral("none that matters") : words.join(QLatin1Char(' '));
}

}  // namespace

qint64 CampaignResult::longestDelay() const
{
    qint64 longest = plant.lateness.sinceStart.maximum;
    for (const QPlcWorstCycle &cycle : plant.worst)
        longest = std::max(longest, cycle.lateness + qint64(cycle.skipped) * of.period.count());
    return longest;
}

QString caseText(const CampaignCase &of)
{
    return QStringLiteral("%1, %2, %3, %4")
        .arg(of.transport, qplc::durationText(of.period), policyText(of), loadText(of));
}

QVector<CampaignFact> computerFacts(const QString &folder)
{
    const qplc::SystemFacts system = qplc::SystemFacts::read(folder);
    QVector<CampaignFact> facts{{QStringLiteral("computer"), orUnknown(system.model)},
                                {QStringLiteral("memory"), orUnknown(system.memory)},
                                {QStringLiteral("virtual machine"),
                                 system.isVirtual ? QStringLiteral("yes") : QStringLiteral("no sign of one")},
                                {QStringLiteral("load average before"), orUnknown(system.load)},
                                {QStringLiteral("kernel parameters"), kernelParameters(system.kernelParameters)}};
    const QVector<qplc::Finding> findings
        = QVector<qplc::Finding>{qplc::judgeVersions(system)} + qplc::judgeFacts(system);
    for (const qplc::Finding &finding : findings)
        facts.append({finding.subject, finding.found});
    return facts;
}

CampaignReport::CampaignReport(const CampaignSettings &settings, QVector<CampaignFact> computer)
    : m_settings(settings)
    , m_computer(std::move(computer))
{
}

QByteArray CampaignReport::csv() const
{
    QByteArray text = "transport,period_us,policy,obtained,load,nodes,cycles,overruns,skipped,incomplete,"
                      "lateness_p50_us,lateness_p99_us,lateness_p999_us,lateness_max_us,longest_delay_us,"
                      "round_trip_p50_us,round_trip_p99_us,round_trip_p999_us,round_trip_max_us,"
                      "cyclictest_p50_us,cyclictest_p99_us,cyclictest_p999_us,cyclictest_max_us,note\n";
    for (const CampaignResult &result : m_results) {
        const QPlcCycleStatistics &plant = result.plant;
        const QStringList cells = QStringList{result.of.transport,
                                              micro(result.of.period.count()),
                                              policyText(result.of),
                                              result.scheduling,
                                              loadText(result.of),
                                              QString::number(m_settings.nodes),
                                              QString::number(plant.cycles),
                                              QString::number(plant.overruns),
                                              QString::number(plant.skippedCycles),
                                              QString::number(plant.incompleteCycles)}
            + figures(plant.lateness.sinceStart) + QStringList{micro(result.longestDelay())}
            + figures(plant.roundTrip.sinceStart) + figures(result.cyclictest);
        text += cells.join(QLatin1Char(',')).toUtf8() + ',' + quotedForCsv(result.notes.join(QLatin1String("; ")))
            + '\n';
    }
    return text;
}

QByteArray CampaignReport::histogramCsv() const
{
    QByteArray text = "transport,period_us,policy,load,quantity,at_most_us,count\n";
    for (const CampaignResult &result : m_results) {
        const QByteArray begin = QStringList{result.of.transport, micro(result.of.period.count()),
                                             policyText(result.of), loadText(result.of)}
                                     .join(QLatin1Char(','))
                                     .toUtf8();
        const auto add = [&](const char *quantity, const QPlcDistribution &of) {
            for (const QPlcDistribution::Bin &bin : of.bins)
                text += begin + ',' + quantity + ',' + micro(bin.upperBorder).toUtf8() + ','
                    + QByteArray::number(bin.count) + '\n';
        };
        add("lateness", result.plant.lateness.sinceStart);
        add("round trip", result.plant.roundTrip.sinceStart);
        add("cyclictest", result.cyclictest);
    }
    return text;
}

QByteArray CampaignReport::computerCsv() const
{
    QByteArray text = "what,found\n";
    for (const CampaignFact &fact : m_computer)
        text += quotedForCsv(fact.what) + ',' + quotedForCsv(fact.found) + '\n';
    return text;
}

QByteArray CampaignReport::html() const
{
    QString summary = QStringLiteral("# Results\n");
    summary += tableHead({QStringLiteral("case"), QStringLiteral("cycles"), QStringLiteral("left out"),
                          QStringLiteral("lateness p50"), QStringLiteral("p99"), QStringLiteral("p99.9"),
                          QStringLiteral("longest delay"), QStringLiteral("round trip p99"), QStringLiteral("max"),
                          QStringLiteral("cyclictest p99"), QStringLiteral("max"), QStringLiteral("notes")});
    QByteArray cases;
    for (const CampaignResult &result : m_results) {
        summary += summaryRow(result);
        if (result.plant.cycles > 0)
            cases += detailsOf(result);
    }
    QString computer = QStringLiteral("# Computer\n") + tableHead({QStringLiteral("what"), QStringLiteral("found")});
    for (const CampaignFact &fact : m_computer)
        computer += row({fact.what, fact.found});
    const QDateTime now = QDateTime::fromMSecsSinceEpoch(qplc::Host::current().wallClock() / 1'000'000, Qt::UTC);
    const QString subtitle = QStringLiteral("%1 · %2 s for each case, %3 nodes")
                                 .arg(now.toString(QStringLiteral("yyyy-MM-dd")))
                                 .arg(m_settings.duration.count())
                                 .arg(m_settings.nodes);
    return qplc::pageOf(QStringLiteral("Jitter campaign"), subtitle,
                        qplc::htmlOfMarkdown(summary) + qplc::htmlOfMarkdown(computer)
                            + qplc::htmlOfMarkdown(QStringLiteral("# Lateness of each case\n")) + cases);
}

}  // namespace tools
