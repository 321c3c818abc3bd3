// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SystemFacts.h"
#include "WakeUpProbe.h"

namespace qplc {

/// One thing that was examined.
struct Finding
{
    enum Verdict { Ok, ToCure, Unknown };

    QString subject;  ///< "kernel"
    Verdict verdict = Unknown;
    QString found;   ///< what there is, with numbers and units
    QString remedy;  ///< command that cures it; empty unless ToCure
};

// Judgements on whether a computer is fit for cycles of a kilohertz: the facts that can be read,
// and the effects that were tried and measured.

/// Kernel, processors, clock source, governor, idle states.
QVector<Finding> judgeFacts(const SystemFacts &facts);
/// Ordinary and real-time scheduling by the wake-ups of their threads, locked memory, and swap,
/// which matters where memory cannot be locked.
/// \param ordinary of a thread under SCHED_OTHER \param realTime of one that asked for SCHED_FIFO
///         and locked memory
QVector<Finding> judgeEffects(const SystemFacts &facts, const WakeUps &ordinary, const WakeUps &realTime);
/// \param roundTrips  of datagrams over loopback [ns]; empty: none came back
Finding judgeLoopback(const Histogram &roundTrips);
/// QtPLC, Qt (at run time and when built), kernel, C library.
Finding judgeVersions(const SystemFacts &facts);

}  // namespace qplc
