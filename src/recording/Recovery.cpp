// SPDX-License-Identifier: Apache-2.0
#include "Recovery.h"

#include "McapReader.h"

#include <unistd.h>

namespace qplc {

namespace {

using namespace mcap;

/// Builds the index of a file anew.
class Indexer final : public ScanHandler
{
public:
    void attachment(const Attachment & /*attachment*/, const NamedEntry &entry) override
    {
        index.attachments.push_back(entry);
    }
    void metadata(const QByteArray & /*fields*/, const NamedEntry &entry) override { index.metadata.push_back(entry); }
    void chunk(const ChunkEntry &entry, const QByteArray &records) override
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

    Index index;
    std::vector<QByteArray> indexes;  // of the messages of each chunk

private:
    void add(const Channel &channel)
    {
        for (const Channel &known : index.channels) {
            if (known.id == channel.id)
                return;
        }
        index.channels.push_back(channel);
    }

    std::vector<MessageEntry> messages;
};

void forgetIndex(ChunkEntry *chunk)
{
    chunk->indexOffsets.clear();
    chunk->indexLength = 0;
}

/// Messages of chunks in the middle of the file have their index behind the chunk, or none.
void compareIndexes(QFile &file, Indexer *indexer)
{
    for (std::size_t i = 0; i < indexer->index.chunks.size(); ++i) {
        ChunkEntry &chunk = indexer->index.chunks[i];
        const QByteArray &wanted = indexer->indexes[i];
        if (!file.seek(qint64(chunk.offset + chunk.length)) || file.read(wanted.size()) != wanted)
            forgetIndex(&chunk);
    }
}

}  // namespace

bool recoverRecording(const QString &fileName, RecoveredFile *result, QString *error)
{
    *result = {};
    Reader reader;
    if (!reader.open(fileName, error))
        return false;
    Index known;
    if (reader.readSummary(&known)) {
        result->wasFinished = true;
        result->chunks = known.chunks.size();
        return true;
    }
    Indexer indexer;
    reader.scan(indexer);
    result->chunks = indexer.index.chunks.size();
    result->damages = reader.damages();
    result->lostBytes = reader.size() - reader.goodEnd();
    QFile file(fileName);
    const auto failed = [&] {
        *error = QStringLiteral("cannot finish the recording '%1': %2").arg(fileName, file.errorString());
        return false;
    };
    if (!file.open(QIODevice::ReadWrite))
        return failed();
    QByteArray end;
    const bool endsWithChunk = !indexer.index.chunks.empty()
        && indexer.index.chunks.back().offset + indexer.index.chunks.back().length == reader.goodEnd();
    if (endsWithChunk)
        end = indexer.indexes.back();
    if (!file.resize(qint64(reader.goodEnd())) || !file.seek(file.size()) || file.write(end) != end.size())
        return failed();
    compareIndexes(file, &indexer);
    const QByteArray summary = indexer.index.end(std::uint64_t(file.size()));
    if (!file.seek(file.size()) || file.write(summary) != summary.size() || !file.flush()
        || ::fdatasync(file.handle()) != 0)
        return failed();
    return true;
}

}  // namespace qplc
