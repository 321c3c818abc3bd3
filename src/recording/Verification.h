// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecordedPhases.h"

#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QVector>

namespace qplc {

/// What verifyRecording() has found in a recording.
struct VerifiedFile
{
    struct Gap
    {
        quint64 first = 0;
        quint64 last = 0;
    };

    RingDescription description;
    bool isFinished = false;  // the file has its summary
    bool hasEnd = false;      // of the phase
    bool continues = false;   // other files have the cycles before `from`
    quint64 from = 0;         // cycle with which this file begins
    quint64 fromDigest = 0;   // of the cycles before `from`
    quint64 next = 0;         // cycle that comes behind this file
    quint64 cycles = 0;
    quint64 firstCycle = 0;
    quint64 lastCycle = 0;
    quint64 skipped = 0;        // cycles that the master has left out, of all
    QVector<Gap> gaps;          // that the recording itself names
    quint64 missing = 0;        // cycles in them
    quint64 digest = 0;         // of the images in the file
    quint64 checkedCycles = 0;  // up to which the digest was found to be that of the flight
    QStringList problems;       // why it does not prove that all is there; empty: it does

    bool isComplete() const { return problems.isEmpty() && gaps.isEmpty() && hasEnd; }
};

/// What verifyPhase() has found in the files of a phase.
struct VerifiedPhase
{
    RecordedPhase phase;
    bool hasEnd = false;  // of the phase
    quint64 cycles = 0;
    quint64 firstCycle = 0;
    quint64 lastCycle = 0;
    quint64 skipped = 0;                 // cycles that the master has left out
    QVector<VerifiedFile::Gap> gaps;     // in files, and between two of them
    quint64 missing = 0;                 // cycles in them
    QVector<VerifiedFile::Gap> deleted;  // before the first file, and behind marked files that were left when others
                                         // were deleted
    quint64 digest = 0;                  // of the last file
    QStringList problems;                // why it does not prove that all is there; empty: it does

    bool isComplete() const { return problems.isEmpty() && gaps.isEmpty() && hasEnd; }
};

/// Verifies the files of a phase, and that each one goes on where the one before has ended.
VerifiedPhase verifyPhase(const RecordedPhase &phase);

/// Reads a whole recording: computes the digest of its images, and compares it with the digest of
/// the flight, which the recorder has written beside them.
/// \return false when the file cannot be read, or is no recording
bool verifyRecording(const QString &file, VerifiedFile *result, QString *error);

}  // namespace qplc
