// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantValues.h"

#include <QtCore/QString>

#include <atomic>
#include <limits>
#include <optional>

namespace qplc {

/// What to read of the past of a plant that runs.
struct PastWish
{
    using Time = PlantValues::Time;
    /// Of the phase whose cycles the window hears: one of them.
    struct Seam
    {
        quint64 cycle = 0;
        Time time = 0;       // on the clock of the window [ns]
        Time cycleZero = 0;  // on that of recordings [ns]; 0: the phase is not timed
    };

    QPlcSignalTable table;
    Time period = 1;      // [ns]
    quint64 session = 0;  // of the master
    /// Between two rows that the window has heard, on its clock [ns].
    Time after = std::numeric_limits<Time>::min();
    Time before = 0;
    std::optional<Seam> seam;
    std::optional<Seam> lost;  // the row at `after`, if it is of a phase of this session that is known
    /// When the phase of the seam has begun, on the clock of the window [ns].
    Time begun() const { return seam ? seam->time - Time(seam->cycle) * period : before; }
    /// Of the phase of the seam, cycles before it were heard before the gap. All
    /// phases that are not timed look the same: a larger number is taken for the same phase.
    quint64 heardCycles() const
    {
        const bool isSame = seam && lost && seam->cycleZero == lost->cycleZero && lost->cycle < seam->cycle;
        return isSame ? lost->cycle : 0;
    }
    bool isBetweenRows() const { return after != std::numeric_limits<Time>::min(); }
    QString file;  // that the recorder writes, as the master tells it; empty: nobody records
};

/// What a plant has done before a window was there, or while it was not connected.
struct Past
{
    PlantValues values;     // of the table; its store is empty if nothing was found
    bool goesOn = false;    // the oldest row is the cycle behind the row that was heard before
    bool isJoined = false;  // the newest row is the cycle before the first row that is there
    bool isLate = false;    // cycles of the phase of the seam before that row are in no file or ring yet
    bool hasFiles = false;  // rows are of recordings, not of the ring alone
    bool isWhole() const { return goesOn && isJoined; }
    QString problem;  // why recordings cannot be read, for people; empty: they can
};

/// Reads the recordings of this session of the master out of the folder of its recorder, and what
/// is in no file yet out of the ring of the master. Whatever \a wish names, it ends within
/// LongestReading, and takes no more memory than a store and a chunk of a recording: the oldest
/// rows go.
///
/// Only files whose session is that of the wish are shown. So a master that runs on another
/// computer, or tells a wrong name, gets nothing but the sentence in `problem`.
/// \threadsafe yes
/// \param isUnwanted  ends it early
Past readPast(const PastWish &wish, const std::atomic<bool> &isUnwanted);

/// What is kept of a plant whose recordings can be read.
constexpr PlantValues::Budget RecordedBudget{3'600'000'000'000, PlantValues::Budget().memory};
constexpr int LongestReading = 60;                         // [s]
constexpr qint64 LargestUnfinishedFile = qint64(1) << 29;  // [byte]: all of it has to be read to find its end
constexpr std::size_t MostFilesOfPast = 512;               // the newest ones

}  // namespace qplc
