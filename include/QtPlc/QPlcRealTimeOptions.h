// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRealTimeSetting.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

#include <optional>

/// What a cycle thread asks of the operating system.
///
/// \code
/// QPlcRealTimeOptions options;
/// options.policy = QPlcRealTimeOptions::Fifo;
/// options.priority = 49;
/// options.cpu = 3;
/// options.lockMemory = true;
/// QPlcMasterNode master;
/// master.setRealTimeOptions(options);
/// \endcode
///
/// The thread inherits everything that is not set, so `chrt -f 49 program` works, too. A wish that
/// the system does not grant stops nothing: QPlcMasterNode::realTimeSettings() and the log show it,
/// with the remedy.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup time
struct QTPLC_EXPORT QPlcRealTimeOptions
{
    /// Scheduling policy of the cycle thread.
    enum Policy : quint8 {
        Inherit,    ///< policy and priority of the thread that starts the cycle (chrt)
        Other,      ///< SCHED_OTHER: ordinary scheduling
        Fifo,       ///< SCHED_FIFO
        RoundRobin  ///< SCHED_RR
    };

    Policy policy = Inherit;  ///< scheduling policy
    int priority = 0;         ///< 1 to 99 for Fifo and RoundRobin, else 0
    /// The only processor that the thread may use, 0 to 1023; not set: any.
    std::optional<int> cpu;
    /// Keeps all memory of the process in RAM: mlockall(MCL_CURRENT \| MCL_FUTURE).
    bool lockMemory = false;
    /// Bytes of the stack that are touched before the first cycle, 0 to 64 MiB.
    int prefaultStack = 64 * 1024;
    /// Timer slack for ordinary scheduling [ns], 1 to 1 000 000 000. Real-time threads have none.
    std::optional<qint64> timerSlack;

    /// Reserve of the heap where memory is locked [byte], 0 to 1 GiB. It is taken, touched and
    /// given back once in a process, before its first cycle. What the program allocates later,
    /// outside of its cycles, then meets no new page. From then on the heap returns nothing to the
    /// system, and large blocks come from it, too (mallopt). It serves the thread that starts the
    /// cycle. 0: the heap stays as it is. Only the C library of GNU supports this.
    int heapReserve = 8 * 1024 * 1024;

    /// Maximum wake-up latency of the processors while cycles run [us], 0 to 1 000 000. 0: they do
    /// not sleep at all, which costs power and is fastest. Not set: the system decides.
    std::optional<int> idleLatency;

    /// Time for which the thread polls for frames before it sleeps [ns], 0 to 10 ms. Faster, for a
    /// processor that the thread has to itself.
    qint64 spin = 0;

    /// Returns what is out of range ("priority 120: use 1 ... 99"); empty if all options are valid.
    QString errorString() const;
};
