// SPDX-License-Identifier: Apache-2.0
#include "StatisticSignals.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int UpdateInterval = 500;  // [ms]

double durationOf(const QPlcDurationStatistics &duration, QPlcStatisticFigure figure)
{
    const QPlcDistribution &from
        = figure.window() == QPlcStatisticFigure::SinceStart ? duration.sinceStart : duration.last10s;
    switch (figure.statistic()) {
    case QPlcStatisticFigure::Minimum:
        return double(from.minimum);
    case QPlcStatisticFigure::Mean:
        return from.mean;
    case QPlcStatisticFigure::P001:
        return double(from.p001);
    case QPlcStatisticFigure::P01:
        return double(from.p01);
    case QPlcStatisticFigure::P50:
        return double(from.p50);
    case QPlcStatisticFigure::P99:
        return double(from.p99);
    case QPlcStatisticFigure::P999:
        return double(from.p999);
    case QPlcStatisticFigure::Maximum:
        return double(from.maximum);
    }
    return 0.0;
}

/// Durations in s.
double figureOf(const QPlcCycleStatistics &master, QPlcStatisticFigure figure)
{
    switch (figure.quantity()) {
    case QPlcStatisticFigure::Lateness:
        return durationOf(master.lateness, figure) * 1e-9;
    case QPlcStatisticFigure::Execution:
        return durationOf(master.execution, figure) * 1e-9;
    case QPlcStatisticFigure::RoundTrip:
        return durationOf(master.roundTrip, figure) * 1e-9;
    case QPlcStatisticFigure::Slack:
        return durationOf(master.slack, figure) * 1e-9;
    case QPlcStatisticFigure::Cycles:
        return double(master.cycles);
    case QPlcStatisticFigure::Overruns:
        return double(master.overruns);
    case QPlcStatisticFigure::SkippedCycles:
        return double(master.skippedCycles);
    case QPlcStatisticFigure::CaughtUpCycles:
        return double(master.caughtUpCycles);
    case QPlcStatisticFigure::LateAnswers:
        return double(master.lateAnswers);
    case QPlcStatisticFigure::Strangers:
        return double(master.strangers);
    default:
        return 0.0;  // of a node
    }
}

/// Durations in s.
double figureOf(const QPlcNodeStatistics &node, QPlcStatisticFigure figure)
{
    switch (figure.quantity()) {
    case QPlcStatisticFigure::Execution:
        return durationOf(node.execution, figure) * 1e-9;
    case QPlcStatisticFigure::RoundTrip:
        return durationOf(node.roundTrip, figure) * 1e-9;
    case QPlcStatisticFigure::Slack:
        return durationOf(node.slack, figure) * 1e-9;
    case QPlcStatisticFigure::Answers:
        return double(node.answers);
    case QPlcStatisticFigure::Late:
        return double(node.late);
    case QPlcStatisticFigure::Lost:
        return double(node.lost);
    case QPlcStatisticFigure::Duplicated:
        return double(node.duplicated);
    case QPlcStatisticFigure::Reordered:
        return double(node.reordered);
    case QPlcStatisticFigure::Rejected:
        return double(node.rejected);
    case QPlcStatisticFigure::Resent:
        return double(node.resent);
    case QPlcStatisticFigure::Forged:
        return double(node.forged);
    default:
        return 0.0;  // of a master
    }
}

}  // namespace

QPlcValue nearestValue(QPlcSignalType type, double number)
{
    if (type.isReal())
        return QPlcValue(number).convertedTo(type);
    const bool isSigned = type.scalar() >= QPlcSignalType::Int8 && type.scalar() <= QPlcSignalType::Int64;
    const int bits = 8 * type.size() - (isSigned ? 1 : 0);
    const quint64 largest = ~quint64(0) >> (64 - bits);
    const quint64 whole = number >= std::ldexp(1.0, bits) ? largest : quint64(std::max(number, 0.0));
    return QPlcValue(whole).convertedTo(type);
}

StatisticSignals::StatisticSignals()
{
    m_timer.setInterval(UpdateInterval);
    QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { update(); });
}

void StatisticSignals::add(QPlcStatisticFigure figure, QPlcSignalIndex signal, const QString &nodeName)
{
    m_exports.push_back({figure, signal, nodeName});
}

void StatisticSignals::reset(MasterCycle *cycle)
{
    for (const Export &wanted : m_exports)
        cycle->setValues({{wanted.signal, nearestValue(cycle->table().at(wanted.signal).type, 0.0)}});
}

void StatisticSignals::start(MasterCycle *cycle, const NodeRegistry *registry, bool lockstep)
{
    if (lockstep || m_exports.empty())
        return;
    m_cycle = cycle;
    m_registry = registry;
    m_timer.start();
}

void StatisticSignals::stop()
{
    m_timer.stop();
    if (m_cycle)
        update();
    m_cycle = nullptr;
}

void StatisticSignals::update()
{
    const bool ofMaster = std::any_of(m_exports.begin(), m_exports.end(),
                                      [](const Export &wanted) { return wanted.nodeName.isEmpty(); });
    const QPlcCycleStatistics master
        = ofMaster ? m_cycle->cycleStatistics().read(QPlcDistribution::FiguresOnly) : QPlcCycleStatistics();
    for (const Export &wanted : m_exports) {
        const QPlcSignalType type = m_cycle->table().at(wanted.signal).type;
        m_cycle->setValues({{wanted.signal, nearestValue(type, value(wanted, master))}});  // else next time
    }
}

double StatisticSignals::value(const Export &wanted, const QPlcCycleStatistics &master) const
{
    if (wanted.nodeName.isEmpty())
        return figureOf(master, wanted.figure);
    for (const std::shared_ptr<NodeSlot> &slot : m_registry->nodes()) {
        if (slot->name == wanted.nodeName)
            return figureOf(slot->statistics.read(m_cycle->cycleStatistics().newest(), QPlcDistribution::FiguresOnly),
                            wanted.figure);
    }
    return 0.0;
}

}  // namespace qplc
