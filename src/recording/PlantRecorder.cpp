// SPDX-License-Identifier: Apache-2.0
#include "PlantRecorder.h"

#include "RecordingMessages.h"

#include <QtCore/QDateTime>
#include <QtCore/QFile>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>
#include <cstring>

namespace qplc {

namespace {

constexpr std::size_t FullChunk = 256 * 1024;  // [byte] of messages
constexpr std::uint64_t AllTexts = ~std::uint64_t(0);
constexpr std::size_t MostAdoptions = 10'000;  // that texts may come after
constexpr int MostLooksForText = 20;           // at the end of a phase: a second, as a recorder looks

const char rawSchema[] = "# The outputs of a node as it has answered them, where the signals do not show all of them.\n"
                         "uint16 id\n"
                         "uint8[] outputs\n";

const char rawInputsSchema[] = "# The inputs that a node was sent, where the signals do not show all of them.\n"
                               "uint16 id\n"
                               "uint8[] inputs\n";

const char joinSchema[] = "# A node takes part from this cycle on. Before, it has sent its initial outputs, and was\n"
                          "# given its initial inputs.\n"
                          "uint16 id\n"
                          "uint64 first\n"
                          "uint8[] outputs\n"
                          "uint8[] inputs\n";

template<typename Record>
Record recordIn(const RingReader &reader, bool *isWhole)
{
    Record record;
    *isWhole = reader.size() == sizeof record;
    if (*isWhole)
        std::memcpy(&record, reader.body(), sizeof record);
    return record;
}

}  // namespace

PlantRecorder::PlantRecorder() = default;
PlantRecorder::~PlantRecorder() = default;

bool PlantRecorder::attach(const QByteArray &ringFile, QString *error)
{
    if (!m_reader.open(ringFile, error))
        return false;
    if (!RingDescription::fromText(m_reader.memory().description(), &m_description)) {
        *error = QStringLiteral("the ring '%1' does not describe a plant").arg(QFile::decodeName(ringFile));
        return false;
    }
    const QPlcSignalTable table = QPlcSignalTable::fromIni(m_description.table);
    if (!m_reader.attach()) {
        *error
            = QStringLiteral("another recorder records the ring '%1'; stop it first").arg(QFile::decodeName(ringFile));
        return false;
    }
    m_startTime = m_reader.memory().header()->startTime;
    m_message = std::make_unique<PlantMessage>(table);
    return true;
}

void PlantRecorder::goOnFrom(const Position &position)
{
    m_next = position.next;
    m_digest = position.digest;
    m_time = std::uint64_t(m_startTime) + position.next * std::uint64_t(m_description.period);
}

bool PlantRecorder::begin(std::unique_ptr<mcap::FileSink> sink, QString *error)
{
    auto writer = std::make_unique<mcap::Writer>(std::move(sink));
    m_overview = std::make_unique<overview::Builder>(m_message->image());
    const QMap<QByteArray, QByteArray> session{
        {"plant", m_description.plant.toUtf8()},
        {"session", QByteArray::number(m_description.session, 16)},
        {"phase", QByteArray::number(m_description.phase)},
        {"period_ns", QByteArray::number(m_description.period)},
        {"clock", m_description.clock.toUtf8()},
        {"start_ns", QByteArray::number(qlonglong(m_startTime))},
    };
    if (!writer->begin("QtPLC " + m_description.version.toUtf8(), error)
        || !writer->addAttachment("recording.txt", "text/plain", m_description.toText(), std::uint64_t(m_startTime),
                                  error)
        || !writer->addMetadata("qtplc", session, error))
        return false;
    m_writer = std::move(writer);
    m_exchange.clear();
    m_cycles = 0;
    m_missing = 0;
    m_hasEndMetadata = false;
    const QByteArray ros = "ros1msg";
    m_plant = m_writer->addChannel("/plant", "ros1", PlantMessage::schemaName(), ros, m_message->schema());
    m_before = m_writer->addChannel("/plant_before", "ros1", PlantMessage::schemaName(), ros, m_message->schema());
    m_nodes = m_writer->addChannel("/nodes", "ros1", "qtplc/Nodes", ros, nodesSchema());
    m_raw = m_writer->addChannel("/raw_outputs", "ros1", "qtplc/RawOutputs", ros, rawSchema);
    m_rawInputs = m_writer->addChannel("/raw_inputs", "ros1", "qtplc/RawInputs", ros, rawInputsSchema);
    m_joins = m_writer->addChannel("/joins", "ros1", "qtplc/Join", ros, joinSchema);
    m_rosters = m_writer->addChannel("/rosters", "json");
    m_gaps = m_writer->addChannel("/gaps", "json");
    m_digests = m_writer->addChannel("/digest", "json");
    static_assert(std::size(happeningChannels) == std::tuple_size_v<decltype(m_happenings)>);
    for (std::size_t i = 0; i < m_happenings.size(); ++i)
        m_happenings[i] = m_writer->addChannel(happeningChannels[i], "json");
    if (m_next > 0)
        addDigest(",\"continues\":true");
    if (!m_roster.isEmpty())
        addText(m_rosters, m_rosterNumber, m_roster);
    return true;
}

bool PlantRecorder::isChunkFull() const
{
    return m_writer->pending() >= FullChunk;
}

PlantRecorder::Progress PlantRecorder::proceed(QString *error)
{
    bool hasWriter = true;
    const std::uint32_t marks = m_reader.memory().header()->wishes.load(std::memory_order_relaxed);
    if (std::exchange(m_marks, marks) != marks)
        m_triggers |= Mark;
    for (bool any = false;;) {
        if (isChunkFull())
            return save(false, error) ? Recorded : Failed;
        if (m_isOver && waitsForLastText())
            return Waiting;
        if (m_isOver)
            return save(false, error) ? Ended : Failed;
        const RingReader::Result result = m_reader.next();
        if (result == RingReader::Found) {
            add();
            any = true;
            continue;
        }
        if (result != RingReader::Nothing) {
            m_isDamaged = true;
            continue;
        }
        if (m_next > 0)
            addTexts(AllTexts);
        if (any)
            return Recorded;
        if (!hasWriter)  // and nothing has come since it was found to be gone
            addLastTexts();
        if (!hasWriter)
            return !save(false, error) ? Failed : isCut() ? CutEnded : Abandoned;
        if (m_reader.hasWriter())
            return Waiting;
        hasWriter = false;
    }
}

void PlantRecorder::add()
{
    m_startTime = m_reader.memory().header()->startTime;  // a recorder may come before the phase begins
    bool isWhole = true;
    if (m_reader.kind() == RecordKind::Cycle) {
        addCycle();
    } else if (m_reader.kind() == RecordKind::Gap) {
        const auto gap = recordIn<RecordedGap>(m_reader, &isWhole);
        if (isWhole)
            addGap(gap);
    } else if (m_reader.kind() == RecordKind::End) {
        const auto end = recordIn<RecordedEnd>(m_reader, &isWhole);
        if (isWhole)
            addEnd(end);
    } else if (m_reader.kind() == RecordKind::Roster) {
        isWhole = addRoster();
    } else if (m_reader.kind() == RecordKind::Join) {
        isWhole = addJoin();
    } else if (m_reader.kind() == RecordKind::Settings) {
        const auto settings = recordIn<RecordedSettings>(m_reader, &isWhole);
        if (isWhole)
            m_adoptions.push_back(settings);
        if (m_adoptions.size() > MostAdoptions)
            m_adoptions.pop_front();
    }
    m_isDamaged = m_isDamaged || !isWhole;
}

void PlantRecorder::addCycle()
{
    CycleView view;
    if (!CycleView::read(m_reader.body(), m_reader.size(), &view) || view.cycle.imageSize != m_message->imageSize()) {
        m_isDamaged = true;
        return;
    }
    const RecordedCycle &cycle = view.cycle;
    if (cycle.number < m_next)  // another file has it
        return;
    const std::uint64_t next = cycle.number - cycle.skipped;
    if (next > m_next)  // they had been replaced before anybody recorded
        addGap({m_next, next - 1, next - m_next, 0, 0});
    addTexts(cycle.number);
    m_time = timeOf(cycle.number);
    const auto published = cycle.wallTime != 0 ? std::uint64_t(cycle.wallTime) : m_time;
    const auto sequence = std::uint32_t(cycle.number);
    const PlantMessage::Cycle head{cycle.number, cycle.lateness, cycle.skipped, cycle.flags};
    if (cycle.beforeSize > 0 && cycle.number == 0)
        keepInitialValues(view.before);
    if (cycle.beforeSize > 0) {
        m_message->encode(head, view.before, &m_body);
        m_writer->addMessage(m_before, sequence, m_time, published, m_body.constData(), std::size_t(m_body.size()));
    }
    m_message->encode(head, view.image, &m_body);
    m_writer->addMessage(m_plant, sequence, m_time, published, m_body.constData(), std::size_t(m_body.size()));
    addNodes(view);
    addRaw(view);
    if (m_overview)
        m_overview->add(cycle.number, m_startTime, view.image);
    watch(view);
    m_next = cycle.number + 1;
    m_digest = cycle.digest;
    m_hasDigest = false;
    ++m_cycles;
}

/// For people, and for programs that do not want to decode a message.
void PlantRecorder::keepInitialValues(const char *image)
{
    const QPlcSignalTable &table = m_message->table();
    QJsonObject values;
    for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(table.size()); ++i) {
        const QPlcSignalDefinition &signal = table.at(i);
        values.insert(signal.name, QPlcValue::fromBytes(signal.type, image + m_message->image().offset(i)).toString());
    }
    m_initial = QJsonDocument(values).toJson();
}

void PlantRecorder::watch(const CycleView &view)
{
    const bool isSafe = (view.cycle.flags & RecordedCycle::Safe) != 0;
    std::uint32_t faulted = 0;
    for (std::uint32_t i = 0; i < view.cycle.nodes; ++i)
        faulted += (view.node(i).flags & RecordedNode::Faulted) != 0 ? 1 : 0;
    if (isSafe && !m_isSafe)
        m_triggers |= SafeStop;
    if (faulted > m_faulted)
        m_triggers |= Fault;
    m_isSafe = isSafe;
    m_faulted = faulted;
}

void PlantRecorder::addNodes(const CycleView &view)
{
    const QByteArray body = nodesMessage(view);
    if (body == m_exchange)
        return;
    m_exchange = body;
    addText(m_nodes, std::uint32_t(view.cycle.number), body);
}

void PlantRecorder::addRaw(const CycleView &view)
{
    const char *at = view.raw;
    std::uint32_t left = view.cycle.rawSize;
    const auto add = [&](std::uint16_t channel, std::uint16_t id, std::uint32_t size) {
        const std::uint32_t padded = paddedRecordSize(size);
        if (size == 0 || padded > left || size > padded)
            return;
        const QByteArray body = mcap::Fields().number(id).text(QByteArray(at, int(size))).bytes();
        addText(channel, std::uint32_t(view.cycle.number), body);
        at += padded;
        left -= padded;
    };
    for (std::uint32_t i = 0; i < view.cycle.nodes; ++i) {
        const RecordedNode node = view.node(i);
        add(m_raw, node.id, node.rawSize);
        add(m_rawInputs, node.id, node.inputsSize);
    }
}

/// The same one comes again and again, and is written once into each file.
bool PlantRecorder::addRoster()
{
    RecordedRoster roster;
    if (m_reader.size() < sizeof roster)
        return false;
    std::memcpy(&roster, m_reader.body(), sizeof roster);
    if (roster.textSize > m_reader.size() - sizeof roster)
        return false;
    if (roster.number == m_rosterNumber)
        return true;
    const QByteArray text(m_reader.body() + sizeof roster, int(roster.textSize));
    m_rosterNumber = roster.number;
    m_time = std::max(m_time, timeOf(roster.first));
    m_roster = "{\"number\":" + QByteArray::number(roster.number) + ",\"first\":"
        + QByteArray::number(qulonglong(roster.first)) + (text.isEmpty() ? "" : ",\"roster\":") + text + '}';
    addText(m_rosters, roster.number, m_roster);
    return true;
}

bool PlantRecorder::addJoin()
{
    RecordedJoin join;
    if (m_reader.size() < sizeof join)
        return false;
    std::memcpy(&join, m_reader.body(), sizeof join);
    const std::uint64_t outputs = (std::uint64_t(join.outputsSize) + 7) & ~std::uint64_t(7);
    if (sizeof join + outputs + join.inputsSize > m_reader.size())
        return false;
    m_time = std::max(m_time, timeOf(join.first));
    const char *bytes = m_reader.body() + sizeof join;
    addText(m_joins, std::uint32_t(join.first),
            mcap::Fields()
                .number(join.id)
                .number(join.first)
                .text(QByteArray(bytes, int(join.outputsSize)))
                .text(QByteArray(bytes + outputs, int(join.inputsSize)))
                .bytes());
    return true;
}

// ---- what has happened ----

/// Texts of before the cycle \a before. One that tells a value waits for the cycle that adopts it,
/// and those behind it wait, too.
void PlantRecorder::addTexts(std::uint64_t before)
{
    RegionReader &texts = m_reader.texts();
    while (!m_hasLastText && !texts.isEmpty()) {
        const RegionReader::Result result = texts.next();
        if (result == RegionReader::Nothing)
            return;
        RecordedText text;
        const bool isText = result == RegionReader::Found && texts.size() >= sizeof text;
        if (isText)
            std::memcpy(&text, texts.body(), sizeof text);
        if (!isText || text.textSize > texts.size() - sizeof text)
            continue;  // the numbers of others tell that it is missing
        const bool isEarly = text.cycle == RecordedText::BeforePhase || text.cycle < before;
        if (texts.kind() == RecordKind::Text && !m_isLast && (!isEarly || !isAdopted(text)))
            return texts.putBack();
        addLost(text.number);
        m_hasLastText = texts.kind() == RecordKind::LastText;
        if (texts.kind() == RecordKind::Text)
            addHappening(text, std::min(cycleOf(text), before == AllTexts ? m_next : before),
                         QByteArray(texts.body() + sizeof text, int(text.textSize)));
    }
}

void PlantRecorder::addLastTexts()
{
    m_isLast = true;
    addTexts(AllTexts);
}

bool PlantRecorder::isAdopted(const RecordedText &text) const
{
    return text.settings == 0 || (!m_adoptions.empty() && m_adoptions.back().adopted >= text.settings);
}

/// The cycle that has adopted a value, or in which something else has happened.
std::uint64_t PlantRecorder::cycleOf(const RecordedText &text) const
{
    if (text.cycle == RecordedText::BeforePhase)
        return 0;
    if (text.settings == 0)
        return text.cycle;
    const auto found
        = std::lower_bound(m_adoptions.begin(), m_adoptions.end(), text.settings,
                           [](const RecordedSettings &each, std::uint64_t wanted) { return each.adopted < wanted; });
    // What was adopted before the first record that is known, was adopted by the next cycle.
    return found == m_adoptions.end()                                   ? m_next
        : found == m_adoptions.begin() && found->cycle > text.cycle + 1 ? text.cycle + 1
                                                                        : found->cycle;
}

void PlantRecorder::addHappening(const RecordedText &text, std::uint64_t cycle, QByteArray body)
{
    const auto topic = std::size_t(text.topic - RecordedText::Event);
    if (topic >= std::size(m_happenings) || body.size() <= 2 || body.at(0) != '{')
        return;
    const QDateTime time = QDateTime::fromMSecsSinceEpoch(text.wallTime / 1'000'000, Qt::UTC);
    QByteArray head = "{\"cycle\":" + QByteArray::number(qulonglong(cycle)) + ",\"utc\":\""
        + time.toString(Qt::ISODateWithMs).toLatin1() + "\",";
    if (text.cycle == RecordedText::BeforePhase)
        head += "\"before\":true,";
    if (!isAdopted(text))
        head += "\"adopted\":false,";
    body.replace(0, 1, head);
    m_time = std::max(m_time, timeOf(cycle));
    m_writer->addMessage(m_happenings[topic], std::uint32_t(text.number), m_time,
                         m_startTime != 0 ? std::uint64_t(text.wallTime) : m_time, body.constData(),
                         std::size_t(body.size()));
}

/// Texts between the last one and that of \a number have had no room.
void PlantRecorder::addLost(std::uint64_t number)
{
    const std::uint64_t lost = number > m_lastText ? number - m_lastText - 1 : 0;
    const bool isKnown = m_lastText > 0 || m_next == 0;  // else another file has those before
    m_lastText = number;
    if (lost == 0 || !isKnown)
        return;
    const QByteArray count = QByteArray::number(qulonglong(lost));
    addText(m_happenings[0], std::uint32_t(number - 1),
            "{\"cycle\":" + QByteArray::number(qulonglong(m_next)) + ",\"severity\":\"warning\",\"kind\":\"state\","
                + "\"source\":\"recorder\",\"text\":\"" + count
                + " events, commands or statistics before this one are missing: there was no room for them\",\"lost\":"
                + count + '}');
}

/// The master tells some things when the last cycle has ended. One that hangs is not waited for.
bool PlantRecorder::waitsForLastText()
{
    addLastTexts();
    return !m_reader.texts().isEmpty() && !m_hasLastText && m_reader.hasWriter() && ++m_looksForText < MostLooksForText;
}

void PlantRecorder::addText(std::uint16_t channel, std::uint32_t sequence, const QByteArray &body)
{
    m_writer->addMessage(channel, sequence, m_time, m_time, body.constData(), std::size_t(body.size()));
}

/// \a gap with a digest of 0: what was computed in it is not known.
void PlantRecorder::addGap(const RecordedGap &gap)
{
    if (gap.last < m_next)  // another file has it
        return;
    m_time = timeOf(gap.last);
    addText(m_gaps, std::uint32_t(gap.last), gapMessage(gap));
    m_next = gap.last + 1;
    m_digest = gap.digest;
    m_hasDigest = true;  // it is in the gap
    m_missing += gap.cycles;
}

void PlantRecorder::addEnd(const RecordedEnd &end)
{
    m_isOver = true;
    m_digest = end.digest;
    addDigest(",\"end\":true,\"cycles\":" + QByteArray::number(qulonglong(end.cycles))
              + ",\"missing\":" + QByteArray::number(qulonglong(end.missing)));
}

void PlantRecorder::addDigest(const QByteArray &more)
{
    const QByteArray text = "{\"next\":" + QByteArray::number(qulonglong(m_next)) + ",\"digest\":\""
        + digestText(m_digest) + '"' + more + '}';
    addText(m_digests, std::uint32_t(m_next), text);
    m_hasDigest = true;
}

bool PlantRecorder::save(bool sync, QString *error)
{
    if (!m_hasDigest)
        addDigest({});
    if (!m_initial.isEmpty()
        && !m_writer->addAttachment("initial_values.json", "application/json", m_initial, std::uint64_t(m_startTime),
                                    error))
        return false;
    m_initial.clear();
    if (!m_writer->flush(error) || (sync && !m_writer->sync(error)))
        return false;
    m_reader.release();
    return true;
}

/// A full disk has no room for it: readers compute it then.
void PlantRecorder::addOverview()
{
    QString error;
    if (m_overview)
        m_writer->addAttachment(overview::Name, overview::MediaType, m_overview->bytes(), m_time, &error);
    m_overview.reset();
}

bool PlantRecorder::finish(QString *error)
{
    const QMap<QByteArray, QByteArray> end{{"digest", digestText(m_digest)},
                                           {"cycles", QByteArray::number(qulonglong(m_cycles))},
                                           {"missing", QByteArray::number(qulonglong(m_missing))}};
    if (!save(false, error))
        return false;
    addOverview();
    m_hasEndMetadata = m_hasEndMetadata || m_writer->addMetadata("end", end, error);
    if (!m_hasEndMetadata || !m_writer->finish(error))
        return false;
    m_writer.reset();
    return true;
}

bool PlantRecorder::cut(QString *error)
{
    m_writer->discard();
    const bool isFinished = m_writer->finish(error);
    m_writer.reset();
    return isFinished;
}

}  // namespace qplc
