// SPDX-License-Identifier: Apache-2.0
#include "OutputComparison.h"

#include "protocol/LittleEndian.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace qplc {

namespace {

/// Bytes of a value that count: of a text, not those behind its end.
std::size_t lengthOf(const PayloadLayout::Field &field, const char *value)
{
    constexpr std::size_t lengthSize = 2;
    if (!field.type.isString())
        return std::size_t(field.type.size());
    return lengthSize + std::min<std::size_t>(loadLittle<std::uint16_t>(value), std::size_t(field.type.capacity()));
}

}  // namespace

OutputComparison::OutputComparison(const QPlcSignalTable &table, const NodePayloads &payloads,
                                   const NodePassage &passage, std::int64_t period, double from, ReplayResult *result)
    : m_table(table)
    , m_payloads(payloads)
    , m_isTwoPhase(passage.node.isTwoPhase)
    , m_period(double(period) * 1e-9)
    , m_from(from)
    , m_result(*result)
{
    for (const PayloadLayout::Field &field : payloads.outputLayout().fields()) {
        if (!table.at(field.signal).isVolatile)
            m_fields.push_back(field);
    }
}

void OutputComparison::compareInitial(const QByteArray &recorded, const char *computed)
{
    if (m_from <= 0.0 && std::uint32_t(recorded.size()) >= m_payloads.outputLayout().size())
        compareValues(ReplayResult::Initial, recorded.constData(), computed);
}

void OutputComparison::add(std::uint64_t cycle, const char *outputs)
{
    m_answers.push_back({cycle, QByteArray(outputs, int(m_payloads.outputLayout().size()))});
    if (m_answers.size() > MostAnswers)
        m_answers.pop_front();
}

/// The outputs of a two-phase node for a cycle are its answer to the cycle before.
void OutputComparison::compare(const RecordedRow &row)
{
    const std::optional<std::uint64_t> lastRow = std::exchange(m_lastRow, row.cycle.number);
    const RecordedNode *node = row.node(m_payloads.idIn(row));
    if (!node || !(node->flags & RecordedNode::Stored) || (m_isTwoPhase && !lastRow))
        return;
    const std::uint64_t cycle = m_isTwoPhase ? *lastRow : node->cycle;
    while (!m_answers.empty() && m_answers.front().cycle < cycle) {
        ++m_result.unknown;
        m_answers.pop_front();
    }
    if (m_answers.empty() || m_answers.front().cycle != cycle)
        return;
    if (!m_payloads.outputs(row, &m_recorded)) {
        ++m_result.unknown;
    } else if (double(cycle) * m_period >= m_from) {
        ++m_result.compared;
        compareValues(cycle, m_recorded.constData(), m_answers.front().values.constData());
    }
    m_answers.pop_front();
}

void OutputComparison::compareValues(std::uint64_t cycle, const char *recorded, const char *computed)
{
    for (const PayloadLayout::Field &field : m_fields) {
        const std::size_t length = lengthOf(field, recorded + field.offset);
        if (std::memcmp(recorded + field.offset, computed + field.offset, length) != 0)
            note(field, cycle, recorded + field.offset, computed + field.offset);
    }
}

void OutputComparison::note(const PayloadLayout::Field &field, std::uint64_t cycle, const char *recorded,
                            const char *computed)
{
    ++m_result.differences;
    if (m_result.first)
        return;
    const auto text = [&](const char *value) { return QPlcValue::fromBytes(field.type, value).toString(); };
    m_result.first = ReplayResult::Difference{m_table.at(field.signal).name, cycle,
                                              cycle == ReplayResult::Initial ? 0.0 : double(cycle) * m_period,
                                              text(recorded), text(computed)};
}

}  // namespace qplc
