// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Commands.h"
#include "recording/Recording.h"

namespace tools {

/// Opens the recording that the first argument names: a file or a folder. Its notes are printed.
/// \return false, with the message out
bool openRecording(const CommandCall &call, qplc::Recording *recording);
/// The times of --from and --to: seconds since the begin of the recording, or a moment as
/// 2026-11-20T14:03:12 (UTC). \return false, with the message out
bool readTimes(const CommandCall &call, const qplc::Recording &recording, qplc::RecordedTime *begin,
               qplc::RecordedTime *end);
/// The signals of --signals, names and patterns with commas between them. \return false, with the
/// message out
bool readSignals(const CommandCall &call, const qplc::Recording &recording, std::vector<int> *numbers);
/// Writes the message for so many damaged chunks, if there are any. \return the exit code
int exitCodeOf(int damages);

}  // namespace tools
