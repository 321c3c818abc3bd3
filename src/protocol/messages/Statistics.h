// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Field.h"
#include "QPlcDistribution.h"
#include "QPlcDurationStatistics.h"
#include "QPlcMessage.h"
#include "QPlcWorstCycle.h"

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
        return pair.size() == 2 && Wire<qint64>::fromJson(pair.at(0), &bin->upperBorder)
            && Wire<quint64>::fromJson(pair.at(1), &bin->count);
    }
};

template<>
struct Description<QPlcDistribution>
{
    using D = QPlcDistribution;
    static constexpr auto fields = std::make_tuple(
        field("count", &D::count), field("minimum", &D::minimum), field("mean", &D::mean), field("p001", &D::p001),
        field("p01", &D::p01), field("p50", &D::p50), field("p99", &D::p99), field("p999", &D::p999),
        field("maximum", &D::maximum), field("bins", &D::bins, Presence::WhenSet));
};

template<>
struct Description<QPlcDurationStatistics>
{
    using D = QPlcDurationStatistics;
    static constexpr auto fields = std::make_tuple(field("sinceStart", &D::sinceStart), field("last10s", &D::last10s));
};

template<>
struct Description<QPlcWorstCycle::Stage>
{
    using S = QPlcWorstCycle::Stage;
    static constexpr auto fields = std::make_tuple(field("name", &S::name), field("duration", &S::duration));
};

template<>
struct Description<QPlcWorstCycle>
{
    using W = QPlcWorstCycle;
    static constexpr auto fields
        = std::make_tuple(field("cycle", &W::cycle), field("skipped", &W::skipped), field("lateness", &W::lateness),
                          field("roundTrip", &W::roundTrip), field("execution", &W::execution),
                          field("slack", &W::slack), field("stages", &W::stages));
};

/// Durations and counters of the master or of a node; counters that a version does not know are kept.
struct MasterMeasures
{
    QPlcDurationStatistics lateness;
    QPlcDurationStatistics execution;
    QPlcDurationStatistics roundTrip;
    QPlcDurationStatistics slack;
    QMap<QString, double> counters;

    static constexpr auto fields
        = std::make_tuple(field("lateness", &MasterMeasures::lateness), field("execution", &MasterMeasures::execution),
                          field("roundTrip", &MasterMeasures::roundTrip), field("slack", &MasterMeasures::slack),
                          field("counters", &MasterMeasures::counters));
};

struct NodeMeasures
{
    QString name;
    QPlcDurationStatistics execution;
    QPlcDurationStatistics roundTrip;
    QPlcDurationStatistics slack;
    QMap<QString, double> counters;

    static constexpr auto fields
        = std::make_tuple(field("name", &NodeMeasures::name, Presence::Required),
                          field("execution", &NodeMeasures::execution), field("roundTrip", &NodeMeasures::roundTrip),
                          field("slack", &NodeMeasures::slack), field("counters", &NodeMeasures::counters));
};

struct Statistics
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::Statistics;
    MasterMeasures master;
    std::vector<NodeMeasures> nodes;
    std::vector<QPlcWorstCycle> worst;

    static constexpr auto fields = std::make_tuple(
        field("master", &Statistics::master), field("nodes", &Statistics::nodes), field("worst", &Statistics::worst));
};

struct GetStatistics
{
    static constexpr QPlcMessage::Kind kind = QPlcMessage::GetStatistics;
    using Answer = Statistics;
    bool histograms = false;

    static constexpr auto fields = std::make_tuple(field("histograms", &GetStatistics::histograms, Presence::WhenSet));
};

}  // namespace qplc::messages
