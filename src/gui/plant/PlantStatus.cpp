// SPDX-License-Identifier: Apache-2.0
#include "PlantStatus.h"

#include "QPlcMasterSocket.h"
#include "node/Logging.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace qplc {

namespace {

QString text(const QJsonObject &fields, const char *name)
{
    return printable(fields.value(QLatin1String(name)).toString());
}

double number(const QJsonObject &fields, const char *name)
{
    return fields.value(QLatin1String(name)).toDouble();
}

quint64 counter(const QJsonObject &fields, const char *name)
{
    constexpr double largest = 9007199254740992.0;  // that a JSON number holds exactly
    return quint64(std::clamp(number(fields, name), 0.0, largest));
}

QJsonObject object(const QJsonObject &fields, const char *name)
{
    return fields.value(QLatin1String(name)).toObject();
}

DurationFigures figures(const QJsonObject &fields)
{
    return {number(fields, "count"), number(fields, "p50"), number(fields, "p99"), number(fields, "maximum")};
}

DurationStatus duration(const QJsonObject &fields, const char *name)
{
    const QJsonObject of = object(fields, name);
    return {figures(object(of, "sinceStart")), figures(object(of, "last10s"))};
}

PlantStop stopOf(const QJsonObject &fields)
{
    PlantStop stop;
    if (fields.isEmpty())
        return stop;
    const QPlcMessage message(QPlcMessage::State, fields);
    stop.whoever = text(fields, "whoever");
    stop.how = text(fields, "how");
    stop.time = QDateTime::fromMSecsSinceEpoch(qint64(message.hex64(QStringLiteral("time")) / 1'000'000));
    stop.isMine = fields.value(QLatin1String("yours")).toBool();
    return stop;
}

bool isLatchedState(const QString &state)
{
    return state == QLatin1String("SafeStop") || state == QLatin1String("Fault");
}

}  // namespace

bool PlantStatus::isRunning() const
{
    return state == QLatin1String("RealTime") || state == QLatin1String("WaitingForLateSlaves")
        || state == QLatin1String("SafeStop");
}

bool PlantStatus::isLatched() const
{
    return isLatchedState(state);
}

bool NodeStatus::isLatched() const
{
    return isLatchedState(state);
}

const NodeStatus *PlantStatus::node(const QString &name) const
{
    const auto found
        = std::find_if(nodes.begin(), nodes.end(), [&](const NodeStatus &node) { return node.name == name; });
    return found == nodes.end() ? nullptr : &*found;
}

void PlantStatus::takeState(const QJsonObject &fields)
{
    const QPlcMessage message(QPlcMessage::State, fields);
    const bool wasRunning = isRunning();
    state = text(fields, "state");
    reason = text(fields, "reason");
    remains = text(fields, "remains");
    isArmed = fields.value(QLatin1String("armed")).toBool();
    isArmingRequired = fields.value(QLatin1String("armingRequired")).toBool();
    cycle = message.hex64(QStringLiteral("cycle"));
    period = qint64(number(fields, "period"));
    clock = text(fields, "clock");
    scale = number(fields, "scale");
    profile = text(fields, "profile");
    profileReason = text(fields, "profileReason");
    session = message.hex64(QStringLiteral("session"));
    stop = stopOf(object(fields, "stopped"));
    faultPlan = text(fields, "faults");
    QVector<NodeStatus> now;
    const QJsonArray rows = fields.value(QLatin1String("nodes")).toArray();
    for (const QJsonValue &row : rows) {
        const QJsonObject of = row.toObject();
        const NodeStatus *before = node(text(of, "name"));
        NodeStatus status = before ? *before : NodeStatus();
        status.name = text(of, "name");
        status.transport = text(of, "transport");
        status.address = text(of, "address");
        status.policy = text(of, "policy");
        status.state = text(of, "state");
        status.isCritical = of.value(QLatin1String("critical")).toBool();
        status.faultPlan = text(of, "faults");
        status.isListener = of.value(QLatin1String("listener")).toBool();
        status.inputs = int(number(of, "inputs"));
        status.outputs = int(number(of, "outputs"));
        now.append(status);
    }
    nodes.swap(now);
    if (isRunning() && !wasRunning)
        gone.clear();  // a phase that begins has all of its nodes
    missNodes(now);
}

void PlantStatus::missNodes(const QVector<NodeStatus> &before)
{
    for (const NodeStatus &other : before) {
        if (!other.isListener && !gone.contains(other.name))
            gone.append(other.name);
    }
    gone.erase(std::remove_if(gone.begin(), gone.end(), [this](const QString &name) { return node(name) != nullptr; }),
               gone.end());
}

void PlantStatus::takeStatistics(const QJsonObject &fields)
{
    const QJsonObject master = object(fields, "master");
    lateness = duration(master, "lateness");
    execution = duration(master, "execution");
    roundTrip = duration(master, "roundTrip");
    slack = duration(master, "slack");
    const quint64 overrunsNow = counter(object(master, "counters"), "overruns");
    isOverrunning = isCounted && overrunsNow > overruns;
    overruns = overrunsNow;
    const QJsonArray rows = fields.value(QLatin1String("nodes")).toArray();
    for (const QJsonValue &row : rows) {
        const QJsonObject of = row.toObject();
        const QString name = text(of, "name");
        const auto known
            = std::find_if(nodes.begin(), nodes.end(), [&](const NodeStatus &node) { return node.name == name; });
        if (known == nodes.end())
            continue;  // the next State tells of it
        const QJsonObject counters = object(of, "counters");
        const quint64 late = counter(counters, "late");
        known->isLate = isCounted && late > known->late;
        known->late = late;
        known->lost = counter(counters, "lost");
        known->duplicated = counter(counters, "duplicated");
        known->rejected = counter(counters, "rejected");
        known->forged = counter(counters, "forged");
        known->execution = duration(of, "execution");
        known->roundTrip = duration(of, "roundTrip");
    }
    isCounted = true;
}

void PlantStatus::takeSchedule(const QJsonObject &fields)
{
    schedule = {};
    const QJsonArray stages = fields.value(QLatin1String("stages")).toArray();
    for (const QJsonValue &stage : stages) {
        QVector<QPlcSchedule::Turn> turns;
        const QJsonArray rows = stage.toArray();
        for (const QJsonValue &row : rows) {
            const QString phase = text(row.toObject(), "phase");
            turns.append({text(row.toObject(), "node"),
                          phase == QLatin1String("outputs")      ? QPlcSchedule::Outputs
                              : phase == QLatin1String("update") ? QPlcSchedule::Update
                                                                 : QPlcSchedule::Step});
        }
        schedule.stages.append(turns);
    }
    const QJsonArray links = fields.value(QLatin1String("links")).toArray();
    for (const QJsonValue &link : links) {
        const QJsonObject of = link.toObject();
        schedule.links.append({text(of, "signal"), text(of, "from"), text(of, "to"), int(number(of, "age")),
                               of.value(QLatin1String("sameCycle")).toBool()});
    }
}

}  // namespace qplc
