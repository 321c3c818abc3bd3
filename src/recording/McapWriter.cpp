// SPDX-License-Identifier: Apache-2.0
#include "McapWriter.h"

#include "transport/Descriptor.h"

#include <QtCore/QFile>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

namespace qplc::mcap {

namespace {

constexpr std::uint64_t ReservedAtOnce = 1U << 20;                     // [byte]: few calls of the system
constexpr int ChunkHeadSize = RecordHeadSize + 3 * 8 + 4 + 4 + 4 + 8;  // before the bytes of a compressed one
constexpr int LeastRoom = 64 * 1024;                                   // [byte] for messages in memory
constexpr int Level = 1;  // of zstd: 1.57 : 1 for a flight of the example, and 1.60 : 1 with level 3

class DiskFile final : public FileSink
{
public:
    DiskFile(Descriptor descriptor, const QString &name)
        : m_descriptor(std::move(descriptor))
        , m_name(name)
    {
    }
    ~DiskFile() override
    {
        // Without what was reserved.
        [[maybe_unused]] const int cut = ::ftruncate(m_descriptor.number(), off_t(m_size));
    }

    bool append(const QByteArray &bytes, QString *error) override
    {
        int written = 0;
        while (written < bytes.size()) {
            const ssize_t count = ::pwrite(m_descriptor.number(), bytes.constData() + written,
                                           std::size_t(bytes.size() - written), off_t(m_size) + written);
            if (count < 0 && errno == EINTR)
                continue;
            if (count <= 0)
                return fail(QStringLiteral("write"), error);
            written += int(count);
        }
        m_size += std::uint64_t(written);
        return true;
    }
    bool reserve(std::uint64_t bytes, QString *error) override
    {
        if (m_size + bytes <= m_reserved)
            return true;
        int result = allocate(bytes + ReservedAtOnce);
        if (result == ENOSPC)
            result = allocate(bytes);
        errno = result;
        // Other errors: the file system cannot reserve.
        return result != ENOSPC || fail(QStringLiteral("write"), error);
    }
    bool sync(QString *error) override
    {
        return ::fdatasync(m_descriptor.number()) == 0 || fail(QStringLiteral("save"), error);
    }
    std::uint64_t size() const override { return m_size; }

private:
    /// \return an errno value, or 0
    int allocate(std::uint64_t bytes)
    {
        int result = 0;
        do {
            result = ::fallocate(m_descriptor.number(), FALLOC_FL_KEEP_SIZE, 0, off_t(m_size + bytes)) == 0 ? 0 : errno;
        } while (result == EINTR);
        if (result == 0)
            m_reserved = m_size + bytes;
        return result;
    }
    /// What was written in part is cut off.
    bool fail(const QString &what, QString *error)
    {
        *error = QStringLiteral("cannot %1 '%2': %3").arg(what, m_name, qt_error_string(errno));
        [[maybe_unused]] const int cut = ::ftruncate(m_descriptor.number(), off_t(m_size));
        return false;
    }

    Descriptor m_descriptor;
    QString m_name;
    std::uint64_t m_size = 0;
    std::uint64_t m_reserved = 0;  // end of what the file has room for
};

}  // namespace

FileSink::~FileSink() = default;

bool FileSink::reserve(std::uint64_t /*bytes*/, QString * /*error*/)
{
    return true;
}

std::unique_ptr<FileSink> FileSink::create(const QString &file, QString *error)
{
    Descriptor descriptor(::open(QFile::encodeName(file).constData(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (descriptor.isOpen())
        return std::make_unique<DiskFile>(std::move(descriptor), file);
    *error = errno == EEXIST ? QStringLiteral("'%1' is there already; delete it, or choose another name").arg(file)
                             : QStringLiteral("cannot make the file '%1': %2").arg(file, qt_error_string(errno));
    return nullptr;
}

struct Writer::Compressor
{
    Compressor()
        : context(ZSTD_createCCtx())
    {
    }
    ~Compressor() { ZSTD_freeCCtx(context); }
    Compressor(const Compressor &) = delete;
    Compressor &operator=(const Compressor &) = delete;
    ZSTD_CCtx *context;
};

Writer::Writer(std::unique_ptr<FileSink> sink)
    : m_sink(std::move(sink))
    , m_compressor(std::make_unique<Compressor>())
{
    // Buffers that are as large as their largest content stay: new ones cost a page fault for each
    // page.
    m_chunk.reserve(LeastRoom);
    m_record.reserve(LeastRoom);
}

Writer::~Writer() = default;

bool Writer::begin(const QByteArray &library, QString *error)
{
    return append(QByteArray(Magic, MagicSize) + recordOf(HeaderOpcode, Fields().text({}).text(library).bytes()),
                  error);
}

bool Writer::addAttachment(const QByteArray &name, const QByteArray &mediaType, const QByteArray &data,
                           std::uint64_t time, QString *error)
{
    NamedEntry entry;
    const QByteArray record = attachmentRecord(name, mediaType, data, time, size(), &entry);
    if (!m_sink->reserve(std::uint64_t(record.size()) + summarySize({}), error) || !append(record, error))
        return false;
    m_index.attachments.push_back(entry);
    return true;
}

bool Writer::addMetadata(const QByteArray &name, const QMap<QByteArray, QByteArray> &values, QString *error)
{
    const QByteArray record = recordOf(MetadataOpcode, Fields().text(name).texts(values).bytes());
    const NamedEntry entry{name, {}, size(), std::uint64_t(record.size()), 0, 0};
    if (!append(record, error))
        return false;
    m_index.metadata.push_back(entry);
    return true;
}

std::uint16_t Writer::addChannel(const QByteArray &topic, const QByteArray &encoding, const QByteArray &schemaName,
                                 const QByteArray &schemaEncoding, const QByteArray &schemaText)
{
    const auto id = std::uint16_t(m_index.channels.size() + 1);
    const Schema schema{id, schemaName, schemaEncoding, schemaText};
    const bool hasSchema = !schemaName.isEmpty();
    const Channel channel{id, hasSchema ? id : std::uint16_t(0), topic, encoding};
    if (hasSchema) {
        m_index.schemas.push_back(schema);
        addToPreamble(schema.record());
    }
    m_index.channels.push_back(channel);
    addToPreamble(channel.record());
    return id;
}

/// Each chunk can be read without those before it.
void Writer::beginChunk()
{
    m_messages.clear();
    m_chunk.resize(0);
    m_preamble = 0;
    for (const Channel &channel : m_index.channels)
        addToPreamble(channel.record());
}

void Writer::addToPreamble(const QByteArray &record)
{
    m_chunk += record;
    m_preamble += std::size_t(record.size());
}

void Writer::addMessage(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time, std::uint64_t published,
                        const char *bytes, std::size_t size)
{
    m_messages.push_back({channel, time, std::uint64_t(m_chunk.size())});
    char head[RecordHeadSize + MessageHeadSize];
    head[0] = char(MessageOpcode);
    storeLittle(std::uint64_t(MessageHeadSize + size), head + 1);
    storeLittle(channel, head + 9);
    storeLittle(sequence, head + 11);
    storeLittle(time, head + 15);
    storeLittle(published, head + 23);
    m_chunk.append(head, int(sizeof head));
    m_chunk.append(bytes, int(size));
}

/// Makes the record of the messages in memory, in a buffer that stays.
void Writer::makeRecord(ChunkEntry *chunk)
{
    chunk->begin = m_messages.front().time;
    chunk->end = m_messages.back().time;
    chunk->size = std::uint64_t(m_chunk.size());
    const auto size = std::size_t(m_chunk.size());
    m_record.resize(ChunkHeadSize + int(ZSTD_compressBound(size)));
    const std::size_t packed
        = ZSTD_compressCCtx(m_compressor->context, m_record.data() + ChunkHeadSize,
                            std::size_t(m_record.size() - ChunkHeadSize), m_chunk.constData(), size, Level);
    const bool isPacked = ZSTD_isError(packed) == 0;  // without memory for it: as it is
    chunk->compression = isPacked ? "zstd" : "";
    chunk->compressedSize = isPacked ? packed : size;
    chunk->offset = this->size();
    const Fields fields = Fields()
                              .number(chunk->begin)
                              .number(chunk->end)
                              .number(chunk->size)
                              .number(crc32(m_chunk.constData(), size))
                              .text(chunk->compression)
                              .number(chunk->compressedSize);
    const std::uint64_t length = std::uint64_t(fields.bytes().size()) + chunk->compressedSize;
    const QByteArray head = Fields().number(std::uint8_t(ChunkOpcode)).number(length).raw(fields.bytes()).bytes();
    if (isPacked)
        std::memcpy(m_record.data(), head.constData(), std::size_t(head.size()));
    else
        m_record.replace(0, m_record.size(), head + m_chunk);
    m_record.resize(head.size() + int(chunk->compressedSize));
    chunk->length = std::uint64_t(m_record.size());
}

/// At most [byte], with the summary of \a next.
std::uint64_t Writer::summarySize(const ChunkEntry &next) const
{
    constexpr std::uint64_t fixedPart = 4096;  // statistics, offsets, footer, and metadata to come
    std::uint64_t size = fixedPart + m_chunkIndexSize + std::uint64_t(next.record().size());
    for (const Schema &schema : m_index.schemas)
        size += std::uint64_t(schema.record().size());
    for (const Channel &channel : m_index.channels)
        size += std::uint64_t(channel.record().size()) + sizeof(channel.id) + sizeof(next.size);
    const auto add = [&size](const std::vector<NamedEntry> &entries) {
        for (const NamedEntry &entry : entries)
            size += 64 + std::uint64_t(entry.name.size() + entry.mediaType.size());
    };
    add(m_index.attachments);
    add(m_index.metadata);
    return size;
}

bool Writer::flush(QString *error)
{
    if (m_messages.empty())
        return true;
    ChunkEntry chunk;
    makeRecord(&chunk);
    m_record += messageIndexes(m_messages, chunk.offset + chunk.length, &chunk);
    if (!m_sink->reserve(std::uint64_t(m_record.size()) + summarySize(chunk), error) || !append(m_record, error))
        return false;
    m_index.chunks.push_back(chunk);
    m_chunkIndexSize += std::uint64_t(chunk.record().size());
    beginChunk();
    return true;
}

bool Writer::finish(QString *error)
{
    return flush(error) && append(m_index.end(size()), error) && sync(error);
}

}  // namespace qplc::mcap
