// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BenchPlant.h"
#include "ProcessUsage.h"
#include "SlaveProcesses.h"

#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>

/// The master process: starts the slaves, runs the cycles, and measures.
class BenchMaster
{
public:
    explicit BenchMaster(const BenchOptions &options);

    /// \return false when it cannot be measured: errorString() says why
    bool run();
    QString errorString() const { return m_errorString; }
    /// One object with the figures of the run; the names are those that other programs of this kind
    /// use.
    QJsonObject result() const;

private:
    struct Snapshot
    {
        ProcessUsage master;
        ProcessUsage slaves;
        LoopbackUsage loopback;
        qint64 time = 0;  // [ns]
        QPlcCycleStatistics statistics;
    };

    bool prepare();
    bool makeKeys();
    bool addSlaves();
    bool waitForSlaves();
    bool startPhase();
    void stopPhase();
    void wait(double seconds);
    Snapshot snapshot() const;
    bool setError(const QString &text);
    void addUsage(QJsonObject *fields, double cycles) const;

    const BenchOptions &m_options;
    QPlcMasterNode m_master;
    BenchProbe m_probe;
    std::vector<std::unique_ptr<BenchSlave>> m_localSlaves;
    SlaveProcesses m_processes;
    QTemporaryDir m_keysFolder;
    QString m_keysFile;           // empty: no security
    double m_registration = 0.0;  // [s] from the start of the first process until all are registered
    double m_start = 0.0;         // [s] from there until cycles run
    quint64 m_allCycles = 0;      // of all phases, those that were not measured included
    Snapshot m_before;
    Snapshot m_after;
    QString m_errorString;
};
