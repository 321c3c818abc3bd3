// SPDX-License-Identifier: Apache-2.0
#include "McapReader.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>

#include <zstd.h>

namespace qplc::mcap {

namespace {

constexpr std::uint64_t LargestRecord = std::uint64_t(1) << 30;
constexpr std::uint64_t LargestOutline = std::uint64_t(1) << 20;

/// The records of the chunk with this \a content. \return false when it is damaged
bool readChunkContent(const QByteArray &content, ChunkEntry *entry, QByteArray *records)
{
    FieldReader fields(content.constData(), std::size_t(content.size()));
    entry->begin = fields.number<std::uint64_t>();
    entry->end = fields.number<std::uint64_t>();
    entry->size = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    entry->compression = fields.text();
    entry->compressedSize = fields.number<std::uint64_t>();
    const char *bytes = fields.skip(entry->compressedSize);
    return bytes && fields.isWhole() && fields.left() == 0
        && uncompress(entry->compression, bytes, std::size_t(entry->compressedSize), entry->size, records)
        && crc32(records->constData(), std::size_t(records->size())) == crc;
}

/// Times of a chunk are not under its checksum: those of its messages are.
bool hasItsTimes(const ChunkEntry &entry, const QByteArray &records)
{
    std::uint64_t begin = ~std::uint64_t(0);
    std::uint64_t end = 0;
    const bool isWhole = forEachMessage(
        records, [](const Channel &) {},
        [&](const Message &message, std::uint64_t) {
            begin = std::min(begin, message.time);
            end = std::max(end, message.time);
        });
    return isWhole && begin == entry.begin && end == entry.end;
}

bool readAttachmentContent(const QByteArray &content, Attachment *attachment)
{
    FieldReader fields(content.constData(), std::size_t(content.size()));
    attachment->time = fields.number<std::uint64_t>();
    fields.number<std::uint64_t>();
    attachment->name = fields.text();
    attachment->mediaType = fields.text();
    attachment->data = fields.bytes(fields.number<std::uint64_t>());
    const auto covered = std::size_t(fields.at() - content.constData());
    const auto crc = fields.number<std::uint32_t>();
    return fields.isWhole() && fields.left() == 0 && crc32(content.constData(), covered) == crc;
}

/// Of a header or an index of messages. A length that is wrong would hide what follows.
bool hasItsLength(std::uint8_t opcode, const QByteArray &content)
{
    FieldReader fields(content.constData(), std::size_t(content.size()));
    if (opcode == HeaderOpcode)
        fields.text();
    else if (opcode == MessageIndexOpcode)
        fields.number<std::uint16_t>();
    else
        return false;
    fields.text();
    return fields.isWhole() && fields.left() == 0;
}

/// Records in a chunk. \param take  gets opcode, fields and place of each of them; the first one
/// that it refuses is the last one
/// \return false when one was refused, or is cut
template<typename Take>
bool forEachRecord(const QByteArray &records, Take take)
{
    FieldReader reader(records.constData(), std::size_t(records.size()));
    while (reader.left() > 0) {
        const auto offset = std::uint64_t(reader.at() - records.constData());
        const auto opcode = reader.number<std::uint8_t>();
        const auto length = reader.number<std::uint64_t>();
        const char *content = reader.skip(length);
        if (!content || !take(opcode, FieldReader(content, std::size_t(length)), offset))
            return false;
    }
    return true;
}

bool readEntry(FieldReader fields, NamedEntry *entry)
{
    entry->offset = fields.number<std::uint64_t>();
    entry->length = fields.number<std::uint64_t>();
    entry->time = fields.number<std::uint64_t>();
    fields.number<std::uint64_t>();
    entry->dataSize = fields.number<std::uint64_t>();
    entry->name = fields.text();
    entry->mediaType = fields.text();
    return fields.isWhole();
}

bool readStatistics(FieldReader fields, Outline *outline)
{
    outline->messages = fields.number<std::uint64_t>();
    fields.skip(2 + 4 * 4);
    outline->begin = fields.number<std::uint64_t>();
    outline->end = fields.number<std::uint64_t>();
    return fields.isWhole();
}

}  // namespace

ScanHandler::~ScanHandler() = default;

void Indexer::chunk(const ChunkEntry &entry, const QByteArray &records)
{
    forEachSchema(records, [this](const Schema &schema) { index.schemas.push_back(schema); });
    index.chunks.push_back(entry);
    messages.clear();
    forEachMessage(
        records, [this](const Channel &channel) { add(channel); },
        [this](const Message &message, std::uint64_t offset) {
            messages.push_back({message.channel, message.time, offset});
        });
    indexes.push_back(messageIndexes(messages, entry.offset + entry.length, &index.chunks.back()));
}

void Indexer::add(const Channel &channel)
{
    for (const Channel &known : index.channels) {
        if (known.id == channel.id)
            return;
    }
    index.channels.push_back(channel);
}

bool Reader::open(const QString &file, QString *error)
{
    m_file.close();
    m_file.setFileName(file);
    // Without waiting for somebody who writes into a FIFO.
    const int descriptor = ::open(QFile::encodeName(file).constData(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat status = {};
    if (descriptor < 0 || ::fstat(descriptor, &status) != 0
        || !m_file.open(descriptor, QIODevice::ReadOnly, QFileDevice::AutoCloseHandle)) {
        *error = QStringLiteral("cannot open '%1': %2").arg(file, qt_error_string(errno));
        return false;
    }
    if (!S_ISREG(status.st_mode)) {
        *error = QStringLiteral("'%1' is not a file: a recording cannot be read from it").arg(file);
        m_file.close();
        return false;
    }
    if (read(0, MagicSize) == QByteArray(Magic, MagicSize))
        return true;
    *error = QStringLiteral("'%1' is not a recording: it does not begin as an MCAP file does").arg(file);
    m_file.close();
    return false;
}

QByteArray Reader::read(std::uint64_t offset, std::uint64_t size)
{
    if (offset > this->size() || size > this->size() - offset || size > LargestRecord || !m_file.seek(qint64(offset)))
        return {};
    return m_file.read(qint64(size));
}

bool Reader::readSummary(Index *index)
{
    *index = {};
    constexpr std::uint64_t tail = FooterSize + MagicSize;
    if (size() < tail + MagicSize)
        return false;
    const QByteArray footer = read(size() - tail, tail);
    FieldReader fields(footer.constData(), std::size_t(footer.size()));
    const bool isFooter = fields.number<std::uint8_t>() == FooterOpcode && fields.number<std::uint64_t>() == 20;
    const auto begin = fields.number<std::uint64_t>();
    fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    if (!isFooter || !footer.endsWith(QByteArray(Magic, MagicSize)) || begin < MagicSize || begin > size() - tail)
        return false;
    const QByteArray summary = read(begin, size() - MagicSize - 4 - begin);
    if (summary.isEmpty() || crc32(summary.constData(), std::size_t(summary.size())) != crc)
        return false;
    FieldReader records(summary.constData(), std::size_t(summary.size() - (FooterSize - 4)));
    while (records.left() > 0) {
        const auto opcode = records.number<std::uint8_t>();
        const auto length = records.number<std::uint64_t>();
        const char *content = records.skip(length);
        if (!content)
            return false;
        const FieldReader inside(content, std::size_t(length));
        if (opcode == ChunkIndexOpcode && !ChunkEntry::read(inside, &index->chunks.emplace_back()))
            return false;
        if (opcode == SchemaOpcode && !Schema::read(inside, &index->schemas.emplace_back()))
            return false;
        if (opcode == ChannelOpcode && !Channel::read(inside, &index->channels.emplace_back()))
            return false;
        if (opcode == AttachmentIndexOpcode && !readEntry(inside, &index->attachments.emplace_back()))
            return false;
    }
    return true;
}

bool Reader::readOutline(Outline *outline)
{
    *outline = {};
    if (size() < FooterSize + 2 * MagicSize)
        return false;
    const QByteArray footer = read(size() - MagicSize - FooterSize, FooterSize + MagicSize);
    FieldReader fields(footer.constData() + RecordHeadSize, std::size_t(footer.size() - RecordHeadSize));
    fields.skip(8);
    const auto offsets = fields.number<std::uint64_t>();
    if (footer.at(0) != char(FooterOpcode) || !footer.endsWith(QByteArray(Magic, MagicSize))
        || offsets > size() - MagicSize - FooterSize)
        return false;
    const QByteArray groups = read(offsets, std::min(size() - MagicSize - FooterSize - offsets, LargestOutline));
    bool hasStatistics = false;
    const bool isWhole = forEachRecord(groups, [&](std::uint8_t opcode, FieldReader group, std::uint64_t) {
        const auto kind = group.number<std::uint8_t>();
        const auto begin = group.number<std::uint64_t>();
        const auto length = group.number<std::uint64_t>();
        if (opcode != SummaryOffsetOpcode || (kind != StatisticsOpcode && kind != AttachmentIndexOpcode))
            return true;
        return forEachRecord(read(begin, std::min(length, LargestOutline)),
                             [&](std::uint8_t inside, FieldReader record, std::uint64_t) {
                                 if (inside == AttachmentIndexOpcode)
                                     return readEntry(record, &outline->attachments.emplace_back());
                                 hasStatistics = inside == StatisticsOpcode && readStatistics(record, outline);
                                 return hasStatistics;
                             });
    });
    return isWhole && hasStatistics;
}

bool Reader::readIndex(Index *index)
{
    if (readSummary(index))
        return true;
    Indexer indexer;
    scan(indexer);
    *index = std::move(indexer.index);
    return false;
}

bool Reader::readAttachment(const NamedEntry &entry, Attachment *attachment)
{
    const QByteArray record = read(entry.offset, entry.length);
    return record.size() > RecordHeadSize && record.at(0) == char(AttachmentOpcode)
        && readAttachmentContent(record.mid(RecordHeadSize), attachment);
}

bool Reader::readChunk(const ChunkEntry &entry, QByteArray *records)
{
    const QByteArray record = read(entry.offset, entry.length);
    ChunkEntry there;
    return record.size() > RecordHeadSize && record.at(0) == char(ChunkOpcode)
        && readChunkContent(record.mid(RecordHeadSize), &there, records);
}

Reader::End Reader::scan(ScanHandler &handler)
{
    m_goodEnd = MagicSize;
    m_damages = 0;
    std::uint64_t offset = MagicSize;
    while (offset < size()) {
        const QByteArray head = read(offset, RecordHeadSize);
        FieldReader fields(head.constData(), std::size_t(head.size()));
        const auto opcode = fields.number<std::uint8_t>();
        const auto length = fields.number<std::uint64_t>();
        if (opcode == DataEndOpcode && length == 4)
            break;
        const bool isThere = fields.isWhole() && length <= LargestRecord && length <= size() - offset - RecordHeadSize;
        if (isThere && handle(opcode, read(offset + RecordHeadSize, length), offset, handler)) {
            offset += RecordHeadSize + length;
            continue;
        }
        const std::uint64_t next = nextChunk(offset + 1);
        if (next > offset && next < size())
            ++m_damages;
        offset = next;
    }
    Index index;
    return readSummary(&index) ? Finished : Unfinished;
}

/// \return false when it is damaged, or not what stands before or between chunks
bool Reader::handle(std::uint8_t opcode, const QByteArray &content, std::uint64_t offset, ScanHandler &handler)
{
    const std::uint64_t length = std::uint64_t(content.size()) + RecordHeadSize;
    if (opcode == ChunkOpcode) {
        ChunkEntry entry;
        QByteArray records;
        if (!readChunkContent(content, &entry, &records) || !hasItsTimes(entry, records))
            return false;
        entry.offset = offset;
        entry.length = length;
        m_goodEnd = offset + length;
        handler.chunk(entry, records);
        return true;
    }
    if (opcode == AttachmentOpcode) {
        Attachment attachment;
        if (!readAttachmentContent(content, &attachment))
            return false;
        m_goodEnd = offset + length;
        handler.attachment(attachment,
                           {attachment.name, attachment.mediaType, offset, length, attachment.time,
                            std::uint64_t(attachment.data.size())});
        return true;
    }
    if (opcode == MetadataOpcode) {
        FieldReader fields(content.constData(), std::size_t(content.size()));
        const QByteArray name = fields.text();
        fields.texts();
        if (!fields.isWhole() || fields.left() != 0)
            return false;
        m_goodEnd = offset + length;
        handler.metadata(content, {name, {}, offset, length, 0, 0});
        return true;
    }
    return hasItsLength(opcode, content);
}

/// Where the next chunk begins that is whole, from \a from on; the end of the file: nowhere. A
/// chunk has the name of its compression at a known place.
std::uint64_t Reader::nextChunk(std::uint64_t from)
{
    constexpr std::uint64_t piece = 1U << 20;
    constexpr std::uint64_t nameAt = RecordHeadSize + 28;
    static const QByteArray name("\x04\0\0\0zstd", 8);
    for (std::uint64_t begin = from + nameAt; begin < size();) {
        const QByteArray bytes = read(begin, std::min(piece, size() - begin));
        const int at = bytes.indexOf(name);
        if (at < 0) {
            if (begin + std::uint64_t(bytes.size()) >= size() || bytes.isEmpty())
                break;
            begin += std::uint64_t(bytes.size()) - std::uint64_t(name.size() - 1);
            continue;
        }
        const std::uint64_t chunk = begin + std::uint64_t(at) - nameAt;
        const QByteArray head = read(chunk, RecordHeadSize);
        FieldReader fields(head.constData(), std::size_t(head.size()));
        const bool isChunk = fields.number<std::uint8_t>() == ChunkOpcode;
        const auto length = fields.number<std::uint64_t>();
        ChunkEntry entry;
        QByteArray records;
        if (isChunk && length < LargestRecord
            && readChunkContent(read(chunk + RecordHeadSize, length), &entry, &records))
            return chunk;
        begin += std::uint64_t(at) + 1;
    }
    return size();
}

bool readMessage(FieldReader fields, Message *message)
{
    message->channel = fields.number<std::uint16_t>();
    message->sequence = fields.number<std::uint32_t>();
    message->time = fields.number<std::uint64_t>();
    message->published = fields.number<std::uint64_t>();
    message->bytes = fields.at();
    message->size = fields.left();
    return fields.isWhole();
}

bool forEachMessage(const QByteArray &records, const std::function<void(const Channel &channel)> &isChannel,
                    const std::function<void(const Message &message, std::uint64_t offset)> &found)
{
    return forEachRecord(records, [&](std::uint8_t opcode, FieldReader fields, std::uint64_t offset) {
        if (opcode == ChannelOpcode) {
            Channel channel;
            if (!Channel::read(fields, &channel))
                return false;
            isChannel(channel);
        } else if (opcode == MessageOpcode) {
            Message message;
            if (!readMessage(fields, &message))
                return false;
            found(message, offset);
        }
        return true;
    });
}

void forEachSchema(const QByteArray &records, const std::function<void(const Schema &schema)> &found)
{
    forEachRecord(records, [&](std::uint8_t opcode, FieldReader fields, std::uint64_t) {
        Schema schema;
        if (opcode == SchemaOpcode && Schema::read(fields, &schema))
            found(schema);
        return true;
    });
}

bool uncompress(const QByteArray &compression, const char *bytes, std::size_t compressedSize, std::uint64_t size,
                QByteArray *result)
{
    constexpr std::uint64_t largest = 64U << 20;  // a chunk is in memory as a whole
    if (size > largest)
        return false;
    if (compression.isEmpty()) {
        *result = QByteArray(bytes, int(compressedSize));
        return compressedSize == size;
    }
    // A size that the bytes cannot give takes no memory.
    if (compression != "zstd" || ZSTD_getFrameContentSize(bytes, compressedSize) != size)
        return false;
    result->resize(int(size));
    return ZSTD_decompress(result->data(), std::size_t(size), bytes, compressedSize) == size;
}

}  // namespace qplc::mcap
