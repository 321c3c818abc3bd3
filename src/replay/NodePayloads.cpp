// SPDX-License-Identifier: Apache-2.0
#include "NodePayloads.h"

#include <QtCore/QSet>

#include <cstring>

namespace qplc {

bool NodePayloads::isPossible(const RosterNode &node)
{
    const auto areDifferent = [](const QVector<QPlcSignalIndex> &indices) {
        return QSet<QPlcSignalIndex>(indices.begin(), indices.end()).size() == indices.size();
    };
    return areDifferent(node.inputs) && areDifferent(node.outputs);
}

NodePayloads::NodePayloads(const ProcessImage &image, const RosterNode &node,
                           const QVector<QPlcSignalIndex> &ownSignals)
    : m_name(node.name)
    , m_id(node.id)
    , m_inputs(image.table(), node.inputs,
               node.hasInputQualities ? PayloadLayout::WithQualities : PayloadLayout::WithoutQualities)
    , m_outputs(image.table(), node.outputs)
    , m_all(image.gatherRuns(m_inputs))
    , m_written(image.gatherRuns(m_outputs))
{
    std::vector<bool> own;
    for (const QPlcSignalIndex signal : node.inputs)
        own.push_back(ownSignals.contains(signal));
    m_own = image.gatherRuns(m_inputs, own);
    m_sameCycle = image.gatherRuns(m_inputs, std::vector<bool>(node.sameCycle.begin(), node.sameCycle.end()));
}

std::uint16_t NodePayloads::idIn(const RecordedRow &row) const
{
    for (const RosterNode &node : row.roster ? row.roster->nodes : QVector<RosterNode>()) {
        if (node.goesOn && node.name == m_name)
            return node.id;
    }
    return m_id;
}

bool NodePayloads::inputs(const RecordedRow &row, QByteArray *payload) const
{
    if (const QByteArray *raw = RecordedRow::find(row.rawInputs, idIn(row))) {
        *payload = *raw;
        return std::uint32_t(raw->size()) == m_inputs.size();
    }
    const ProcessImage *base = row.before ? row.before : row.previous;
    if (!base)
        return false;
    payload->resize(int(m_inputs.size()));
    copyRuns(m_all, base->data(), payload->data());
    if (!row.before)
        copyRuns(m_own, row.image->data(), payload->data());
    copyRuns(m_sameCycle, row.image->data(), payload->data());
    return true;
}

bool NodePayloads::outputs(const RecordedRow &row, QByteArray *values) const
{
    const std::uint16_t id = idIn(row);
    const RecordedNode *node = row.node(id);
    if (!node || !(node->flags & RecordedNode::Stored) || (node->flags & RecordedNode::Hidden))
        return false;
    const QByteArray *raw = RecordedRow::find(row.rawOutputs, id);
    if ((node->flags & RecordedNode::HasRaw) != 0 && (!raw || std::uint32_t(raw->size()) < m_outputs.size()))
        return false;
    values->resize(int(m_outputs.size()));
    if (raw)
        std::memcpy(values->data(), raw->constData(), m_outputs.size());
    else
        copyRuns(m_written, row.image->data(), values->data());
    return true;
}

}  // namespace qplc
