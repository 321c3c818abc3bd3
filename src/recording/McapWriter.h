// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapIndex.h"

#include <QtCore/QString>

#include <memory>

namespace qplc::mcap {

/// Writes bytes to the end of a file. A test has others, which fail or stall.
class FileSink
{
public:
    virtual ~FileSink();
    /// \return false when not all bytes could be written; then none of them are in the file
    virtual bool append(const QByteArray &bytes, QString *error) = 0;
    /// Keeps room for \a bytes behind the end: an append() of so many does not find the disk full.
    /// \return false when there is not so much room
    virtual bool reserve(std::uint64_t bytes, QString *error);
    /// What was written survives a loss of power. \return false when that is not sure
    virtual bool sync(QString *error) = 0;
    /// [byte]
    virtual std::uint64_t size() const = 0;
    /// A file that is not there yet. \return null, with an error
    static std::unique_ptr<FileSink> create(const QString &file, QString *error);
};

/// Writes a file of messages. Every function that writes returns false when that has failed; the
/// file then ends with what was written before, and the same call may be tried again.
///
/// For one thread.
class Writer
{
public:
    explicit Writer(std::unique_ptr<FileSink> sink);
    ~Writer();

    bool begin(const QByteArray &library, QString *error);
    bool addAttachment(const QByteArray &name, const QByteArray &mediaType, const QByteArray &data, std::uint64_t time,
                       QString *error);
    bool addMetadata(const QByteArray &name, const QMap<QByteArray, QByteArray> &values, QString *error);
    /// \param schemaName  empty: messages have no schema. \return the id of the channel
    std::uint16_t addChannel(const QByteArray &topic, const QByteArray &encoding, const QByteArray &schemaName = {},
                             const QByteArray &schemaEncoding = {}, const QByteArray &schema = {});

    /// Adds a message to the chunk in memory. Messages come in the order of their times.
    /// \param time [ns], \param published [ns]
    void addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, std::uint64_t published,
                    const char *bytes, std::size_t size);
    /// [byte] of the messages in memory, without what each chunk says of their channels
    std::size_t pending() const { return std::size_t(m_chunk.size()) - m_preamble; }
    /// Compresses the messages in memory and writes them.
    bool flush(QString *error);
    bool sync(QString *error) { return m_sink->sync(error); }
    /// Forgets the messages in memory.
    void discard() { beginChunk(); }
    /// Writes what is left, and the summary. Nothing can be written behind it.
    bool finish(QString *error);
    std::uint64_t size() const { return m_sink->size(); }

private:
    bool append(const QByteArray &bytes, QString *error) { return m_sink->append(bytes, error); }
    void makeRecord(ChunkEntry *chunk);
    void beginChunk();
    void addToPreamble(const QByteArray &record);
    std::uint64_t summarySize(const ChunkEntry &next) const;

    struct Compressor;
    std::unique_ptr<FileSink> m_sink;
    std::unique_ptr<Compressor> m_compressor;
    Index m_index;
    QByteArray m_chunk;
    QByteArray m_record;         // of the chunk that is written
    std::size_t m_preamble = 0;  // [byte] of channels and schemas in it
    std::vector<MessageEntry> m_messages;
    std::uint64_t m_chunkIndexSize = 0;  // [byte] of the summary, for the chunks in the file
};

}  // namespace qplc::mcap
