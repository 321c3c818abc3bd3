// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>

namespace qplc {

/// What /proc and /sys say of a computer, as far as it matters to real time. Empty, or none: they
/// do not say.
struct SystemFacts
{
    /// A sleep of a processor that has nothing to do.
    struct IdleState
    {
        QString name;
        int exitLatency;  // [us]
        bool isEnabled;
    };

    QString kernel;                    // "6.1.0-18-rt-amd64"
    QString preemption;                // "PREEMPT_RT", "PREEMPT_DYNAMIC", "PREEMPT", "no PREEMPT"
    QString processors;                // online: "0-3"
    std::optional<QString> isolated;   // from the scheduler: "2,3"; empty text: no processor
    QStringList governors;             // of all processors, each once
    QString clockSource;               // "tsc"
    QStringList clockSources;          // that could be chosen
    std::optional<int> swapSpace;      // [KiB]; 0: none in use
    std::optional<int> realTimeShare;  // [per cent] of a processor that threads with real-time policies may take
    QVector<IdleState> idleStates;     // of the first processor
    QString priorityLimit;             // soft limit as `ulimit -r` shows it: "0", "99", "unlimited"
    QString memoryLimit;               // that of locked memory: "8388608" [byte], "unlimited"
    QString model;                     // of the computer or its processor: "Raspberry Pi 4 Model B"
    QString memory;                    // "3884028 kB"
    bool isVirtual = false;            // it says that it is a virtual machine
    QString load;                      // mean of the last minute: "0.12"
    QStringList kernelParameters;      // all of the command line

    /// \param root  folder that has proc and sys
    static SystemFacts read(const QString &root = QStringLiteral("/"));
};

}  // namespace qplc
