// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// What a recording says of a node in some cycles of a phase.
struct RosterNode
{
    QString name;
    quint16 id = 0;
    QVector<QPlcSignalIndex> inputs;   // in the order of its payload
    QVector<QPlcSignalIndex> outputs;  // in the order of its payload
    QVector<bool> sameCycle;           // for each input
    bool hasInputQualities = false;    // they follow the values in its payload
    bool hasOutputQualities = false;
    bool isTwoPhase = false;  // the answer to cycle k has the outputs of cycle k + 1
    bool isListener = false;
    bool isLocal = false;  // in the process of the master
    bool hasDevices = false;
    bool goesOn = false;   // it was in the phase before, lost its connection, and has kept its state
    quint64 interval = 1;  // [cycles] between two requests
    int stage = 0;         // in which it is asked, from 0
};

/// The nodes of some cycles of a phase, as a ring and a recording tell them.
struct RosterContent
{
    QVector<RosterNode> nodes;
    QVector<QPlcSignalIndex> held;  // signals that somebody has taken over

    const RosterNode *find(quint16 id) const;
    /// One line of JSON; recording/RecordedRoster.h reads it.
    QByteArray toText() const;
};

/// "3-7,1": indices in their order; what follows one another is a range.
QByteArray rangesText(const QVector<QPlcSignalIndex> &indices);
/// What rangesText() has written; empty: it is no such text.
QVector<QPlcSignalIndex> signalsIn(const QByteArray &ranges);

}  // namespace qplc
