// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"
#include "recording/OutputFile.h"
#include "recording/Recording.h"

#include <QtCore/QJsonObject>

#include <memory>

namespace tools {

/// Opens a recording: a file, or a folder, of which files that are not recordings are left out. Its
/// notes are printed. \return false, with the message out
bool openRecording(const CommandCall &call, const QString &path, qplc::Recording *recording);
/// The times of --from and --to: seconds since the begin of the recording, or a moment as
/// 2026-11-20T14:03:12 (UTC). \return false, with the message out
bool readTimes(const CommandCall &call, const qplc::Recording &recording, qplc::RecordedTime *begin,
               qplc::RecordedTime *end);
/// The signals of --signals, names and patterns with commas between them. \return false, with the
/// message out
bool readSignals(const CommandCall &call, const qplc::Recording &recording, std::vector<int> *numbers);
/// The file of --output, which is open. \return null, with the message out: it cannot be written,
/// it is there and --force is missing, or it is a file of the recording
std::unique_ptr<qplc::OutputFile> openOutput(const CommandCall &call, const qplc::Recording &recording);
/// Says what was written: the name of the file and \a facts, or "FILE: text". Not if the file is
/// the standard output.
void printWritten(const CommandCall &call, QJsonObject facts, const QString &text);
/// Writes the message for so many damaged chunks, if there are any. \return the exit code: a
/// failure also if files were left out
int exitCodeOf(const qplc::Recording &recording, int damages);

}  // namespace tools
