// SPDX-License-Identifier: Apache-2.0
#include "SoakReport.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace soak {

namespace {

/// Counts of the faults that were done, by name.
QMap<QString, int> faultsByName(const Evidence &evidence)
{
    QMap<QString, int> counts;
    for (const DoneFault &fault : evidence.faults)
        ++counts[QString::fromLatin1(FaultNames[std::size_t(fault.kind)])];
    return counts;
}

QJsonObject toObject(const Gate &gate)
{
    QJsonObject figures;
    for (auto figure = gate.figures.begin(); figure != gate.figures.end(); ++figure)
        figures.insert(figure.key(), *figure);
    return {{QStringLiteral("name"), gate.name},
            {QStringLiteral("asked"), gate.isAsked},
            {QStringLiteral("passed"), gate.passed()},
            {QStringLiteral("looked"), double(gate.looked)},
            {QStringLiteral("failed"), double(gate.failed)},
            {QStringLiteral("excused"), double(gate.excused)},
            {QStringLiteral("examples"), QJsonArray::fromStringList(gate.examples)},
            {QStringLiteral("figures"), figures}};
}

QString lineOf(const Gate &gate)
{
    const QString result = !gate.isAsked ? QStringLiteral("-   ")
        : gate.passed()                  ? QStringLiteral("ok  ")
                                         : QStringLiteral("FAIL");
    QString line = QStringLiteral("%1  %2 %3 looked at, %4 failed, %5 excused\n")
                       .arg(result, gate.name.leftJustified(28))
                       .arg(gate.looked, 8)
                       .arg(gate.failed)
                       .arg(gate.excused);
    for (auto figure = gate.figures.begin(); figure != gate.figures.end(); ++figure)
        line += QStringLiteral("          %1: %2\n").arg(figure.key()).arg(*figure);
    for (const QString &example : gate.examples)
        line += QStringLiteral("        ! %1\n").arg(example);
    return line;
}

}  // namespace

SoakReport::Verdict SoakReport::verdict() const
{
    if (!error.isEmpty() || gates.empty())
        return Failed;
    if (std::all_of(gates.begin(), gates.end(), [](const Gate &gate) { return gate.passed(); }))
        return Passed;
    const bool isExcused
        = std::all_of(gates.begin(), gates.end(), [](const Gate &gate) { return gate.passed() || gate.isOfTime; });
    return isExcused && evidence.stalls.shareOf(evidence.runner) > MostStalls ? Unjudged : Failed;
}

QString SoakReport::command() const
{
    return QStringLiteral("qtplc_soak --profile %1 --seed %2 --duration %3 --nodes %4 --hz %5 --keep")
        .arg(profile)
        .arg(seed)
        .arg(seconds)
        .arg(evidence.shape.nodes)
        .arg(1'000'000'000 / evidence.period);
}

QJsonObject SoakReport::toJson() const
{
    QJsonObject faults;
    const QMap<QString, int> counts = faultsByName(evidence);
    for (auto count = counts.begin(); count != counts.end(); ++count)
        faults.insert(count.key(), *count);
    QJsonArray all;
    for (const Gate &gate : gates)
        all.append(toObject(gate));
    return {{QStringLiteral("profile"), profile},
            {QStringLiteral("seed"), QString::number(seed)},
            {QStringLiteral("seconds"), seconds},
            {QStringLiteral("command"), command()},
            {QStringLiteral("passed"), passed()},
            {QStringLiteral("error"), error},
            {QStringLiteral("nodes"), evidence.shape.nodes},
            {QStringLiteral("signals_per_node"), evidence.shape.signalCount},
            {QStringLiteral("period_us"), double(evidence.period) * 1e-3},
            {QStringLiteral("stalls_of_the_machine"), double(evidence.stalls.count())},
            {QStringLiteral("share_of_stalls"), evidence.stalls.shareOf(evidence.runner)},
            {QStringLiteral("judged"), verdict() != Unjudged},
            {QStringLiteral("faults"), faults},
            {QStringLiteral("gates"), all}};
}

QString SoakReport::toText() const
{
    QString text = QStringLiteral("soak %1: %2 nodes x %3 signals x %4 Hz, seed %5\n")
                       .arg(profile)
                       .arg(evidence.shape.nodes)
                       .arg(evidence.shape.signalCount)
                       .arg(1e9 / double(evidence.period))
                       .arg(seed);
    const QMap<QString, int> counts = faultsByName(evidence);
    text += QStringLiteral("%1 faults:").arg(evidence.faults.size());
    for (auto count = counts.begin(); count != counts.end(); ++count)
        text
            += QStringLiteral(" %1 %2%3").arg(*count).arg(count.key()).arg(std::next(count) == counts.end() ? "" : ",");
    text += QStringLiteral("\nstalls of the machine: %1, %2 % of the time\n\n")
                .arg(evidence.stalls.count())
                .arg(100.0 * evidence.stalls.shareOf(evidence.runner), 0, 'f', 1);
    for (const Gate &gate : gates)
        text += lineOf(gate);
    if (!error.isEmpty())
        text += QStringLiteral("\nended early: %1\n").arg(error);
    switch (verdict()) {
    case Passed:
        text += QStringLiteral("\npassed\n");
        break;
    case Unjudged:
        text += QStringLiteral("\nNOT JUDGED: values and commands passed, but the machine stood still for more than %1 "
                               "% of the time, "
                               "which makes gates of time fail; again, on a calm machine: %2\n")
                    .arg(100.0 * MostStalls)
                    .arg(command());
        break;
    case Failed:
        text += QStringLiteral("\nFAILED with seed %1; again: %2\n").arg(seed).arg(command());
    }
    if (!folder.isEmpty())
        text += QStringLiteral("histories and logs: %1\n").arg(folder);
    return text;
}

}  // namespace soak
