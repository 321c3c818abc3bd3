// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDistribution.h"

#include <QtCore/QString>
#include <QtCore/QVector>

#include <chrono>
#include <memory>

namespace tools {

/// A load that runs beside a measurement.
struct CampaignLoad
{
    QString name;
    QString command;  // for the shell; empty: nothing runs

    /// The loads that a campaign knows: idle, cpu, memory, disk, network.
    /// \param folder  where the load of the disk writes
    static QVector<CampaignLoad> known(const QString &folder);
};

/// A program that runs beside a measurement, with ordinary scheduling. It ends with this object,
/// and so does all that it has started in its process group. If this program is killed, the kernel
/// sends it SIGTERM.
class CampaignProgram
{
public:
    /// Starts it. \param command  for the shell
    explicit CampaignProgram(const QString &command);
    ~CampaignProgram();

    bool isRunning() const;
    /// How it has ended, with what it has said, or why it could not be started; empty: it runs.
    QString endText() const;
    /// What it has written; as much as fits into 1 MiB.
    QByteArray output() const;

private:
    class Process;

    std::unique_ptr<Process> m_process;
};

/// Command of cyclictest for as long as a measurement takes; empty where it is not installed. It
/// changes no settings of the system, so both measure the same.
/// \param priority  of SCHED_FIFO; 0: SCHED_OTHER
QString cyclictestCommand(std::chrono::nanoseconds period, int priority, std::chrono::seconds duration);
/// What cyclictest writes with --histogram: latencies [us] and how often. Those beyond its rows
/// count as its maximum. \return no values when \a output is something else
QPlcDistribution cyclictestResult(const QByteArray &output);

}  // namespace tools
