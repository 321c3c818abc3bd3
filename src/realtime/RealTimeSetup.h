// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRealTimeOptions.h"

namespace qplc {

/// Policy and priority of a thread as the kernel knows them.
struct Scheduling
{
    int policy = 0;  ///< SCHED_OTHER, SCHED_FIFO, ...
    int priority = 0;

    /// That of the calling thread. Asked of the kernel: pthread_getschedparam() may answer from an
    /// old copy of its own.
    static Scheduling current();

    bool isRealTime() const;
    /// "SCHED_FIFO 49"
    QString toString() const;

    friend bool operator==(Scheduling a, Scheduling b) { return a.policy == b.policy && a.priority == b.priority; }
};

/// What \a options wish of the heap of the calling thread, which is the one that works beside the
/// cycle and allocates. Once in a process has an effect; before memory is locked, so that the
/// reserve is locked with the rest.
/// \return empty when nothing is wished
/// \pre options.errorString() is empty
QVector<QPlcRealTimeSetting> applyHeapOptions(const QPlcRealTimeOptions &options);

/// Applies \a options to the calling thread and reads back what was obtained.
/// \param inherited  what Inherit means: the scheduling of the thread that started this one
/// \pre options.errorString() is empty
QVector<QPlcRealTimeSetting> applyRealTimeOptions(const QPlcRealTimeOptions &options, Scheduling inherited);

}  // namespace qplc
