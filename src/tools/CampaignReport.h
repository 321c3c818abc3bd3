// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CampaignPlant.h"

namespace tools {

/// What a campaign has measured in one case.
struct CampaignResult
{
    CampaignCase of;
    QPlcCycleStatistics plant;
    QString scheduling;           // that the cycle of the master has obtained: "SCHED_FIFO 49"
    QPlcDistribution cyclictest;  // no values: it did not run
    QStringList notes;            // what went wrong; empty: nothing

    /// From the nominal time of the first cycle that was due to the next begin of a cycle [ns]. A
    /// lateness is less than a period: the cycles that are left out have the rest.
    qint64 longestDelay() const;
};

/// Something that a report says of the computer.
struct CampaignFact
{
    QString what;
    QString found;
};

/// A campaign as people and programs read it. It names the computer by what matters to real time,
/// and not by its name or that of its user.
class CampaignReport
{
public:
    CampaignReport(const CampaignSettings &settings, QVector<CampaignFact> computer);

    void add(const CampaignResult &result) { m_results.append(result); }
    const QVector<CampaignResult> &results() const { return m_results; }
    /// One line for each case.
    QByteArray csv() const;
    /// The bins of all distributions, one in a line.
    QByteArray histogramCsv() const;
    /// One line for each fact of the computer.
    QByteArray computerCsv() const;
    /// A page that contains all it needs.
    QByteArray html() const;

private:
    CampaignSettings m_settings;
    QVector<CampaignFact> m_computer;
    QVector<CampaignResult> m_results;
};

/// "udp, 1 ms, fifo, cpu"
QString caseText(const CampaignCase &of);
/// Model, memory, load, kernel parameters that matter to real time, and whether the computer is a
/// virtual one; and what doctor finds in /proc and /sys.
/// \param root  folder that has proc and sys
QVector<CampaignFact> computerFacts(const QString &root = QStringLiteral("/"));

}  // namespace tools
