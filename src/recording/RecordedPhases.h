// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RingDescription.h"

#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// The files that have the cycles of one phase.
struct RecordedPhase
{
    RingDescription description;
    QStringList files;  // in the order of their cycles

    /// For people: the file, or which phase of the folder.
    QString name() const;
};

/// Whether \a path is a folder, or a file in one that a recorder has made: its phase may have other
/// files there.
bool isInFolderOfRecordings(const QString &path);

/// The phases whose recordings are in a folder, in the order of their times.
/// \param unreadable  gets a sentence for each file that cannot be read, and is left out
/// \return false when there are none
bool findPhases(const QString &folder, QVector<RecordedPhase> *phases, QStringList *unreadable, QString *error);

/// The phase that \a path stands for: a file alone; a file of a folder with the other files of its
/// phase; the newest phase of a folder.
/// \param unreadable  as that of findPhases(), of the folder
/// \return false when the folder has no recording, or the file cannot be read
bool findPhase(const QString &path, RecordedPhase *phase, QStringList *unreadable, QString *error);

}  // namespace qplc
