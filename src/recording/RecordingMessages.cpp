// SPDX-License-Identifier: Apache-2.0
#include "RecordingMessages.h"

#include "protocol/LittleEndian.h"

namespace qplc {

namespace {

constexpr int NodeSize = 32;  // [byte] of qtplc/Node

}  // namespace

QByteArray nodesSchema()
{
    return "# What the master has exchanged with each node in a cycle. A cycle without such a message has\n"
           "# that of the cycle before.\n"
           "qtplc/Node[] nodes\n"
           "================================================================================\n"
           "MSG: qtplc/Node\n"
           "uint16 id\n"
           "uint16 flags    # 1 asked, 2 answered, 4 stored, 8 late, 16 faulted, 32 safe, 64 lost, 128 raw, 256 "
           "local,\n"
           "                # 512 listens, 1024 raw inputs, 2048 two-phase and not shown\n"
           "uint32 history  # which requests before that one it has computed: bit i is that of i + 1 cycles before\n"
           "uint64 age      # [cycles] of the newest request that it has answered; 2^64 - 1: none yet\n"
           "int64 arrival   # of that answer, on the clock of the master [ns]; 0: not timed\n"
           "uint64 info     # of that answer: what the node says of its own time [ns]\n";
}

std::uint64_t ageOf(std::uint64_t cycle, std::uint64_t number)
{
    return cycle == RecordedNode::NoCycle ? cycle : number - cycle;
}

QByteArray nodesMessage(const CycleView &view)
{
    QByteArray message(4 + NodeSize * int(view.cycle.nodes), Qt::Uninitialized);
    char *to = message.data();
    storeLittle(view.cycle.nodes, to);
    to += 4;
    for (std::uint32_t i = 0; i < view.cycle.nodes; ++i, to += NodeSize) {
        const RecordedNode node = view.node(i);
        storeLittle(node.id, to);
        storeLittle(node.flags, to + 2);
        storeLittle(node.history, to + 4);
        storeLittle(ageOf(node.cycle, view.cycle.number), to + 8);
        storeLittle(node.arrival, to + 16);
        storeLittle(std::uint64_t(node.info), to + 24);
    }
    return message;
}

bool readNodes(const QByteArray &message, std::vector<RecordedNode> *nodes)
{
    const std::uint32_t count = message.size() >= 4 ? loadLittle<std::uint32_t>(message.constData()) : 0;
    if (message.size() < 4 || std::uint64_t(message.size()) != 4 + std::uint64_t(count) * NodeSize)
        return false;
    nodes->resize(count);
    const char *from = message.constData() + 4;
    for (RecordedNode &node : *nodes) {
        node = {};
        node.id = loadLittle<std::uint16_t>(from);
        node.flags = loadLittle<std::uint16_t>(from + 2);
        node.history = loadLittle<std::uint32_t>(from + 4);
        node.cycle = loadLittle<std::uint64_t>(from + 8);
        node.arrival = loadLittle<std::int64_t>(from + 16);
        node.info = std::uint32_t(loadLittle<std::uint64_t>(from + 24));
        from += NodeSize;
    }
    return true;
}

QByteArray gapMessage(const RecordedGap &gap)
{
    return "{\"first\":" + QByteArray::number(qulonglong(gap.first)) + ",\"last\":"
        + QByteArray::number(qulonglong(gap.last)) + ",\"cycles\":" + QByteArray::number(qulonglong(gap.cycles))
        + ",\"skipped\":" + QByteArray::number(qulonglong(gap.skipped)) + ",\"digest\":\"" + digestText(gap.digest)
        + "\"}";
}

bool readGap(const QByteArray &message, RecordedGap *gap)
{
    const std::optional<std::uint64_t> last = numberIn(message, "last");
    gap->first = numberIn(message, "first").value_or(0);
    gap->last = last.value_or(0);
    gap->cycles = numberIn(message, "cycles").value_or(0);
    gap->skipped = numberIn(message, "skipped").value_or(0);
    gap->digest = numberIn(message, "digest", 16).value_or(0);
    return last.has_value();
}

QByteArray digestText(std::uint64_t digest)
{
    return QByteArray::number(qulonglong(digest), 16).rightJustified(16, '0');
}

std::optional<std::uint64_t> numberIn(const QByteArray &message, const QByteArray &key, int base)
{
    const int at = message.indexOf('"' + key + "\":");
    if (at < 0)
        return std::nullopt;
    int begin = at + key.size() + 3;
    if (begin < message.size() && message.at(begin) == '"')
        ++begin;
    int end = begin;
    while (end < message.size() && QByteArray("0123456789abcdef").contains(message.at(end)))
        ++end;
    bool isNumber = false;
    const std::uint64_t number = message.mid(begin, end - begin).toULongLong(&isNumber, base);
    return isNumber ? std::make_optional(number) : std::nullopt;
}

}  // namespace qplc
