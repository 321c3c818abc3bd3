// SPDX-License-Identifier: Apache-2.0
#include "RecordedPhases.h"

#include "RecordedFile.h"
#include "RecordingFolder.h"

#include <QtCore/QFileInfo>

#include <algorithm>
#include <tuple>

namespace qplc {

namespace {

auto phaseOf(const RingDescription &description)
{
    return std::make_tuple(description.plant, description.session, description.phase);
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

bool findPhases(const QString &folder, QVector<RecordedPhase> *phases, QStringList *unreadable, QString *error)
{
    phases->clear();
    std::vector<RecordedFile> found;
    const QStringList paths = filesIn(folder, {QStringLiteral("*.mcap"), QStringLiteral("*.mcap.part")});
    for (const QString &path : paths) {
        if (found.emplace_back().open(path, error))
            continue;
        *unreadable << *error;
        found.pop_back();
    }
    if (found.empty()) {
        if (paths.isEmpty())
            *error = whyNoRecording(folder);
        return false;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const RecordedFile &a, const RecordedFile &b) { return a.begin < b.begin; });
    for (const RecordedFile &file : found) {
        const auto known = std::find_if(phases->begin(), phases->end(), [&](const RecordedPhase &phase) {
            return phaseOf(phase.description) == phaseOf(file.description);
        });
        if (known == phases->end())
            phases->append({file.description, {file.name}});
        else
            known->files << file.name;
    }
    return true;
}

bool findPhase(const QString &path, RecordedPhase *phase, QStringList *unreadable, QString *error)
{
    if (!isInFolderOfRecordings(path)) {
        RecordedFile file;
        const bool isRead = file.open(path, error);
        *phase = {file.description, {path}};
        return isRead;
    }
    const bool isFolder = QFileInfo(path).isDir();
    QVector<RecordedPhase> phases;
    if (!findPhases(isFolder ? path : QFileInfo(path).path(), &phases, unreadable, error))
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
