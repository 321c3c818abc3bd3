// SPDX-License-Identifier: Apache-2.0
#include "RecordedPhases.h"

#include "McapReader.h"
#include "RecordingFolder.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>

#include <algorithm>
#include <tuple>

namespace qplc {

namespace {

struct FoundFile
{
    QString path;
    RingDescription description;
    quint64 begin = 0;  // of its first message [ns]

    auto phase() const { return std::make_tuple(description.plant, description.session, description.phase); }
};

/// Reads a few bytes of a file that is finished, and all of another one.
bool readFile(const QString &path, FoundFile *file, QString *error)
{
    mcap::Reader reader;
    if (!reader.open(path, error))
        return false;
    mcap::Outline outline;
    if (!reader.readOutline(&outline)) {
        mcap::Index index;
        reader.readIndex(&index);
        outline.attachments = index.attachments;
        outline.begin = index.chunks.empty() ? 0 : index.chunks.front().begin;
    }
    file->path = path;
    file->begin = outline.begin;
    for (const mcap::NamedEntry &entry : outline.attachments) {
        mcap::Attachment text;
        if (entry.name == "recording.txt" && reader.readAttachment(entry, &text)
            && RingDescription::fromText(text.data, &file->description))
            return true;
    }
    *error = QStringLiteral("'%1' has no description of a plant: it is not a recording of QtPLC, or damaged at its "
                            "begin")
                 .arg(path);
    return false;
}

QStringList filesIn(const QString &folder)
{
    QStringList paths;
    const QDir dir(folder);
    const QStringList names
        = dir.entryList({QStringLiteral("*.mcap"), QStringLiteral("*.mcap.part")}, QDir::Files, QDir::Name);
    for (const QString &name : names)
        paths << dir.filePath(name);
    return paths;
}

}  // namespace

QString RecordedPhase::name() const
{
    if (files.size() == 1)
        return files.constFirst();
    return QStringLiteral("%1, phase %2 of session %3, %4 files")
        .arg(QFileInfo(files.value(0)).path())
        .arg(description.phase)
        .arg(QString::number(description.session, 16))
        .arg(files.size());
}

bool isInFolderOfRecordings(const QString &path)
{
    const QFileInfo info(path);
    if (info.isDir())
        return true;
    const QVector<RecordingFolder::File> files = RecordingFolder::files(info.path());
    return std::any_of(files.begin(), files.end(), [&](const RecordingFolder::File &file) {
        return QFileInfo(file.path).fileName() == info.fileName();
    });
}

bool findPhases(const QString &folder, QVector<RecordedPhase> *phases, QString *error)
{
    phases->clear();
    std::vector<FoundFile> found;
    const QStringList paths = filesIn(folder);
    for (const QString &path : paths) {
        if (!readFile(path, &found.emplace_back(), error))
            return false;
    }
    if (found.empty()) {
        *error = QStringLiteral("the folder '%1' has no recording: no file there ends with .mcap").arg(folder);
        return false;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const FoundFile &a, const FoundFile &b) { return a.begin < b.begin; });
    std::vector<FoundFile> firsts;  // of each phase
    for (const FoundFile &file : found) {
        const auto known = std::find_if(firsts.begin(), firsts.end(),
                                        [&](const FoundFile &first) { return first.phase() == file.phase(); });
        if (known == firsts.end()) {
            firsts.push_back(file);
            phases->append({file.description, {file.path}});
        } else {
            (*phases)[int(known - firsts.begin())].files << file.path;
        }
    }
    return true;
}

bool findPhase(const QString &path, RecordedPhase *phase, QString *error)
{
    FoundFile file;
    if (!isInFolderOfRecordings(path)) {
        const bool isRead = readFile(path, &file, error);
        *phase = {file.description, {path}};
        return isRead;
    }
    const bool isFolder = QFileInfo(path).isDir();
    QVector<RecordedPhase> phases;
    if (!findPhases(isFolder ? path : QFileInfo(path).path(), &phases, error))
        return false;
    for (const RecordedPhase &each : qAsConst(phases)) {
        const bool hasIt = std::any_of(each.files.begin(), each.files.end(), [&](const QString &name) {
            return QFileInfo(name).fileName() == QFileInfo(path).fileName();
        });
        if (isFolder || hasIt)
            *phase = each;  // the last of a folder
    }
    return true;
}

}  // namespace qplc
