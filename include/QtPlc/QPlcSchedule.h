// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// The order in which a master asks its nodes within a cycle, and how old the values are that they read. A value type.
///
/// All nodes of a stage compute at once; a stage begins when those have answered whose outputs later stages read. Without same-cycle inputs and two-phase
/// nodes there is one stage. See QPlcMasterNode::schedule().
struct QPlcSchedule
{
    /// What a node does in a stage.
    enum Phase : quint8 {
        Step,     ///< computes its outputs out of its inputs
        Outputs,  ///< two-phase: its outputs are there, without being asked for: they were computed in the cycle before
        Update  ///< two-phase: moves its state on with the inputs of this cycle, and computes the outputs of the next one
    };
    struct Turn
    {
        QString node;
        Phase phase = Step;
    };
    struct Link
    {
        QString signal;
        QString from;            ///< node that writes the signal; "Master": the master itself; empty: nobody
        QString to;              ///< node that reads it
        int age = 0;             ///< of the value that is read [cycles]; 0: of the cycle at hand
        bool sameCycle = false;  ///< as the reader wants it
    };

    QVector<QVector<Turn>> stages;  ///< in the order of a cycle; nodes of a stage in the order of their registration
    QVector<Link> links;            ///< for each input of each node

    /// "outputs", "update", "step".
    QTPLC_EXPORT static QString phaseName(Phase phase);
};

Q_DECLARE_METATYPE(QPlcSchedule)
