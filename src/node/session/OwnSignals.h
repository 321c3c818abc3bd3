// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterWrites.h"
#include "node/statistics/StatisticSignals.h"

#include <array>

namespace qplc {

/// The signals that a master writes itself: no node may write them, and nobody may set them.
class OwnSignals
{
public:
    enum Role : quint8 { Time, Jitter, Workload };

    OwnSignals(NodeRegistry &registry, const QPlcSignalTable &table, const Leases &leases, MasterWrites &settings);

    /// Claims a signal in the place of the one that has \a role now. \return why it cannot; empty:
    /// done
    QString claim(Role role, const QString &name);
    /// QPlcInvalidSignalIndex: there is none.
    QPlcSignalIndex index(Role role) const { return m_signals[role]; }

    /// What is wrong with \a figure of the node \a nodeName (empty: of the master); empty: nothing.
    static QString faultOf(QPlcStatisticFigure figure, const QString &signalName, const QString &nodeName);
    /// Claims a signal for a figure of the statistics. \return why it cannot; empty: done
    QString add(QPlcStatisticFigure figure, const QString &signalName, const QString &nodeName);
    StatisticSignals &statistics() { return m_statistics; }

private:
    QString claim(const QString &name, QPlcSignalIndex *place, bool (*accepts)(QPlcSignalType),
                  const QString &wantedType);

    NodeRegistry &m_registry;
    const QPlcSignalTable &m_table;
    const Leases &m_leases;
    MasterWrites &m_settings;
    std::array<QPlcSignalIndex, 3> m_signals{QPlcInvalidSignalIndex, QPlcInvalidSignalIndex, QPlcInvalidSignalIndex};
    StatisticSignals m_statistics;
};

}  // namespace qplc
