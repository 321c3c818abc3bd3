// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// Names one figure of the statistics of a master or of one of its nodes. A value type.
///
/// ```cpp
/// master.activateStatisticSignal({QPlcStatisticFigure::Lateness, QPlcStatisticFigure::P99, QPlcStatisticFigure::Last10Seconds}, "masterLateness99");
/// master.activateStatisticSignal(QPlcStatisticFigure::SkippedCycles, "masterSkippedCycles");
/// master.activateStatisticSignal(QPlcStatisticFigure::Late, "winchLateAnswers", "Winch");
/// ```
///
/// QPlcCycleStatistics and QPlcNodeStatistics define the quantities.
class QPlcStatisticFigure
{
public:
    enum Quantity : quint8 {
        // durations
        Lateness,   ///< of a master
        Execution,  ///< of master or node
        RoundTrip,  ///< of master or node
        Slack,      ///< of master or node
        // counters
        Cycles,          ///< of a master
        Overruns,        ///< of a master
        SkippedCycles,   ///< of a master
        CaughtUpCycles,  ///< of a master
        LateAnswers,     ///< of a master: over all nodes
        Strangers,       ///< of a master
        Answers,         ///< of a node
        Late,            ///< of a node
        Lost,            ///< of a node
        Duplicated,      ///< of a node
        Reordered,       ///< of a node
        Rejected,        ///< of a node
        Resent,          ///< of a node
        Forged           ///< of a node
    };
    /// Of a duration.
    enum Statistic : quint8 { Minimum, Mean, P001, P01, P50, P99, P999, Maximum };
    /// Of a duration.
    enum Window : quint8 { SinceStart, Last10Seconds };

    /// \param statistic, window  have no meaning for a counter
    constexpr QPlcStatisticFigure(Quantity quantity = Lateness, Statistic statistic = P99,
                                  Window window = Last10Seconds)
        : m_quantity(quantity)
        , m_statistic(statistic)
        , m_window(window)
    {
    }

    constexpr Quantity quantity() const { return m_quantity; }
    constexpr Statistic statistic() const { return m_statistic; }
    constexpr Window window() const { return m_window; }
    constexpr bool isDuration() const { return m_quantity <= Slack; }
    constexpr bool isOfMaster() const { return m_quantity <= Strangers; }
    constexpr bool isOfNode() const
    {
        return m_quantity >= Answers || m_quantity == Execution || m_quantity == RoundTrip || m_quantity == Slack;
    }

private:
    Quantity m_quantity;
    Statistic m_statistic;
    Window m_window;
};

Q_DECLARE_METATYPE(QPlcStatisticFigure)
