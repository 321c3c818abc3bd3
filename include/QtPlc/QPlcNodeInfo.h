// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>

/// What a master knows of one of its nodes. A value type.
struct QPlcNodeInfo
{
    QString name;
    quint16 id = 0;     ///< given at registration
    QString transport;  ///< "udp", "tcp", "inprocess"
    QString address;    ///< "127.0.0.1:40312"; empty for a local node
    QString policy;     ///< name of the RealTimeViolationPolicy
    bool listener = false;
    bool critical = false;
    QString
        state;  ///< name of a QPlcSlaveNode::State, as far as the master knows: "Registered", "Initializing", "Ready", "RealTime", "SafeStop", "Fault"
    int every = 1;   ///< cycles for each frame that a listener gets
    int inputs = 0;  ///< number of signals
    int outputs = 0;
    quint64 lateAnswers = 0;  ///< cycles that ended without the answer of this node
    quint64 duplicates = 0;   ///< answers that came again
    quint64 rejected = 0;     ///< frames that did not decode
    quint64 forged = 0;       ///< sealed frames that were not as the node seals them
    quint64 resent = 0;       ///< requests that were sent again
    QString faultPlan;        ///< faults that the node injects into its own frames, for a test; empty: none
};

Q_DECLARE_METATYPE(QPlcNodeInfo)
