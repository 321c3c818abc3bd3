// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// The order in which a master asks its nodes within a cycle, and the age of the values that they
/// read.
///
/// \code
/// QPlcMasterNode master;
/// const QPlcSchedule schedule = master.schedule();
/// for (const QPlcSchedule::Link &link : schedule.links)
///     qInfo("%s reads a value of %d cycles ago", qPrintable(link.to), link.age);
/// \endcode
///
/// All nodes of a stage compute at the same time. A stage begins when all nodes have answered whose
/// outputs later stages read. There is a single stage unless a node has same-cycle inputs or two
/// phases. QPlcMasterNode::schedule() returns it.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup master
struct QPlcSchedule
{
    /// What a node does in a stage.
    enum Phase : quint8 {
        Step,     ///< it computes its outputs from its inputs
        Outputs,  ///< two-phase node: its outputs exist already, since the end of the cycle before
        /// Two-phase node: it moves its state on with the inputs of this cycle, and computes new
        /// outputs.
        Update
    };
    /// A node and what it does in a stage.
    struct Turn
    {
        QString node;        ///< name of the node
        Phase phase = Step;  ///< what it does
    };
    /// A signal and one of its readers.
    struct Link
    {
        QString signal;          ///< name of the signal
        QString from;            ///< node that writes it; "Master": the master; empty: no node
        QString to;              ///< node that reads it
        int age = 0;             ///< age of the value that is read [cycles]; 0: of the same cycle
        bool sameCycle = false;  ///< the reader has declared it as a same-cycle input
    };

    /// Stages in the order of a cycle. The nodes of a stage stand in the order of their
    /// registration.
    QVector<QVector<Turn>> stages;
    QVector<Link> links;  ///< one for each input of each node

    /// Returns "outputs", "update" or "step".
    QTPLC_EXPORT static QString phaseName(Phase phase);
};

Q_DECLARE_METATYPE(QPlcSchedule)
