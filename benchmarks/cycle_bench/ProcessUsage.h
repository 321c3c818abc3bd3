// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QVector>

#include <sys/types.h>

/// What a process has used so far, all threads together.
struct ProcessUsage
{
    double cpuUs = 0.0;
    double contextSwitches = 0.0;
    double residentKb = 0.0;
    int threads = 0;

    static ProcessUsage of(pid_t process);
    static ProcessUsage sumOf(const QVector<qint64> &processes);
};

/// Bytes and packets that the loopback interface of this network namespace has seen.
struct LoopbackUsage
{
    double bytes = 0.0;
    double packets = 0.0;

    static LoopbackUsage now();
};
