// SPDX-License-Identifier: Apache-2.0
#include "RecordedCycles.h"

#include "McapReader.h"
#include "RecordedRoster.h"
#include "RecordingMessages.h"

#include <QtCore/QMap>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace qplc {

namespace {

using namespace mcap;

/// Puts the messages of a recording together to rows.
class RowReader final : public ScanHandler
{
public:
    explicit RowReader(RecordedCycles::Reader &reader)
        : m_reader(reader)
    {
    }

    /// Channels have numbers of their own in each file, and what nodes exchange is written anew.
    void beginFile()
    {
        m_topics.clear();
        m_exchange.clear();
    }
    void attachment(const Attachment &attachment, const NamedEntry & /*entry*/) override
    {
        if (attachment.name != "recording.txt" || m_message)
            return;
        RingDescription description;
        QVector<QPlcParseError> errors;
        if (!RingDescription::fromText(attachment.data, &description))
            return;
        const QPlcSignalTable table = QPlcSignalTable::fromIni(description.table, &errors);
        if (!errors.isEmpty())
            return;
        m_message = std::make_unique<PlantMessage>(table);
        for (std::unique_ptr<ProcessImage> *image : {&m_image, &m_before, &m_previous})
            *image = std::make_unique<ProcessImage>(table);
        m_goesOn = m_reader.begin(description, table);
    }
    void chunk(const ChunkEntry & /*entry*/, const QByteArray &records) override
    {
        if (!m_message || !m_goesOn)
            return;
        forEachMessage(
            records, [this](const Channel &channel) { m_topics.insert(channel.id, channel.topic); },
            [this](const Message &message, std::uint64_t) {
                if (m_goesOn && !take(message))
                    m_isDamaged = true;
            });
        flush();  // the messages of a cycle are in one chunk
    }
    bool hasTable() const { return m_message != nullptr; }
    bool isDamaged() const { return m_isDamaged; }
    bool goesOn() const { return m_goesOn; }

private:
    /// \return false when the message is not whole
    bool take(const Message &message)
    {
        const QByteArray topic = m_topics.value(message.channel);
        const QByteArray bytes = QByteArray::fromRawData(message.bytes, int(message.size));
        if (topic == "/nodes")
            return readNodes(bytes, &m_exchange);
        if (topic == "/raw_outputs")
            return takeRaw(bytes, &m_row.rawOutputs);
        if (topic == "/raw_inputs")
            return takeRaw(bytes, &m_row.rawInputs);
        flush();
        if (topic == "/plant_before")
            return m_hasBefore = takeImage(message, m_before.get()).has_value();
        if (topic == "/plant")
            return takeCycle(message);
        if (topic == "/rosters")
            return takeRoster(bytes);
        if (topic == "/joins")
            return takeJoin(bytes);
        if (topic == "/gaps")
            return takeGap(bytes);
        if (topic == "/digest" && bytes.contains("\"continues\":true"))
            takeBegin(numberIn(bytes, "next").value_or(0));
        if (topic == "/digest" && bytes.contains("\"end\":true"))
            m_goesOn = m_goesOn && m_reader.ended();
        return true;
    }
    /// A file begins with cycle \a next. What is missing between two files is a gap.
    void takeBegin(std::uint64_t next)
    {
        if (m_hasCycle && next > m_next)
            addGap(m_next, next - 1);
    }
    void addGap(std::uint64_t first, std::uint64_t last)
    {
        m_goesOn = m_goesOn && m_reader.gap(first, last);
        m_next = last + 1;
        m_hasPrevious = false;
    }
    std::optional<PlantMessage::Cycle> takeImage(const Message &message, ProcessImage *image)
    {
        const std::optional<PlantMessage::Cycle> cycle = m_message->decode(message.bytes, message.size);
        if (cycle)
            std::memcpy(image->data(), m_message->image().data(), image->totalSize());
        return cycle;
    }
    bool takeCycle(const Message &message)
    {
        const std::optional<PlantMessage::Cycle> cycle = takeImage(message, m_image.get());
        if (!cycle)
            return false;
        m_row.cycle = *cycle;
        m_row.time = message.time;
        m_hasRow = true;
        return true;
    }
    static bool takeRaw(const QByteArray &bytes, std::vector<RecordedRow::Raw> *raw)
    {
        FieldReader fields(bytes.constData(), std::size_t(bytes.size()));
        RecordedRow::Raw one;
        one.id = fields.number<std::uint16_t>();
        one.bytes = fields.text();
        raw->push_back(one);
        return fields.isWhole();
    }
    bool takeRoster(const QByteArray &bytes)
    {
        m_hasRoster = readRoster(bytes, m_message->table().size(), &m_roster);
        return true;
    }
    bool takeJoin(const QByteArray &bytes)
    {
        FieldReader fields(bytes.constData(), std::size_t(bytes.size()));
        RecordedStart start;
        start.id = fields.number<std::uint16_t>();
        start.first = fields.number<std::uint64_t>();
        start.outputs = fields.text();
        start.inputs = fields.text();
        if (!fields.isWhole())
            return false;
        m_goesOn = m_goesOn && m_reader.joined(start);
        return true;
    }
    bool takeGap(const QByteArray &bytes)
    {
        RecordedGap gap;
        const bool isWhole = readGap(bytes, &gap);
        if (!m_hasCycle || gap.last >= m_next)  // a file before has its cycles
            addGap(m_hasCycle ? std::max(gap.first, m_next) : gap.first, gap.last);
        return isWhole;
    }
    void flush()
    {
        if (!m_hasRow)
            return;
        const std::uint64_t number = m_row.cycle.number;
        if (m_hasCycle && number < m_next)  // a file before has it
            return forget();
        m_hasPrevious = m_hasPrevious && number == m_next + m_row.cycle.skipped;
        m_row.image = m_image.get();
        m_row.before = m_hasBefore ? m_before.get() : nullptr;
        m_row.previous = m_hasPrevious ? m_previous.get() : nullptr;
        m_row.roster = m_hasRoster ? &m_roster : nullptr;
        m_row.nodes = m_exchange;
        for (RecordedNode &node : m_row.nodes)
            node.cycle = ageOf(node.cycle, number);  // the request, of its age
        m_goesOn = m_goesOn && m_reader.cycle(m_row);
        std::swap(m_image, m_previous);
        m_next = number + 1;
        m_hasPrevious = m_hasCycle = true;
        forget();
    }
    void forget()
    {
        m_hasRow = m_hasBefore = false;
        m_row.rawOutputs.clear();
        m_row.rawInputs.clear();
    }

    RecordedCycles::Reader &m_reader;
    QMap<std::uint16_t, QByteArray> m_topics;
    std::unique_ptr<PlantMessage> m_message;
    std::unique_ptr<ProcessImage> m_image;
    std::unique_ptr<ProcessImage> m_before;
    std::unique_ptr<ProcessImage> m_previous;
    RecordedRow m_row;
    std::vector<RecordedNode> m_exchange;  // newest one; `cycle` is an age
    RosterContent m_roster;
    std::uint64_t m_next = 0;  // cycle behind the newest one
    bool m_hasCycle = false;   // any
    bool m_hasRoster = false;
    bool m_hasRow = false;
    bool m_hasBefore = false;
    bool m_hasPrevious = false;
    bool m_goesOn = true;
    bool m_isDamaged = false;
};

}  // namespace

RecordedCycles::Reader::~Reader() = default;

const RecordedNode *RecordedRow::node(std::uint16_t id) const
{
    const auto found
        = std::find_if(nodes.begin(), nodes.end(), [id](const RecordedNode &node) { return node.id == id; });
    return found != nodes.end() ? &*found : nullptr;
}

const QByteArray *RecordedRow::find(const std::vector<Raw> &raw, std::uint16_t id)
{
    const auto found = std::find_if(raw.begin(), raw.end(), [id](const Raw &one) { return one.id == id; });
    return found != raw.end() ? &found->bytes : nullptr;
}

bool RecordedCycles::read(const QStringList &files, Reader &reader, QString *error)
{
    RowReader rows(reader);
    for (const QString &file : files) {
        mcap::Reader source;
        if (!source.open(file, error))
            return false;
        rows.beginFile();
        source.scan(rows);
        if (!rows.hasTable())
            *error = QStringLiteral("the file '%1' is no recording of a plant, or one of another version of QtPLC")
                         .arg(file);
        else if (rows.isDamaged() || source.damages() > 0)
            *error = QStringLiteral("the recording '%1' is damaged; 'qtplc verify' says what is missing").arg(file);
        else if (rows.goesOn())
            continue;
        else
            return true;
        return false;
    }
    return true;
}

}  // namespace qplc
