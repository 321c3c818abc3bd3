// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

/// The command line of qtplc_cycle_bench.
struct BenchOptions
{
    QString transport = QStringLiteral("udp");  // udp, udp-multicast, tcp, local, inprocess
    int slaves = 1;
    int inputs = 3;       // Real32 signals, master -> slave
    int outputs = 32;     // Real32 signals, slave -> master
    int description = 0;  // [characters] of each signal
    int periodUs = 0;     // 0: back to back
    double seconds = 1.0;
    double warmup = 0.2;  // [s] before it
    int spinUs = 0;
    int idleLatencyUs = -1;
    bool isSealed = false;  // with security: frames are sealed

    int slaveIndex = -1;  // of a slave process
    QString master;       // where its master is
    QString keys;         // file with the key of the slaves; empty: no security

    bool isBackToBack() const { return periodUs == 0; }
    bool isInProcess() const { return transport == QLatin1String("inprocess"); }
    bool isSlave() const { return slaveIndex >= 0; }
    /// Command line of slave \a index of a master at \a address.
    /// \param keysFile empty: no security
    QStringList slaveArguments(int index, const QString &address, const QString &keysFile) const;
};

/// Declares the options at \a application and reads them. \return false when the program is to end
/// now, with its exitCode()
bool readBenchOptions(QPlcCoreApplication &application, BenchOptions *options);
