// SPDX-License-Identifier: Apache-2.0
#include "McapIndex.h"

#include <algorithm>

namespace qplc::mcap {

QByteArray Schema::record() const
{
    return recordOf(SchemaOpcode, Fields().number(id).text(name).text(encoding).text(text).bytes());
}

bool Schema::read(FieldReader fields, Schema *schema)
{
    schema->id = fields.number<std::uint16_t>();
    schema->name = fields.text();
    schema->encoding = fields.text();
    schema->text = fields.text();
    return fields.isWhole() && schema->id != 0;
}

QByteArray Channel::record() const
{
    return recordOf(ChannelOpcode, Fields().number(id).number(schema).text(topic).text(encoding).texts({}).bytes());
}

bool Channel::read(FieldReader fields, Channel *channel)
{
    channel->id = fields.number<std::uint16_t>();
    channel->schema = fields.number<std::uint16_t>();
    channel->topic = fields.text();
    channel->encoding = fields.text();
    fields.texts();
    return fields.isWhole();
}

QByteArray ChunkEntry::record() const
{
    Fields offsets;
    for (auto it = indexOffsets.begin(); it != indexOffsets.end(); ++it)
        offsets.number(it.key()).number(it.value());
    return recordOf(ChunkIndexOpcode,
                    Fields()
                        .number(begin)
                        .number(end)
                        .number(offset)
                        .number(length)
                        .text(offsets.bytes())
                        .number(indexLength)
                        .text(compression)
                        .number(compressedSize)
                        .number(size)
                        .bytes());
}

bool ChunkEntry::read(FieldReader fields, ChunkEntry *entry)
{
    entry->begin = fields.number<std::uint64_t>();
    entry->end = fields.number<std::uint64_t>();
    entry->offset = fields.number<std::uint64_t>();
    entry->length = fields.number<std::uint64_t>();
    const QByteArray offsets = fields.text();
    FieldReader inside(offsets.constData(), std::size_t(offsets.size()));
    while (inside.left() > 0 && inside.isWhole()) {
        const auto channel = inside.number<std::uint16_t>();
        entry->indexOffsets.insert(channel, inside.number<std::uint64_t>());
    }
    entry->indexLength = fields.number<std::uint64_t>();
    entry->compression = fields.text();
    entry->compressedSize = fields.number<std::uint64_t>();
    entry->size = fields.number<std::uint64_t>();
    return fields.isWhole() && inside.isWhole();
}

QByteArray attachmentRecord(const QByteArray &name, const QByteArray &mediaType, const QByteArray &data,
                            std::uint64_t time, std::uint64_t offset, NamedEntry *entry)
{
    const QByteArray fields = Fields()
                                  .number(time)
                                  .number(time)
                                  .text(name)
                                  .text(mediaType)
                                  .number(std::uint64_t(data.size()))
                                  .raw(data)
                                  .bytes();
    const std::uint32_t crc = crc32(fields.constData(), std::size_t(fields.size()));
    const QByteArray record = recordOf(AttachmentOpcode, Fields().raw(fields).number(crc).bytes());
    *entry = {name, mediaType, offset, std::uint64_t(record.size()), time, std::uint64_t(data.size())};
    return record;
}

QByteArray Index::statistics() const
{
    QMap<std::uint16_t, std::uint64_t> counts;
    std::uint64_t messages = 0;
    std::uint64_t begin = ~std::uint64_t(0);
    std::uint64_t last = 0;
    for (const ChunkEntry &chunk : chunks) {
        for (auto it = chunk.counts.begin(); it != chunk.counts.end(); ++it) {
            counts[it.key()] += it.value();
            messages += it.value();
        }
        begin = std::min(begin, chunk.begin);
        last = std::max(last, chunk.end);
    }
    Fields byChannel;
    for (auto it = counts.begin(); it != counts.end(); ++it)
        byChannel.number(it.key()).number(it.value());
    return recordOf(StatisticsOpcode,
                    Fields()
                        .number(messages)
                        .number(std::uint16_t(schemas.size()))
                        .number(std::uint32_t(channels.size()))
                        .number(std::uint32_t(attachments.size()))
                        .number(std::uint32_t(metadata.size()))
                        .number(std::uint32_t(chunks.size()))
                        .number(chunks.empty() ? 0 : begin)
                        .number(last)
                        .text(byChannel.bytes())
                        .bytes());
}

QByteArray Index::end(std::uint64_t offset) const
{
    const QByteArray dataEnd = recordOf(DataEndOpcode, Fields().number(std::uint32_t(0)).bytes());
    const std::uint64_t summaryBegin = offset + std::uint64_t(dataEnd.size());
    QByteArray summary;
    Fields offsets;
    const auto addGroup = [&](Opcode opcode, const auto &entries, auto recordOfEntry) {
        const std::uint64_t begin = summaryBegin + std::uint64_t(summary.size());
        for (const auto &entry : entries)
            summary += recordOfEntry(entry);
        const std::uint64_t length = summaryBegin + std::uint64_t(summary.size()) - begin;
        if (length > 0)
            offsets.raw(recordOf(SummaryOffsetOpcode,
                                 Fields().number(std::uint8_t(opcode)).number(begin).number(length).bytes()));
    };
    addGroup(SchemaOpcode, schemas, [](const Schema &schema) { return schema.record(); });
    addGroup(ChannelOpcode, channels, [](const Channel &channel) { return channel.record(); });
    addGroup(StatisticsOpcode, std::vector<int>{0}, [this](int) { return statistics(); });
    addGroup(ChunkIndexOpcode, chunks, [](const ChunkEntry &chunk) { return chunk.record(); });
    addGroup(AttachmentIndexOpcode, attachments, [](const NamedEntry &entry) {
        return recordOf(AttachmentIndexOpcode,
                        Fields()
                            .number(entry.offset)
                            .number(entry.length)
                            .number(entry.time)
                            .number(entry.time)
                            .number(entry.dataSize)
                            .text(entry.name)
                            .text(entry.mediaType)
                            .bytes());
    });
    addGroup(MetadataIndexOpcode, metadata, [](const NamedEntry &entry) {
        return recordOf(MetadataIndexOpcode,
                        Fields().number(entry.offset).number(entry.length).text(entry.name).bytes());
    });
    const std::uint64_t offsetsBegin = summaryBegin + std::uint64_t(summary.size());
    summary += offsets.bytes();
    const QByteArray footerHead = Fields()
                                      .number(std::uint8_t(FooterOpcode))
                                      .number(std::uint64_t(20))
                                      .number(summaryBegin)
                                      .number(offsetsBegin)
                                      .bytes();
    const QByteArray checked = summary + footerHead;
    const std::uint32_t crc = crc32(checked.constData(), std::size_t(checked.size()));
    return dataEnd + checked + Fields().number(crc).bytes() + QByteArray(Magic, MagicSize);
}

std::uint16_t channelOf(const Index &index, const QByteArray &topic)
{
    const auto found = std::find_if(index.channels.begin(), index.channels.end(),
                                    [&](const Channel &channel) { return channel.topic == topic; });
    return found == index.channels.end() ? std::uint16_t(0) : found->id;
}

QByteArray messageIndexes(const std::vector<MessageEntry> &messages, std::uint64_t offset, ChunkEntry *chunk)
{
    QMap<std::uint16_t, QByteArray> entries;
    for (const MessageEntry &message : messages) {
        entries[message.channel] += Fields().number(message.time).number(message.offset).bytes();
        ++chunk->counts[message.channel];
    }
    QByteArray records;
    for (auto it = entries.begin(); it != entries.end(); ++it) {
        chunk->indexOffsets.insert(it.key(), offset + std::uint64_t(records.size()));
        records += recordOf(MessageIndexOpcode, Fields().number(it.key()).text(it.value()).bytes());
    }
    chunk->indexLength = std::uint64_t(records.size());
    return records;
}

}  // namespace qplc::mcap
