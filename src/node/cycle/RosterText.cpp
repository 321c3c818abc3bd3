// SPDX-License-Identifier: Apache-2.0
#include "RosterText.h"

#include <QtCore/QByteArrayList>

#include <algorithm>
#include <utility>

namespace qplc {

namespace {

/// As in JSON: no name has characters that control a terminal.
QByteArray jsonText(const QString &text)
{
    QByteArray bytes = text.toUtf8();
    bytes.replace('\\', "\\\\").replace('"', "\\\"");
    return '"' + bytes + '"';
}

QByteArray nodeText(const RosterNode &node)
{
    QVector<QPlcSignalIndex> sameCycle;  // numbers of fields
    for (int i = 0; i < node.sameCycle.size(); ++i) {
        if (node.sameCycle[i])
            sameCycle.append(QPlcSignalIndex(i));
    }
    QByteArray text = "{\"name\":" + jsonText(node.name) + ",\"id\":" + QByteArray::number(node.id)
        + ",\"stage\":" + QByteArray::number(node.stage) + ",\"inputs\":\"" + rangesText(node.inputs)
        + "\",\"outputs\":\"" + rangesText(node.outputs) + '"';
    if (!sameCycle.isEmpty())
        text += ",\"sameCycle\":\"" + rangesText(sameCycle) + '"';
    if (node.interval > 1)
        text += ",\"every\":" + QByteArray::number(node.interval);
    const std::pair<const char *, bool> flags[] = {{"inputQualities", node.hasInputQualities},
                                                   {"outputQualities", node.hasOutputQualities},
                                                   {"twoPhase", node.isTwoPhase},
                                                   {"listener", node.isListener},
                                                   {"local", node.isLocal},
                                                   {"devices", node.hasDevices},
                                                   {"goesOn", node.goesOn}};
    for (const auto &[name, isSet] : flags) {
        if (isSet)
            text.append(",\"").append(name).append("\":true");
    }
    return text + '}';
}

}  // namespace

const RosterNode *RosterContent::find(quint16 id) const
{
    const auto found = std::find_if(nodes.begin(), nodes.end(), [id](const RosterNode &node) { return node.id == id; });
    return found != nodes.end() ? &*found : nullptr;
}

QByteArray RosterContent::toText() const
{
    QByteArrayList texts;
    for (const RosterNode &node : nodes)
        texts << nodeText(node);
    return "{\"nodes\":[" + texts.join(',') + "],\"held\":\"" + rangesText(held) + "\"}";
}

QByteArray rangesText(const QVector<QPlcSignalIndex> &indices)
{
    QByteArray text;
    for (int i = 0; i < indices.size();) {
        int end = i + 1;
        while (end < indices.size() && indices[end] == indices[end - 1] + 1)
            ++end;
        if (!text.isEmpty())
            text += ',';
        text += QByteArray::number(indices[i]);
        if (end - i > 1)
            text += '-' + QByteArray::number(indices[end - 1]);
        i = end;
    }
    return text;
}

QVector<QPlcSignalIndex> signalsIn(const QByteArray &ranges)
{
    constexpr int most = 65535;  // indices: a table has no more signals
    QVector<QPlcSignalIndex> indices;
    const QList<QByteArray> parts = ranges.isEmpty() ? QList<QByteArray>() : ranges.split(',');
    for (const QByteArray &part : parts) {
        const int dash = part.indexOf('-');
        bool isNumber = false;
        bool isEnd = true;
        const uint first = (dash < 0 ? part : part.left(dash)).toUShort(&isNumber);
        const uint last = dash < 0 ? first : part.mid(dash + 1).toUShort(&isEnd);
        if (!isNumber || !isEnd || last < first || indices.size() + int(last - first) >= most)
            return {};
        for (uint index = first; index <= last; ++index)
            indices.append(QPlcSignalIndex(index));
    }
    return indices;
}

}  // namespace qplc
