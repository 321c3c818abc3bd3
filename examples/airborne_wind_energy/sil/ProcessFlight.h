// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ProcessGroup.h"

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>
#include <QtCore/QTemporaryDir>

namespace awe {

/// What each program of a flight is told.
struct ProcessArguments
{
    QString modelProgram = QStringLiteral("awe_compact_model");
    QStringList master;
    QStringList model;
    QStringList autopilot;
    QString transport;   // "tcp", "udp", "udp-multicast", "local"
    QString hardware;    // configuration of the node Winch; empty: there is none
    QStringList winch;   // of the simulated drive; empty: there is none
    bool watch = false;  // the master draws on the terminal
};

/// The flight with master, model and autopilot as processes of their own; with a winch drive also
/// the node Winch, and the drive where it is simulated.
class ProcessFlight : public QObject
{
    Q_OBJECT
public:
    /// \return false when a program could not be started
    bool begin(const ProcessArguments &arguments);
    /// Ends the flight before its time, with a report of what was flown.
    void end();

    /// The report; empty when there is none.
    QJsonObject report() const { return m_report; }

Q_SIGNALS:
    void finished(int exitCode);

private:
    void startNodes();
    QStringList nodes() const;
    ProcessGroup::Errors errorsOfNodes() const;
    void hardwareEnded(const QString &program, int exitCode);
    void plugInDevices() const;
    bool startDrive();
    bool startWinch();
    /// A file for other processes: where it is, or a copy of what is compiled into this program.
    QString accessible(const QString &fileName);
    void ended(const QString &program, int exitCode);

    ProcessArguments m_arguments;
    QString m_address;  // of the master, for nodes
    QTemporaryDir m_directory;
    QJsonObject m_report;
    ChildProcess *m_master = nullptr;
    bool m_nodesStarted = false;
    bool m_ending = false;
    ProcessGroup m_processes;
};

}  // namespace awe
