// SPDX-License-Identifier: Apache-2.0
#include "RecordedRoster.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>

namespace qplc {

namespace {

bool areIn(const QVector<QPlcSignalIndex> &indices, int count)
{
    return std::all_of(indices.begin(), indices.end(), [count](QPlcSignalIndex index) { return int(index) < count; });
}

bool readNode(const QJsonObject &object, int signalCount, RosterNode *node)
{
    const auto list
        = [&](const char *name) { return signalsIn(object.value(QLatin1String(name)).toString().toLatin1()); };
    const auto isSet = [&](const char *name) { return object.value(QLatin1String(name)).toBool(); };
    node->name = object.value(QStringLiteral("name")).toString();
    node->id = quint16(object.value(QStringLiteral("id")).toInt());
    node->stage = object.value(QStringLiteral("stage")).toInt();
    node->inputs = list("inputs");
    node->outputs = list("outputs");
    node->interval = quint64(std::max(1.0, object.value(QStringLiteral("every")).toDouble()));
    node->hasInputQualities = isSet("inputQualities");
    node->hasOutputQualities = isSet("outputQualities");
    node->isTwoPhase = isSet("twoPhase");
    node->isListener = isSet("listener");
    node->isLocal = isSet("local");
    node->hasDevices = isSet("devices");
    node->goesOn = isSet("goesOn");
    node->sameCycle.fill(false, node->inputs.size());
    for (const QPlcSignalIndex field : list("sameCycle")) {
        if (int(field) < node->sameCycle.size())
            node->sameCycle[field] = true;
    }
    return node->id != 0 && areIn(node->inputs, signalCount) && areIn(node->outputs, signalCount);
}

}  // namespace

bool readRoster(const QByteArray &message, int signalCount, RosterContent *content)
{
    const QJsonValue roster = QJsonDocument::fromJson(message).object().value(QStringLiteral("roster"));
    *content = {};
    const QJsonArray nodes = roster.toObject().value(QStringLiteral("nodes")).toArray();
    for (const QJsonValue &value : nodes) {
        RosterNode node;
        if (!readNode(value.toObject(), signalCount, &node))
            return false;
        content->nodes.append(node);
    }
    content->held = signalsIn(roster.toObject().value(QStringLiteral("held")).toString().toLatin1());
    return roster.isObject() && areIn(content->held, signalCount);
}

}  // namespace qplc
