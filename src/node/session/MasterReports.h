// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterFaults.h"
#include "node/statistics/RefusedValues.h"

#include <QtCore/QSocketNotifier>
#include <QtCore/QStringList>

namespace qplc {

/// Takes what the cycles of a master report: tells the journal, and the master what it has to do.
class MasterReports : public QObject
{
    Q_OBJECT
public:
    MasterReports(MasterControl &master, MasterCycle &cycle, const NodeRegistry &registry, const NodeSessions &nodes,
                  RealTimePhase &phase, MasterFaults &faults, const PhaseSettings &settings, Journal &journal);

    /// All that is there.
    void take();
    /// The last reports of a phase.
    void takeLast();
    /// Whether take() would find something.
    bool hasNews() const { return !m_cycle.reports().isEmpty(); }
    /// Whether the wait at hand is worth an event: not when all late nodes have a silent policy.
    bool isWaitTold() const { return m_isWaitTold; }

Q_SIGNALS:
    void realTimeViolated(const QString &node, quint64 cycle);

private:
    void report(const CycleEvent &event);
    void tellJournal(const CycleEvent &event);
    void codeFailed(const CycleEvent &event);

    MasterControl &m_master;
    MasterCycle &m_cycle;
    const NodeRegistry &m_registry;
    const NodeSessions &m_nodes;
    RealTimePhase &m_phase;
    MasterFaults &m_faults;
    const PhaseSettings &m_settings;
    Journal &m_journal;
    RefusedValues m_refusedValues;
    QSocketNotifier m_notifier;
    QStringList m_becameSafe;  // signals of the reports at hand
    bool m_isWaitTold = true;
};

}  // namespace qplc
