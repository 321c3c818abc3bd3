// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRealTimeSetting.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>

/// What a cycle thread shall ask of the operating system. Everything that is not set is inherited, so that `chrt -f 49 program` works.
/// A value type.
struct QTPLC_EXPORT QPlcRealTimeOptions
{
    enum Policy : quint8 {
        Inherit,    ///< policy and priority of the thread that starts the cycle (chrt)
        Other,      ///< SCHED_OTHER: ordinary scheduling
        Fifo,       ///< SCHED_FIFO
        RoundRobin  ///< SCHED_RR
    };

    Policy policy = Inherit;
    int priority = 0;                  ///< 1 ... 99 for Fifo and RoundRobin
    std::optional<int> cpu;            ///< the only processor that the thread may use
    bool lockMemory = false;           ///< mlockall(MCL_CURRENT | MCL_FUTURE), and a reserve in the heap
    int prefaultStack = 64 * 1024;     ///< [byte] of the stack touched before the first cycle
    std::optional<qint64> timerSlack;  ///< [ns] for ordinary scheduling; real-time threads have none

    /// [byte] that the heap has in reserve where memory is locked, 0 ... 1 GiB: they are taken, touched and given back once in a process, before its first cycle, so that what
    /// the program allocates later, beside its cycles, meets no new page. From then on the heap gives nothing back to the system, and large blocks come from it, too (mallopt).
    /// It serves the thread that starts the cycle. 0: the heap is left as it is. Known to the C library of GNU only.
    int heapReserve = 8 * 1024 * 1024;

    /// [us] that processors may need to wake up, >= 0, while cycles run: they do not sleep deeper; 0: they do not sleep at all, which costs power and is the quickest.
    std::optional<int> idleLatency;

    qint64 spin
        = 0;  ///< [ns] to look for frames again and again before the thread sleeps, 0 ... 10 ms: quicker, for a processor of its own

    /// Why the options cannot be meant ("priority 120: use 1 ... 99"); empty when they can.
    QString errorString() const;
};
