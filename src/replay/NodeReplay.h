// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeHistory.h"

#include <QtCore/QStringList>

#include <optional>

class QPlcSlaveNode;

namespace qplc {

/// What a replay is of.
struct ReplayRequest
{
    QString file;     // recording, or folder: findPhase()
    QString program;  // that is the node, with its arguments; empty: `node`
    QPlcSlaveNode *node = nullptr;
    QString name;        // of the node in the recording; empty: that under which it registers
    double from = 0.0;   // [s] since cycle 0: from here on outputs are compared
    double speed = 0.0;  // simulated seconds in a second; 0: as fast as the node answers
};

/// How a replay has ended.
struct ReplayResult
{
    enum Kind : quint8 {
        Done,     ///< all that the recording has was replayed
        Refused,  ///< it cannot be replayed
        Failed    ///< the program has failed, or did not answer
    };
    struct Difference
    {
        QString signal;
        quint64 cycle = 0;  // whose inputs the node had; ~0: its initial outputs
        double time = 0.0;  // [s] since cycle 0
        QString recorded;
        QString computed;
    };
    static constexpr quint64 Initial = ~quint64(0);

    Kind kind = Done;
    QString error;            // unless it is Done
    QString node;             // name in the recording
    quint64 cycles = 0;       // that the node has computed
    quint64 compared = 0;     // of these, outputs were compared
    quint64 unknown = 0;      // of these, the recording does not show the outputs
    quint64 differences = 0;  // values of signals
    std::optional<Difference> first;
    QStringList notes;       // for people
    double simulated = 0.0;  // [s]
    double elapsed = 0.0;    // [s]

    double speed() const { return elapsed > 0.0 ? simulated / elapsed : 0.0; }
};

/// Lets a node compute what it has computed in a recording, from the same inputs, and compares its
/// outputs with those of the recording, bit by bit. Each registration of the node in the recording
/// is a program started anew.
///
/// Needs an event loop; returns when all is done.
ReplayResult replayNode(const ReplayRequest &request);

}  // namespace qplc
