// SPDX-License-Identifier: Apache-2.0
#include "NodeHistory.h"

#include <QtCore/QMap>
#include <QtCore/QStringList>

#include <algorithm>
#include <map>

namespace qplc {

namespace {

class HistoryReader final : public RecordedCycles::Reader
{
public:
    HistoryReader(const QString &name, std::vector<NodePassage> *passages)
        : m_name(name)
        , m_passages(*passages)
    {
    }
    bool begin(const RingDescription &, const QPlcSignalTable &) override { return true; }
    bool joined(const RecordedStart &start) override
    {
        m_starts[start.id] = start;
        return true;
    }
    bool cycle(const RecordedRow &row) override
    {
        m_hasRoster = m_hasRoster || row.roster;
        if (!row.roster)
            return true;
        for (const RosterNode &node : row.roster->nodes) {
            m_names.insert(node.name, true);
            if (node.name == m_name)
                take(row, node);
        }
        return true;
    }
    bool gap(std::uint64_t first, std::uint64_t last) override
    {
        if (!m_passages.empty())
            close(first,
                  QStringLiteral("the cycles from %1 to %2 are not in the recording, and the state of the node is not "
                                 "known then")
                      .arg(first)
                      .arg(last));
        return true;
    }
    bool hasRoster() const { return m_hasRoster; }
    QStringList names() const { return m_names.keys(); }

private:
    void take(const RecordedRow &row, const RosterNode &node)
    {
        const std::uint64_t number = row.cycle.number;
        if (m_passages.empty() || m_id != node.id)
            begin(number, node);
        NodePassage &passage = m_passages.back();
        passage.node.stage = node.stage;
        if (row.cycle.flags & RecordedCycle::Safe)
            close(number, QStringLiteral("the master stops safely in cycle %1").arg(number));
        const RecordedNode *exchange = row.node(node.id);
        if (!exchange)
            return;
        const bool hasComputed = exchange->cycle != RecordedNode::NoCycle;
        if (!hasComputed && (exchange->flags & RecordedNode::Asked))
            m_asked.push_back(number);
        if (!hasComputed || exchange->cycle == m_newest)
            return;
        m_newest = exchange->cycle;
        for (std::uint64_t i = std::min<std::uint64_t>(32, m_newest); i > 0; --i) {
            if (exchange->history >> (i - 1) & 1)
                note(&passage, m_newest - i);
        }
        note(&passage, m_newest);
    }
    /// A node that has lost nothing but its connection is the same program.
    void begin(std::uint64_t number, const RosterNode &node)
    {
        m_id = node.id;
        m_newest = RecordedNode::NoCycle;
        m_asked.clear();
        if (!node.goesOn || m_passages.empty())
            open(number, node);
    }
    void open(std::uint64_t number, const RosterNode &node)
    {
        NodePassage passage;
        passage.node = node;
        passage.first = number;
        const auto start = m_starts.find(node.id);
        if (start != m_starts.end()) {
            passage.start = start->second;
            passage.first = start->second.first;
        }
        m_passages.push_back(passage);
        m_hasFirst = false;
    }
    void note(NodePassage *passage, std::uint64_t cycle)
    {
        if (cycle < passage->first)
            return;
        const auto place = std::size_t(cycle - passage->first);
        if (place >= passage->computed.size())
            passage->computed.resize(place + 1);
        // A node of the process of the master has counted from cycle 0.
        if (!m_hasFirst && passage->node.isLocal)
            passage->lostAtFirst = cycle > 0 ? cycle - 1 : 0;
        else if (!m_hasFirst)
            passage->lostAtFirst = std::uint64_t(
                std::count_if(m_asked.begin(), m_asked.end(), [cycle](std::uint64_t asked) { return asked < cycle; }));
        m_hasFirst = true;
        passage->computed[place] = true;
    }
    void close(std::uint64_t end, const QString &reason)
    {
        if (m_passages.back().end)
            return;
        m_passages.back().end = end;
        m_passages.back().endReason = reason;
    }

    const QString m_name;
    std::vector<NodePassage> &m_passages;
    std::map<std::uint16_t, RecordedStart> m_starts;
    std::uint16_t m_id = 0;  // of the newest connection
    QMap<QString, bool> m_names;
    std::uint64_t m_newest = RecordedNode::NoCycle;
    std::vector<std::uint64_t> m_asked;  // cycles, until there is an answer
    bool m_hasFirst = false;             // of the passage at hand, a cycle that it has computed
    bool m_hasRoster = false;
};

}  // namespace

std::uint64_t NodePassage::count() const
{
    const std::size_t until
        = end ? std::min<std::size_t>(computed.size(), std::size_t(*end - std::min(*end, first))) : computed.size();
    return std::uint64_t(std::count(computed.begin(), computed.begin() + std::ptrdiff_t(until), true));
}

bool readPassages(const RecordedPhase &phase, const QString &name, std::vector<NodePassage> *passages, QString *error)
{
    passages->clear();
    HistoryReader reader(name, passages);
    if (!RecordedCycles::read(phase.files, reader, error))
        return false;
    if (!passages->empty())
        return true;
    *error = reader.hasRoster()
        ? QStringLiteral("the recording '%1' has no node '%2', but %3; choose one with --name")
              .arg(phase.name(), name, reader.names().join(QStringLiteral(", ")))
        : QStringLiteral("the recording '%1' does not say which nodes were there; it is of an older version")
              .arg(phase.name());
    return false;
}

}  // namespace qplc
