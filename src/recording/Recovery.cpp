// SPDX-License-Identifier: Apache-2.0
#include "Recovery.h"

#include "Overview.h"
#include "node/cycle/RingDescription.h"

#include <memory>

#include <unistd.h>

namespace qplc {

namespace {

using namespace mcap;

/// Builds index and overview of a file anew.
class Rebuilder final : public Indexer
{
public:
    void attachment(const Attachment &attachment, const NamedEntry &entry) override
    {
        Indexer::attachment(attachment, entry);
        if (attachment.name == overview::Name)
            m_hasOverview = true;
        if (attachment.name != "recording.txt" || !RingDescription::fromText(attachment.data, &m_description))
            return;
        QVector<QPlcParseError> errors;
        const QPlcSignalTable table = QPlcSignalTable::fromIni(m_description.table, &errors);
        if (!errors.isEmpty())
            return;
        m_message = std::make_unique<PlantMessage>(table);
        m_overview = std::make_unique<overview::Builder>(m_message->image());
    }
    void chunk(const ChunkEntry &entry, const QByteArray &records) override
    {
        Indexer::chunk(entry, records);
        if (m_overview)
            m_overview->addChunk(records, channelOf(index, "/plant"), m_description.period, m_message.get());
    }
    /// The attachment that stands at \a offset. Empty: it is there, or there are no cycles
    QByteArray overviewAt(std::uint64_t offset)
    {
        if (m_hasOverview || !m_overview || m_overview->isEmpty())
            return {};
        return attachmentRecord(overview::Name, overview::MediaType, m_overview->bytes(), index.chunks.back().end,
                                offset, &index.attachments.emplace_back());
    }

private:
    RingDescription m_description;
    std::unique_ptr<PlantMessage> m_message;
    std::unique_ptr<overview::Builder> m_overview;
    bool m_hasOverview = false;
};

void forgetIndex(ChunkEntry *chunk)
{
    chunk->indexOffsets.clear();
    chunk->indexLength = 0;
}

/// Messages of chunks in the middle of the file have their index behind the chunk, or none.
void compareIndexes(QFile &file, Rebuilder *indexer)
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
    Rebuilder indexer;
    reader.scan(indexer);
    result->chunks = indexer.index.chunks.size();
    result->damages = reader.damages();
    result->lostBytes = reader.size() - reader.goodEnd();
    result->hasNothing = indexer.index.chunks.empty() && indexer.index.attachments.empty();
    if (result->hasNothing) {
        *error
            = QStringLiteral("'%1' has nothing whole to finish: no description of a plant, and no cycle; it stays as "
                             "it is")
                  .arg(fileName);
        return false;
    }
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
    const QByteArray overview = indexer.overviewAt(std::uint64_t(file.size()));
    const QByteArray rest = overview + indexer.index.end(std::uint64_t(file.size() + overview.size()));
    if (!file.seek(file.size()) || file.write(rest) != rest.size() || !file.flush() || ::fdatasync(file.handle()) != 0)
        return failed();
    return true;
}

}  // namespace qplc
