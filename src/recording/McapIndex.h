// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapFormat.h"

#include <vector>

namespace qplc::mcap {

struct Schema
{
    std::uint16_t id = 0;
    QByteArray name;
    QByteArray encoding;
    QByteArray text;

    QByteArray record() const;
    static bool read(FieldReader fields, Schema *schema);
};

struct Channel
{
    std::uint16_t id = 0;
    std::uint16_t schema = 0;  // 0: none
    QByteArray topic;
    QByteArray encoding;

    QByteArray record() const;
    static bool read(FieldReader fields, Channel *channel);
};

/// Of a message in a chunk.
struct MessageEntry
{
    std::uint16_t channel = 0;
    std::uint64_t time = 0;
    std::uint64_t offset = 0;  // in the uncompressed chunk
};

/// A chunk, and where it and the index of its messages are.
struct ChunkEntry
{
    std::uint64_t begin = 0;  // time of its first message [ns]
    std::uint64_t end = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    QMap<std::uint16_t, std::uint64_t> indexOffsets;  // by channel
    std::uint64_t indexLength = 0;
    QByteArray compression;
    std::uint64_t compressedSize = 0;
    std::uint64_t size = 0;
    QMap<std::uint16_t, std::uint64_t> counts;  // messages by channel; not in the file

    QByteArray record() const;
    static bool read(FieldReader fields, ChunkEntry *entry);
};

/// An attachment or metadata.
struct NamedEntry
{
    QByteArray name;
    QByteArray mediaType;  // of an attachment
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::uint64_t time = 0;
    std::uint64_t dataSize = 0;
};

/// The record of an attachment that stands at \a offset of the file, and its entry.
QByteArray attachmentRecord(const QByteArray &name, const QByteArray &mediaType, const QByteArray &data,
                            std::uint64_t time, std::uint64_t offset, NamedEntry *entry);

/// All that the summary at the end of a file says.
struct Index
{
    std::vector<Schema> schemas;
    std::vector<Channel> channels;
    std::vector<ChunkEntry> chunks;
    std::vector<NamedEntry> attachments;
    std::vector<NamedEntry> metadata;

    /// Data end, summary, footer and magic of a file whose data end at \a offset.
    QByteArray end(std::uint64_t offset) const;

private:
    QByteArray statistics() const;
};

/// The id of the channel of a \a topic. 0: there is none
std::uint16_t channelOf(const Index &index, const QByteArray &topic);

/// The index of the messages of a chunk that ends at \a offset: a record for each channel.
QByteArray messageIndexes(const std::vector<MessageEntry> &messages, std::uint64_t offset, ChunkEntry *chunk);

}  // namespace qplc::mcap
