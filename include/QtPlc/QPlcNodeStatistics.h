// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDurationStatistics.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What a master has measured of one of its nodes since the start of the real-time phase. All
/// durations are in ns.
///
/// \code
/// QPlcMasterNode master;
/// for (const QPlcNodeStatistics &node : master.cycleStatistics().nodes)
///     qInfo("%s: %llu of %llu answers were late", qPrintable(node.name), node.late, node.answers);
/// \endcode
///
/// In lockstep no clock is read, and durations have no values.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
struct QPlcNodeStatistics
{
    QString name;  ///< name of the node

    /// From the inputs at hand to the outputs ready: the time of step() or realTimeout(). A node
    /// over the network sends it with each answer; more than 4.29 s do not fit there. All answers
    /// that were taken count, also late ones.
    QPlcDurationStatistics execution;
    /// From the begin of sending the requests of a cycle to the moment at which the master has the
    /// whole answer of this node. A late answer counts with its full time. An answer that is 32 or
    /// more cycles late gives no value, and neither does a node in the process of the master.
    QPlcDurationStatistics roundTrip;
    /// From the moment at which the master has the whole answer to the nominal time of the next
    /// cycle: how much longer the node could have taken. A late answer counts as 0. For a node in
    /// the process of the master it begins at the end of its step.
    QPlcDurationStatistics slack;

    /// Answers that were taken; of a node in the process of the master its steps.
    quint64 answers = 0;
    quint64 late = 0;        ///< cycles that were over before the answer came
    quint64 lost = 0;        ///< requests without an answer when the answer to a newer one came
    quint64 duplicated = 0;  ///< answers that came twice
    /// Answers that came after the answer to a newer request. They are not taken, and their
    /// requests are among the lost ones.
    quint64 reordered = 0;
    quint64 rejected = 0;  ///< frames that were malformed
    /// Sealed frames with a wrong seal: not from the node, changed on the way, or corrupted.
    quint64 forged = 0;
    quint64 resent = 0;  ///< requests that were sent again
    /// Values of its signals that were not taken because they were NaN or infinite.
    quint64 nonFinite = 0;
    /// Values of its signals that were not taken because they were outside of the limits of the
    /// signal table.
    quint64 outOfRange = 0;
};

Q_DECLARE_METATYPE(QPlcNodeStatistics)
