// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDurationStatistics.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What a master has measured of one of its nodes since the start of the real-time phase. All durations in ns. A value type.
///
/// In lockstep no clock is read: durations have no values there.
struct QPlcNodeStatistics
{
    QString name;

    /// From the inputs at hand to the outputs ready: step() or realTimeout(). A node over the network says it with each answer (at most 4.29 s fit there).
    /// Answers that were taken count, late ones too.
    QPlcDurationStatistics execution;
    /// From the begin of the sending of the requests of a cycle to the moment at which the master has the whole answer of this node. A late answer counts with its
    /// full time; one that is 32 cycles late or more gives no value, and neither does a node in the process of the master.
    QPlcDurationStatistics roundTrip;
    /// From the moment at which the master has the whole answer to the nominal time of the next cycle: what the node could have taken longer. A late answer counts
    /// as 0. For a node in the process of the master from the end of its step.
    QPlcDurationStatistics slack;

    quint64 answers = 0;     ///< taken; for a node in the process of the master its steps
    quint64 late = 0;        ///< cycles that were over without the answer
    quint64 lost = 0;        ///< requests to which no answer had come when the answer to a newer one came
    quint64 duplicated = 0;  ///< answers that came again
    quint64 reordered
        = 0;  ///< answers that came after the answer to a newer request; not taken, and their requests are among the lost
    quint64 rejected = 0;  ///< frames that did not decode
    quint64 forged
        = 0;  ///< sealed frames that were not as the node seals them: made or changed by a stranger, or corrupted
    quint64 resent = 0;     ///< requests that were sent again
    quint64 nonFinite = 0;  ///< values of its signals that were not taken, because they were NaN or infinite
    quint64 outOfRange
        = 0;  ///< values of its signals that were not taken, because they were outside of the limits of the table
};

Q_DECLARE_METATYPE(QPlcNodeStatistics)
