// SPDX-License-Identifier: Apache-2.0
#include "Recording.h"

#include "protocol/LittleEndian.h"

#include <algorithm>

namespace qplc {

RecordedRows::RecordedRows(Recording &recording, std::vector<int> columns, RecordedTime begin, RecordedTime end)
    : m_recording(recording)
    , m_columns(std::move(columns))
    , m_begin(begin)
    , m_end(end)
    , m_indices(m_columns.size(), -1)
    , m_values(m_columns.size(), nullptr)
    , m_sizes(m_columns.size(), 0)
{
    const std::vector<RecordedFile> &files = m_recording.files();
    while (m_file < files.size() && files[m_file].end < begin)
        ++m_file;
}

RecordedRows::~RecordedRows() = default;

const RecordedFile &RecordedRows::file() const
{
    return m_recording.files()[std::min(m_file, m_recording.files().size() - 1)];
}

bool RecordedRows::next()
{
    for (;;) {
        if (m_at >= std::size_t(m_records.size())) {
            if (!openChunk())
                return false;
            continue;
        }
        mcap::FieldReader fields(m_records.constData() + m_at, std::size_t(m_records.size()) - m_at);
        const auto opcode = fields.number<std::uint8_t>();
        const auto length = fields.number<std::uint64_t>();
        const char *content = fields.skip(length);
        if (!content) {  // the checksum was that of a writer that has failed
            m_at = std::size_t(m_records.size());
            ++m_damages;
            continue;
        }
        m_at = std::size_t(fields.at() - m_records.constData());
        mcap::Message message;
        if (opcode != mcap::MessageOpcode || !mcap::readMessage({content, std::size_t(length)}, &message))
            continue;
        if (RecordedTime(message.time) > m_end && message.channel == m_plant)
            return false;
        if (RecordedTime(message.time) >= m_begin && read(message))
            return true;
    }
}

/// The next chunk of these times. \return false when there is none
bool RecordedRows::openChunk()
{
    for (; m_file < m_recording.files().size(); ++m_file, m_isOpen = false) {
        if (file().begin > m_end)
            return false;
        if (!m_isOpen && !openFile()) {
            ++m_damages;
            continue;
        }
        const std::vector<mcap::ChunkEntry> &chunks = m_index->chunks;
        for (; m_chunk < chunks.size(); ++m_chunk) {
            const mcap::ChunkEntry &chunk = chunks[m_chunk];
            if (RecordedTime(chunk.begin) > m_end)
                return false;
            if (RecordedTime(chunk.end) < m_begin)
                continue;
            m_at = 0;
            ++m_chunks;
            if (m_reader->readChunk(chunk, &m_records)) {
                ++m_chunk;
                return true;
            }
            m_records.clear();
            ++m_damages;
        }
    }
    return false;
}

bool RecordedRows::openFile()
{
    m_reader = std::make_unique<mcap::Reader>();
    QString error;
    m_index = m_recording.indexOf(m_file);
    if (!m_index || !m_reader->open(file().name, &error))
        return false;
    m_plant = mcap::channelOf(*m_index, "/plant");
    m_topics.clear();
    for (const mcap::Channel &channel : m_index->channels)
        m_topics.insert(channel.id, channel.topic);
    for (std::size_t i = 0; i < m_columns.size(); ++i)
        m_indices[i] = m_recording.signalList()[std::size_t(m_columns[i])].indices[std::size_t(file().layout)];
    const auto behind
        = std::partition_point(m_index->chunks.begin(), m_index->chunks.end(),
                               [this](const mcap::ChunkEntry &chunk) { return RecordedTime(chunk.end) < m_begin; });
    m_chunk = std::size_t(behind - m_index->chunks.begin());
    m_isOpen = true;
    return true;
}

/// \return whether it is a cycle, which comes behind the one before
bool RecordedRows::read(const mcap::Message &message)
{
    if (message.channel != m_plant) {
        if (m_other)
            m_other(m_topics.value(message.channel), message);
        return false;
    }
    const auto time = RecordedTime(message.time);
    if (m_hasRow && time <= m_time)
        return false;
    const RecordedLayout &layout = m_recording.layout(file().layout);
    const std::size_t count = std::size_t(layout.message.table().size());
    const std::vector<std::uint32_t> *offsets = &layout.offsets;
    if (layout.offsets.empty()) {
        if (!layout.message.locate(message.bytes, message.size, &m_offsets))
            return false;
        offsets = &m_offsets;
    } else if (message.size != layout.message.fixedSize()) {
        return false;
    }
    m_hasRow = true;
    m_time = time;
    m_wallTime = std::int64_t(message.published);
    m_cycle = PlantMessage::cycleOf(message.bytes);
    m_qualities = message.bytes + message.size - count;
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
        const int index = m_indices[i];
        m_values[i] = index < 0 ? nullptr : message.bytes + (*offsets)[std::size_t(index)];
        if (index < 0)
            continue;
        const QPlcSignalType type = layout.message.table().at(QPlcSignalIndex(index)).type;
        m_sizes[i] = std::uint32_t(type.size());
        if (type.isString()) {
            m_sizes[i] = loadLittle<std::uint32_t>(m_values[i]);
            m_values[i] += sizeof(std::uint32_t);
        }
    }
    return true;
}

double RecordedRows::number(std::size_t column, int element) const
{
    const QPlcSignalType type = m_recording.signalList()[std::size_t(m_columns[column])].definition.type;
    return overview::numberAt(type.scalar(), m_values[column] + element * type.elementSize());
}

QPlcQuality RecordedRows::quality(std::size_t column) const
{
    const int index = m_indices[column];
    return index < 0 ? QPlcQuality(QPlcQuality::Invalid) : QPlcQuality::fromByte(quint8(m_qualities[index]));
}

}  // namespace qplc
