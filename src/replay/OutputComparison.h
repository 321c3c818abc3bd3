// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodePayloads.h"
#include "NodeReplay.h"

#include <deque>

namespace qplc {

/// Compares what a node computes with what a recording says. Answers that were late in the flight
/// stand in the recording later than the cycle that they belong to.
class OutputComparison
{
public:
    /// \param period  [ns]
    OutputComparison(const QPlcSignalTable &table, const NodePayloads &payloads, const NodePassage &passage,
                     std::int64_t period, double from, ReplayResult *result);

    /// The initial outputs of the node.
    void compareInitial(const QByteArray &recorded, const char *computed);
    /// The node has computed \a cycle.
    void add(std::uint64_t cycle, const char *outputs);
    /// Compares what the recording shows in the cycle of \a row.
    void compare(const RecordedRow &row);

private:
    struct Answer
    {
        std::uint64_t cycle;
        QByteArray values;
    };
    static constexpr std::size_t MostAnswers = 10'000;  // that wait for the recording

    void compareValues(std::uint64_t cycle, const char *recorded, const char *computed);
    void note(const PayloadLayout::Field &field, std::uint64_t cycle, const char *recorded, const char *computed);

    const QPlcSignalTable &m_table;
    const NodePayloads &m_payloads;
    const bool m_isTwoPhase;
    const double m_period;  // [s]
    const double m_from;
    ReplayResult &m_result;
    std::vector<PayloadLayout::Field> m_fields;  // that are compared
    std::deque<Answer> m_answers;
    std::optional<std::uint64_t> m_lastRow;
    QByteArray m_recorded;
};

}  // namespace qplc
