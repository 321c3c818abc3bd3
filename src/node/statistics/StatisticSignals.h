// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcStatisticFigure.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/NodeRegistry.h"

#include <QtCore/QTimer>

#include <vector>

namespace qplc {

/// Writes figures of the statistics into signals. Thread of the master: percentiles cost too much
/// for the cycle thread, which only gets the values.
class StatisticSignals
{
public:
    StatisticSignals();

    /// \param nodeName  empty: a figure of the master
    void add(QPlcStatisticFigure figure, QPlcSignalIndex signal, const QString &nodeName);

    /// Sets all of them to 0. \pre no cycle runs
    void reset(MasterCycle *cycle);
    /// Updates them twice a second from now on, but for lockstep, where nothing may depend on the
    /// machine. Both outlive the phase.
    void start(MasterCycle *cycle, const NodeRegistry *registry, bool lockstep);
    /// Updates them for the last time. \pre no cycle runs any more
    void stop();

private:
    struct Export
    {
        QPlcStatisticFigure figure;
        QPlcSignalIndex signal;
        QString nodeName;
    };

    void update();
    double value(const Export &wanted, const QPlcCycleStatistics &master) const;

    std::vector<Export> m_exports;
    QTimer m_timer;
    MasterCycle *m_cycle = nullptr;
    const NodeRegistry *m_registry = nullptr;
};

/// \a number as a value of \a type, Real or integer; the nearest one that an integer type holds.
QPlcValue nearestValue(QPlcSignalType type, double number);

}  // namespace qplc
