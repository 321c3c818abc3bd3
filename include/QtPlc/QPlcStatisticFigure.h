// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGlobal.h"

#include <QtCore/QMetaType>

/// Names one figure of the statistics of a master or of one of its nodes, for
/// QPlcMasterNode::activateStatisticSignal().
///
/// \code
/// QPlcMasterNode master;
/// master.activateStatisticSignal({QPlcStatisticFigure::Lateness, QPlcStatisticFigure::P99,
///                                 QPlcStatisticFigure::Last10Seconds},
///                                "masterLateness99");
/// master.activateStatisticSignal(QPlcStatisticFigure::SkippedCycles, "masterSkippedCycles");
/// master.activateStatisticSignal(QPlcStatisticFigure::Late, "winchLateAnswers", "Winch");
/// \endcode
///
/// QPlcCycleStatistics and QPlcNodeStatistics define the quantities.
///
/// \threadsafe a value type: each thread may use its own copy
///
/// \ingroup statistics
class QPlcStatisticFigure
{
public:
    /// What is measured. Durations come first, then counters of a master, then counters of a node.
    enum Quantity : quint8 {
        // durations
        Lateness,   ///< duration, of a master
        Execution,  ///< duration, of a master or node
        RoundTrip,  ///< duration, of a master or node
        Slack,      ///< duration, of a master or node
        // counters
        Cycles,          ///< counter of a master: computed cycles
        Overruns,        ///< counter of a master
        SkippedCycles,   ///< counter of a master
        CaughtUpCycles,  ///< counter of a master
        LateAnswers,     ///< counter of a master: over all nodes
        Strangers,       ///< counter of a master: datagrams from addresses of no node
        Answers,         ///< counter of a node: answers that were taken
        Late,            ///< counter of a node: late answers
        Lost,            ///< counter of a node: requests without an answer
        Duplicated,      ///< counter of a node: answers that came twice
        Reordered,       ///< counter of a node: answers in the wrong order
        Rejected,        ///< counter of a node: malformed frames
        Resent,          ///< counter of a node: requests that were sent again
        Forged           ///< counter of a node: frames with a wrong seal
    };
    /// Which figure of the distribution of a duration (QPlcDistribution).
    enum Statistic : quint8 {
        Minimum,  ///< smallest value
        Mean,     ///< mean value
        P001,     ///< 0.1 % of the values do not exceed it
        P01,      ///< 1 % of the values do not exceed it
        P50,      ///< median
        P99,      ///< 99 % of the values do not exceed it
        P999,     ///< 99.9 % of the values do not exceed it
        Maximum   ///< largest value
    };
    /// Over which time a duration is looked at.
    enum Window : quint8 {
        SinceStart,    ///< since the start of the real-time phase
        Last10Seconds  ///< the last 10 s
    };

    /// Names a figure.
    /// \param quantity  what is measured
    /// \param statistic,  window of a duration; they have no meaning for a counter
    constexpr QPlcStatisticFigure(Quantity quantity = Lateness, Statistic statistic = P99,
                                  Window window = Last10Seconds)
        : m_quantity(quantity)
        , m_statistic(statistic)
        , m_window(window)
    {
    }

    /// Returns which duration or counter of a master or node this figure belongs to.
    constexpr Quantity quantity() const { return m_quantity; }
    /// Returns which figure of a duration it is.
    constexpr Statistic statistic() const { return m_statistic; }
    /// Returns over which time a duration is looked at.
    constexpr Window window() const { return m_window; }
    /// Returns true for a duration, false for a counter.
    constexpr bool isDuration() const { return m_quantity <= Slack; }
    /// Returns true if masters measure it. Some quantities belong to masters and nodes.
    constexpr bool isOfMaster() const { return m_quantity <= Strangers; }
    /// Returns true if a node has this quantity. Execution, RoundTrip and Slack belong to both.
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
