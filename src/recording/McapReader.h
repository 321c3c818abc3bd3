// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapIndex.h"

#include <QtCore/QFile>

#include <functional>

namespace qplc::mcap {

struct Message
{
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t time = 0;       // [ns]
    std::uint64_t published = 0;  // [ns]
    const char *bytes = nullptr;
    std::size_t size = 0;
};

struct Attachment
{
    QByteArray name;
    QByteArray mediaType;
    std::uint64_t time = 0;
    QByteArray data;
};

/// What a summary says of the whole file.
struct Outline
{
    std::uint64_t messages = 0;
    std::uint64_t begin = 0;  // time of its first message [ns]
    std::uint64_t end = 0;
    std::vector<NamedEntry> attachments;
};

/// Receives what a scan finds, in the order of the file. Everything in it has been checked against
/// its checksum.
class ScanHandler
{
public:
    virtual ~ScanHandler();
    virtual void attachment(const Attachment & /*attachment*/, const NamedEntry & /*entry*/) {}
    /// \param records  uncompressed
    virtual void chunk(const ChunkEntry & /*entry*/, const QByteArray & /*records*/) {}
    /// \param fields  without a checksum
    virtual void metadata(const QByteArray & /*fields*/, const NamedEntry & /*entry*/) {}
};

/// Builds the index of a file anew.
class Indexer : public ScanHandler
{
public:
    void attachment(const Attachment & /*attachment*/, const NamedEntry &entry) override
    {
        index.attachments.push_back(entry);
    }
    void metadata(const QByteArray & /*fields*/, const NamedEntry &entry) override { index.metadata.push_back(entry); }
    void chunk(const ChunkEntry &entry, const QByteArray &records) override;

    Index index;
    std::vector<QByteArray> indexes;  // of the messages of each chunk

private:
    void add(const Channel &channel);

    std::vector<MessageEntry> messages;
};

/// Reads a file that a Writer has written, or a part of one: cut, damaged or unfinished ones, too.
class Reader
{
public:
    enum End : std::uint8_t {
        Finished,   ///< the file has its footer
        Unfinished  ///< it ends within its messages
    };

    /// \return false when the file is no MCAP file at all
    bool open(const QString &file, QString *error);
    std::uint64_t size() const { return std::uint64_t(m_file.size()); }
    QString fileName() const { return m_file.fileName(); }

    /// The summary at the end of the file. \return false when it is not there, or damaged
    bool readSummary(Index *index);
    /// A few of the bytes of the summary: enough to tell files apart. Their checksum is not
    /// checked.
    /// \return false when they are not there
    bool readOutline(Outline *outline);
    /// As readSummary(), of a file that may be unfinished: then out of a scan of all of it.
    /// \return false when the file is unfinished
    bool readIndex(Index *index);
    /// \return false when it is damaged
    bool readAttachment(const NamedEntry &entry, Attachment *attachment);
    /// Reads the whole file. What is damaged is left out, with all that is not in a chunk which is
    /// whole.
    End scan(ScanHandler &handler);
    /// Of the last scan: end of the last chunk, attachment or metadata that is whole.
    std::uint64_t goodEnd() const { return m_goodEnd; }
    /// Of the last scan: places that are damaged.
    int damages() const { return m_damages; }
    /// The records of a chunk, uncompressed. \return false when it is damaged
    bool readChunk(const ChunkEntry &entry, QByteArray *records);
    /// Bytes of the file. Fewer: it ends there
    QByteArray read(std::uint64_t offset, std::uint64_t size);

private:
    bool handle(std::uint8_t opcode, const QByteArray &content, std::uint64_t offset, ScanHandler &handler);
    std::uint64_t nextChunk(std::uint64_t from);

    QFile m_file;
    std::uint64_t m_goodEnd = 0;
    int m_damages = 0;
};

/// What \a bytes were before they were compressed. \return false when they are damaged, or do not
/// give \a size bytes
bool uncompress(const QByteArray &compression, const char *bytes, std::size_t compressedSize, std::uint64_t size,
                QByteArray *result);
/// A message out of its record. \return false when it is not whole
bool readMessage(FieldReader fields, Message *message);
/// Calls \a found for each message in the records of a chunk, and \a isChannel for each channel.
/// \return false when they are not whole
bool forEachMessage(const QByteArray &records, const std::function<void(const Channel &channel)> &isChannel,
                    const std::function<void(const Message &message, std::uint64_t offset)> &found);
/// As forEachMessage(), for schemas alone.
void forEachSchema(const QByteArray &records, const std::function<void(const Schema &schema)> &found);

}  // namespace qplc::mcap
