// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapReader.h"
#include "node/cycle/RingDescription.h"

#include <QtCore/QStringList>

#include <optional>
#include <vector>

namespace qplc {

using RecordedTime = std::int64_t;  // nominal time of a cycle [ns]: docs/recording.md

/// A file of a recording.
struct RecordedFile
{
    QString name;
    RingDescription description;
    int layout = 0;          // in the Recording that has this file
    RecordedTime begin = 0;  // of its first message
    RecordedTime end = 0;    // of its last message
    bool isFinished = false;
    bool isEmpty = true;  // it has no message
    std::vector<mcap::NamedEntry> attachments;
    std::optional<mcap::Index> index;  // read when it is needed

    /// Reads a few bytes of a file that is finished, and all of another one.
    /// \return false when it is no recording
    bool open(const QString &file, QString *error);
    /// Why a file is not a recording.
    static QString unknownText(const QString &file);
    /// \return null when there is none of this name
    const mcap::NamedEntry *attachment(const char *wanted) const;
};

/// The paths of the files in a folder whose names match, in the order of their names.
QStringList filesIn(const QString &folder, const QStringList &patterns);
/// Why no recording is found in a folder, for people.
QString whyNoRecording(const QString &folder);

}  // namespace qplc
