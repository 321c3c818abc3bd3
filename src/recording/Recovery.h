// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QString>

namespace qplc {

/// What recoverRecording() has found.
struct RecoveredFile
{
    bool wasFinished = false;
    quint64 chunks = 0;
    quint64 lostBytes = 0;    // behind the last chunk that is whole
    int damages = 0;          // places within the file that are damaged
    bool hasNothing = false;  // no description of a plant, and no chunk: it stays as it is
};

/// Finishes a recording whose recorder was ended before it could: cuts off what is not whole at its
/// end, and writes the summary. Other programs can then open it. A recording that is finished stays
/// as it is. After an interruption, the next call begins anew.
/// \return false when the file cannot be read or written, is no recording, or has nothing
bool recoverRecording(const QString &file, RecoveredFile *result, QString *error);

}  // namespace qplc
