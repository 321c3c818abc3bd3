// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantMessage.h"
#include "node/cycle/RecordLayout.h"
#include "node/cycle/RingDescription.h"
#include "node/cycle/RosterText.h"

#include <QtCore/QStringList>

#include <functional>
#include <memory>
#include <vector>

namespace qplc {

/// What a recording says of one cycle. Lasts until the next one.
struct RecordedRow
{
    struct Raw
    {
        std::uint16_t id = 0;
        QByteArray bytes;
    };

    PlantMessage::Cycle cycle;
    std::uint64_t time = 0;                  // nominal, of the cycle [ns]
    const ProcessImage *image = nullptr;     // at the end of the cycle
    const ProcessImage *before = nullptr;    // what inputs were cut from; null: the recording does not have it
    const ProcessImage *previous = nullptr;  // at the end of the cycle before; null: there is none, or it is missing
    const RosterContent *roster = nullptr;   // null: the recording does not know its nodes
    std::vector<RecordedNode> nodes;
    std::vector<Raw> rawOutputs;
    std::vector<Raw> rawInputs;

    const RecordedNode *node(std::uint16_t id) const;
    static const QByteArray *find(const std::vector<Raw> &raw, std::uint16_t id);
};

/// A node takes part in the cycles from `first` on.
struct RecordedStart
{
    std::uint16_t id = 0;
    std::uint64_t first = 0;
    QByteArray outputs;  // initial ones, as it has sent them
    QByteArray inputs;   // initial ones, as it was given them
};

/// Reads a recording from its first cycle to its last: a file, or the files of a phase.
class RecordedCycles
{
public:
    /// Receives what is in a recording, in its order. Each function returns false when it wants no
    /// more.
    class Reader
    {
    public:
        virtual ~Reader();
        /// Comes first.
        virtual bool begin(const RingDescription &description, const QPlcSignalTable &table) = 0;
        virtual bool joined(const RecordedStart & /*start*/) { return true; }
        virtual bool cycle(const RecordedRow &row) = 0;
        /// Cycles from \a first to \a last are not in the recording.
        virtual bool gap(std::uint64_t /*first*/, std::uint64_t /*last*/) { return true; }
        /// The phase is over.
        virtual bool ended() { return true; }
    };

    /// \param files  of one phase, in their order. Cycles that two of them have are read once
    /// \return false when one of them cannot be read, is no recording, or is damaged
    static bool read(const QStringList &files, Reader &reader, QString *error);
};

}  // namespace qplc
