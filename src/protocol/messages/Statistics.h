// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "QPlcCycleStatistics.h"
#include "QPlcMessage.h"

/// What a master has measured since the start of the phase: docs/protocol.md, section 5.6.
namespace qplc::messages {

/// A bin is a pair of numbers on the wire: there are many.
template<>
struct Wire<QPlcDistribution::Bin>
{
    static constexpr const char *name = "array";
    static constexpr bool isNumber = false;
    static QJsonValue toJson(const QPlcDistribution::Bin &bin)
    {
        return QJsonArray{Wire<qint64>::toJson(bin.upperBorder), Wire<quint64>::toJson(bin.count)};
    }
    static bool fromJson(const QJsonValue &json, QPlcDistribution::Bin *bin)
    {
        const QJsonArray pair = json.toArray();
        constexpr double limit = 0x1p63;  // the last bin of a histogram ends with the largest number there is
        const std::optional<double> border = wholeNumber(pair.at(0), -limit, limit);
        if (pair.size() != 2 || !border || !Wire<quint64>::fromJson(pair.at(1), &bin->count))
            return false;
        bin->upperBorder = *border < limit ? qint64(*border) : std::numeric_limits<qint64>::max();
        return true;
    }
};

template<>
struct Description<QPlcDistribution>
{
    using D = QPlcDistribution;
    static constexpr auto fields
        = fieldList(field("count", &D::count), field("minimum", &D::minimum), field("mean", &D::mean),
                    field("p001", &D::p001), field("p01", &D::p01), field("p50", &D::p50), field("p99", &D::p99),
                    field("p999", &D::p999), field("maximum", &D::maximum), field("bins", &D::bins, Presence::WhenSet));
};

template<>
struct Description<QPlcDurationStatistics>
{
    using D = QPlcDurationStatistics;
    static constexpr auto fields = fieldList(field("sinceStart", &D::sinceStart), field("last10s", &D::last10s));
};

template<>
struct Description<QPlcWorstCycle::Stage>
{
    using S = QPlcWorstCycle::Stage;
    static constexpr auto fields = fieldList(field("name", &S::name), field("duration", &S::duration));
};

template<>
struct Description<QPlcWorstCycle>
{
    using W = QPlcWorstCycle;
    static constexpr auto fields
        = fieldList(field("cycle", &W::cycle), field("skipped", &W::skipped), field("lateness", &W::lateness),
                    field("roundTrip", &W::roundTrip), field("execution", &W::execution), field("slack", &W::slack),
                    field("stages", &W::stages));
};

/// The names of the counters of \a Statistics. They go by their names: another version may have
/// more of them.
template<typename Statistics>
struct Counters;

template<>
struct Counters<QPlcNodeStatistics>
{
    using N = QPlcNodeStatistics;
    static constexpr auto fields
        = fieldList(field("answers", &N::answers), field("late", &N::late), field("lost", &N::lost),
                    field("duplicated", &N::duplicated), field("reordered", &N::reordered),
                    field("rejected", &N::rejected), field("forged", &N::forged), field("resent", &N::resent),
                    field("nonFinite", &N::nonFinite), field("outOfRange", &N::outOfRange));
};

template<>
struct Counters<QPlcCycleStatistics>
{
    using C = QPlcCycleStatistics;
    static constexpr auto fields = fieldList(
        field("cycles", &C::cycles), field("overruns", &C::overruns), field("skippedCycles", &C::skippedCycles),
        field("caughtUpCycles", &C::caughtUpCycles), field("shiftedTime", &C::shiftedTime),
        field("lateAnswers", &C::lateAnswers), field("incompleteCycles", &C::incompleteCycles),
        field("strangers", &C::strangers), field("floods", &C::floods));
};

template<typename Statistics>
QMap<QString, double> countersOf(const Statistics &statistics)
{
    QMap<QString, double> counters;
    const auto add
        = [&](const auto &field) { counters.insert(QLatin1String(field.name), double(statistics.*field.member)); };
    Counters<Statistics>::fields.forEach(add);
    return counters;
}

/// Counters that are missing or that do not fit are 0.
template<typename Statistics>
void setCounters(const QMap<QString, double> &counters, Statistics *statistics)
{
    const auto set = [&](const auto &field) {
        using Value = std::decay_t<decltype(statistics->*field.member)>;
        Value value = 0;
        Wire<Value>::fromJson(counters.value(QLatin1String(field.name)), &value);
        statistics->*field.member = value;
    };
    Counters<Statistics>::fields.forEach(set);
}

/// Durations and counters of the master or of a node. Absent durations: that one has none.
struct MasterMeasures
{
    std::optional<QPlcDurationStatistics> lateness;
    std::optional<QPlcDurationStatistics> execution;
    std::optional<QPlcDurationStatistics> roundTrip;
    std::optional<QPlcDurationStatistics> slack;
    QMap<QString, double> counters;

    static constexpr auto fields = fieldList(field("lateness", &MasterMeasures::lateness, Presence::WhenSet),
                                             field("execution", &MasterMeasures::execution, Presence::WhenSet),
                                             field("roundTrip", &MasterMeasures::roundTrip, Presence::WhenSet),
                                             field("slack", &MasterMeasures::slack, Presence::WhenSet),
                                             field("counters", &MasterMeasures::counters));
};

struct NodeMeasures
{
    QString name;
    std::optional<QPlcDurationStatistics> execution;
    std::optional<QPlcDurationStatistics> roundTrip;
    std::optional<QPlcDurationStatistics> slack;
    QMap<QString, double> counters;

    static constexpr auto fields = fieldList(field("name", &NodeMeasures::name, Presence::Required),
                                             field("execution", &NodeMeasures::execution, Presence::WhenSet),
                                             field("roundTrip", &NodeMeasures::roundTrip, Presence::WhenSet),
                                             field("slack", &NodeMeasures::slack, Presence::WhenSet),
                                             field("counters", &NodeMeasures::counters));
};

inline QPlcCycleStatistics statisticsOf(const MasterMeasures &measures)
{
    QPlcCycleStatistics statistics;
    statistics.lateness = measures.lateness.value_or(QPlcDurationStatistics());
    statistics.execution = measures.execution.value_or(QPlcDurationStatistics());
    statistics.roundTrip = measures.roundTrip.value_or(QPlcDurationStatistics());
    statistics.slack = measures.slack.value_or(QPlcDurationStatistics());
    setCounters(measures.counters, &statistics);
    return statistics;
}

inline QPlcNodeStatistics statisticsOf(const NodeMeasures &measures)
{
    QPlcNodeStatistics statistics;
    statistics.name = measures.name;
    statistics.execution = measures.execution.value_or(QPlcDurationStatistics());
    statistics.roundTrip = measures.roundTrip.value_or(QPlcDurationStatistics());
    statistics.slack = measures.slack.value_or(QPlcDurationStatistics());
    setCounters(measures.counters, &statistics);
    return statistics;
}

struct Statistics
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Statistics;
    MasterMeasures master;
    std::vector<NodeMeasures> nodes;
    std::vector<QPlcWorstCycle> worst;

    static constexpr auto fields = fieldList(field("master", &Statistics::master), field("nodes", &Statistics::nodes),
                                             field("worst", &Statistics::worst));
};

struct GetStatistics
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetStatistics;
    using Answer = Statistics;
    bool histograms = false;

    static constexpr auto fields = fieldList(field("histograms", &GetStatistics::histograms, Presence::WhenSet));
};

}  // namespace qplc::messages
