// SPDX-License-Identifier: Apache-2.0
#include "RecordedFile.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>

#include <algorithm>

namespace qplc {

bool RecordedFile::open(const QString &file, QString *error)
{
    mcap::Reader reader;
    if (!reader.open(file, error))
        return false;
    name = file;
    mcap::Outline outline;
    isFinished = reader.readOutline(&outline);
    if (!isFinished) {
        index.emplace();
        isFinished = reader.readIndex(&*index);
        outline.attachments = index->attachments;
        outline.messages = index->chunks.empty() ? 0 : 1;
        outline.begin = index->chunks.empty() ? 0 : index->chunks.front().begin;
        for (const mcap::ChunkEntry &chunk : index->chunks)
            outline.end = std::max(outline.end, chunk.end);
    }
    attachments = std::move(outline.attachments);
    isEmpty = outline.messages == 0;
    begin = RecordedTime(outline.begin);
    end = RecordedTime(outline.end);
    const mcap::NamedEntry *entry = attachment("recording.txt");
    mcap::Attachment text;
    if (entry && reader.readAttachment(*entry, &text) && RingDescription::fromText(text.data, &description))
        return true;
    *error = unknownText(file);
    return false;
}

QString RecordedFile::unknownText(const QString &file)
{
    return QStringLiteral("'%1' has no description of a plant: it is not a recording of QtPLC, or damaged at its begin")
        .arg(file);
}

const mcap::NamedEntry *RecordedFile::attachment(const char *wanted) const
{
    const auto found = std::find_if(attachments.begin(), attachments.end(),
                                    [wanted](const mcap::NamedEntry &entry) { return entry.name == wanted; });
    return found == attachments.end() ? nullptr : &*found;
}

QStringList filesIn(const QString &folder, const QStringList &patterns)
{
    const QDir dir(folder);
    QStringList paths;
    const QStringList names = dir.entryList(patterns, QDir::Files, QDir::Name);
    for (const QString &name : names)
        paths << dir.filePath(name);
    return paths;
}

QString whyNoRecording(const QString &folder)
{
    const QFileInfo info(folder);
    return info.isReadable() && info.isExecutable()
        ? QStringLiteral("the folder '%1' has no recording: no file there ends with .mcap").arg(folder)
        : QStringLiteral("cannot read the folder '%1': permission denied").arg(folder);
}

}  // namespace qplc
