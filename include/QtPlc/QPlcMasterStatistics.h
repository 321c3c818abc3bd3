// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>
#include <QtCore/QString>
#include <QtCore/QVector>

/// What a master knows of one of its nodes. A value type.
struct QPlcNodeInfo
{
    QString name;
    quint16 id = 0;             ///< given at registration
    QString transport;          ///< "udp", "tcp", "inprocess"
    QString address;            ///< "127.0.0.1:40312"; empty for a local node
    QString policy;             ///< name of the RealTimeViolationPolicy
    bool listener = false;
    int inputs = 0;             ///< number of signals
    int outputs = 0;
    quint64 lateAnswers = 0;    ///< cycles that ended without the answer of this node
    quint64 duplicates = 0;     ///< answers that came again
    quint64 rejected = 0;       ///< frames that did not decode
    quint64 resent = 0;         ///< requests that were sent again
};

/// Counters and durations of a master since the start of its last real-time phase. A value type.
struct QPlcMasterStatistics
{
    quint64 cycles = 0;         ///< computed
    quint64 overruns = 0;       ///< times that a cycle began a period or more late
    quint64 skippedCycles = 0;  ///< cycles left out to get back on the grid
    quint64 lateAnswers = 0;    ///< over all nodes
    quint64 strangers = 0;      ///< datagrams from addresses that belong to no node
    qint64 latenessMedian = 0;  ///< wake-up after the nominal time [ns]
    qint64 lateness99 = 0;      ///< 99th percentile [ns]
    qint64 latenessMaximum = 0; ///< [ns]
    qint64 roundTripMedian = 0; ///< first request out to last answer in [ns]
    qint64 roundTrip99 = 0;     ///< [ns]
    qint64 roundTripMaximum = 0;///< [ns]
    quint64 imageDigest = 0;    ///< over the process image of every cycle, in order
};

Q_DECLARE_METATYPE(QPlcNodeInfo)
Q_DECLARE_METATYPE(QPlcMasterStatistics)
