// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSchedule.h"

#include <QtCore/QDateTime>
#include <QtCore/QJsonObject>
#include <QtCore/QString>
#include <QtCore/QVector>

namespace qplc {

/// Percentiles of a duration [ns]; no count: never measured.
struct DurationFigures
{
    double count = 0.0;
    double p50 = 0.0;
    double p99 = 0.0;
    double maximum = 0.0;
};

/// A duration as docs/protocol.md 5.6 tells it.
struct DurationStatus
{
    DurationFigures sinceStart;
    DurationFigures last10s;
};

/// One node of a plant, as its master sees it.
struct NodeStatus
{
    QString name;
    QString transport;
    QString address;
    QString policy;
    QString state;
    QString faultPlan;  // that it injects on purpose; empty: none
    bool isListener = false;
    bool isCritical = false;
    int inputs = 0;
    int outputs = 0;
    DurationStatus execution;
    DurationStatus roundTrip;
    quint64 late = 0;  // answers, since the start of the phase, as all counters
    quint64 lost = 0;
    quint64 duplicated = 0;
    quint64 rejected = 0;
    quint64 forged = 0;
    bool isLate = false;  // there were late answers since the statistics before

    /// As of the master: whether it is SafeStop or Fault.
    bool isLatched() const;
};

/// Who stopped the phase that ran last, on request.
struct PlantStop
{
    QString whoever;      // "anna@lab"
    QString how;          // "Esc Esc"; empty: not told
    QDateTime time;       // invalid: no person or program stopped it
    bool isMine = false;  // this window did
};

/// A master and its nodes, put together of its answers State, Statistics and Schedule. A value type.
struct PlantStatus
{
    QString state;    // as the master names it; empty: not known
    QString reason;   // why it is SafeStop or Fault
    QString remains;  // what still keeps it from being reset; empty: nothing
    bool isArmed = false;
    bool isArmingRequired = false;
    quint64 cycle = 0;
    qint64 period = 0;  // [ns]
    QString clock;
    double scale = 1.0;
    QString profile;        // "Simulation", "Plant"
    QString profileReason;  // for people
    quint64 session = 0;
    PlantStop stop;          // until the next start
    QString faultPlan;       // that the master injects on purpose; empty: none
    bool isCounted = false;  // the master has told its counters: what they show more from now on is new
    quint64 overruns = 0;
    bool isOverrunning = false;  // there were overruns since the statistics before
    DurationStatus lateness;
    DurationStatus execution;
    DurationStatus roundTrip;
    DurationStatus slack;
    QVector<NodeStatus> nodes;
    QStringList
        gone;  // nodes of the phase that runs or ran last which have left and are not back; listeners come and go as they like
    QPlcSchedule schedule;

    /// Whether cycles run, or stand still for a moment; safe ones, too.
    bool isRunning() const;
    /// Whether it is SafeStop or Fault: nothing moves until it is reset.
    bool isLatched() const;
    const NodeStatus *node(const QString &name) const;

    /// Takes an answer State. Figures of nodes that were there before stay.
    void takeState(const QJsonObject &fields);
    void takeStatistics(const QJsonObject &fields);
    void takeSchedule(const QJsonObject &fields);

private:
    void missNodes(const QVector<NodeStatus> &before);
};

}  // namespace qplc
