// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

#include <chrono>

/// What a master knows about one of its nodes.
///
/// \code
/// QPlcMasterNode master;
/// for (const QPlcNodeInfo &node : master.nodes())
///     qInfo("%s: %llu late answers", qPrintable(node.name), node.lateAnswers);
/// \endcode
///
/// All counters begin at 0 with each real-time phase.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup master
struct QPlcNodeInfo
{
    QString name;    ///< name under which the node has registered
    quint16 id = 0;  ///< number that the master has given at registration
    /// Way of the cyclic frames: "udp", "tcp", "local", "udp-multicast", "inprocess".
    QString transport;
    QString address;        ///< "127.0.0.1:40312"; empty for a node in the process of the master
    QString policy;         ///< name of the QPlcSlaveNode::RealTimeViolationPolicy
    bool listener = false;  ///< the master never waits for it
    bool critical = false;  ///< the master stops safely without it
    /// Name of a QPlcSlaveNode::State, as far as the master knows it: "Registered", "Initializing",
    /// "Ready", "RealTime", "SafeStop" or "Fault".
    QString state;
    int every = 1;            ///< cycles from one frame to the next; more than 1 for some listeners
    int inputs = 0;           ///< number of signals that the node reads
    int outputs = 0;          ///< number of signals that the node writes
    quint64 lateAnswers = 0;  ///< cycles that ended without the answer of this node
    quint64 duplicates = 0;   ///< answers that came twice, or after the answer to a newer request
    quint64 rejected = 0;     ///< frames that were malformed
    /// Sealed frames with a wrong seal: not from the node, or changed on the way.
    quint64 forged = 0;
    quint64 resent = 0;  ///< requests that were sent again
    /// Faults that the node injects into its frames, for a test; empty: none.
    QString faultPlan;
    /// Watchdog that the node has set itself and that leads to its safe state; 0: none of its own.
    std::chrono::nanoseconds watchdog{0};
    QString identity;  ///< identity that the node has proven; empty: none
    /// True if the node uses this transport because datagrams do not get through to it, or not
    /// from it (QPlcUnderlyingProtocol::Automatic).
    bool fallback = false;
};

Q_DECLARE_METATYPE(QPlcNodeInfo)
