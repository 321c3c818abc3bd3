// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapWriter.h"
#include "Overview.h"
#include "PlantMessage.h"
#include "node/cycle/RingDescription.h"
#include "node/cycle/RingReader.h"

#include <array>
#include <deque>
#include <memory>
#include <utility>

namespace qplc {

/// Writes the records of a ring into a recording: docs/recording.md says what is in it.
///
/// A phase may be cut into several files: finish() and begin() again.
///
/// What is in memory goes into the file when it is large enough, or when the caller wants that;
/// only then the ring may replace it. For one thread.
class PlantRecorder
{
public:
    enum Progress : std::uint8_t {
        Recorded,   ///< records were taken out of the ring
        Waiting,    ///< there is none yet
        Ended,      ///< the phase is over, and all of it is in the file
        Abandoned,  ///< the master has ended without an end of the phase, and all of it is in the file
        CutEnded,   ///< as Ended, of a part that a master has kept
        Failed      ///< the file could not be written: the ring keeps the records, try again
    };

    /// Why cycles are worth to be kept.
    enum Trigger : std::uint8_t {
        SafeStop = 1,  ///< the master has stopped safely
        Fault = 2,     ///< the code of a node has failed
        Mark = 4       ///< somebody wants it
    };
    /// Cycles up to which a file has all.
    struct Position
    {
        std::uint64_t next = 0;    // cycle that comes next
        std::uint64_t digest = 0;  // before it
    };

    PlantRecorder();
    ~PlantRecorder();

    /// Becomes the recorder of the ring \a ringFile. \return false when there is another one, or it
    /// is no ring
    bool attach(const QByteArray &ringFile, QString *error);
    /// Another file has the cycles of this phase before \a position: they are left out.
    void goOnFrom(const Position &position);
    Position position() const { return {m_next, m_digest}; }
    /// The recording goes into \a sink, from the next cycle on. \return false when it cannot be
    /// written: then call it again, with another one
    bool begin(std::unique_ptr<mcap::FileSink> sink, QString *error);
    /// Takes what is in the ring, but not more than fits into a chunk.
    Progress proceed(QString *error);
    /// Puts what is in memory into the file, and has the ring replace it. \param sync  see FileSink
    bool save(bool sync, QString *error);
    /// Completes the file. Records that come later go into the next one.
    bool finish(QString *error);
    /// Completes the file without what is in memory, for which the disk has no room. The ring keeps
    /// it, for the next recorder.
    bool cut(QString *error);
    bool hasFile() const { return m_writer != nullptr; }
    /// Records no more from the ring.
    void detach() { m_reader.detach(); }
    /// Deletes the ring, whose records are all in the file.
    void removeRing() { m_reader.memory().remove(); }
    /// Tells the master what this recorder does.
    void report(const RecorderReport &report) { m_reader.report(report); }
    QByteArray ringFile() { return m_reader.memory().file(); }
    /// What has begun since the last call, of Trigger.
    std::uint8_t takeTriggers() { return std::exchange(m_triggers, std::uint8_t(0)); }
    /// Whether the ring is a part of another one, which a master has kept.
    bool isCut() { return m_reader.memory().header()->isCut.load() != 0; }

    const RingDescription &description() const { return m_description; }
    std::uint64_t cycles() const { return m_cycles; }    // of this file, or in memory
    std::uint64_t missing() const { return m_missing; }  // of those of this file: that have no record
    std::uint64_t bytes() const { return m_writer ? m_writer->size() : 0; }

private:
    void add();
    void addCycle();
    void addNodes(const CycleView &view);
    void addRaw(const CycleView &view);
    std::uint64_t timeOf(std::uint64_t cycle) const
    {
        return std::uint64_t(m_startTime) + cycle * std::uint64_t(m_description.period);
    }
    bool addRoster();
    bool addJoin();
    void addTexts(std::uint64_t before);
    void addLastTexts();
    void addHappening(const RecordedText &text, std::uint64_t cycle, QByteArray body);
    void addLost(std::uint64_t number);
    std::uint64_t cycleOf(const RecordedText &text) const;
    bool isAdopted(const RecordedText &text) const;
    bool waitsForLastText();
    void addText(std::uint16_t channel, std::uint32_t sequence, const QByteArray &body);
    void addGap(const RecordedGap &gap);
    void addEnd(const RecordedEnd &end);
    void addDigest(const QByteArray &more);
    void addOverview();
    void keepInitialValues(const char *image);
    bool isChunkFull() const;
    void watch(const CycleView &view);

    RingReader m_reader;
    RingDescription m_description;
    std::unique_ptr<PlantMessage> m_message;
    std::unique_ptr<mcap::Writer> m_writer;
    std::unique_ptr<overview::Builder> m_overview;  // null: it has been written
    std::uint16_t m_plant = 0;                      // channels
    std::uint16_t m_before = 0;
    std::uint16_t m_nodes = 0;
    std::uint16_t m_raw = 0;
    std::uint16_t m_rawInputs = 0;
    std::uint16_t m_joins = 0;
    std::uint16_t m_rosters = 0;
    std::uint16_t m_gaps = 0;
    std::uint16_t m_digests = 0;
    std::array<std::uint16_t, 4> m_happenings{};  // by RecordedText::Topic
    QByteArray m_body;
    QByteArray m_exchange;  // of the newest message of /nodes
    QByteArray m_roster;    // newest message of /rosters
    QByteArray m_initial;   // values before the first cycle, that are not in the file yet
    std::uint32_t m_rosterNumber = 0;
    std::deque<RecordedSettings> m_adoptions;  // the newest ones
    std::uint64_t m_lastText = 0;              // number
    bool m_hasLastText = false;
    bool m_isLast = false;  // no other cycle will come
    int m_looksForText = 0;
    std::uint64_t m_next = 0;    // cycle that comes next
    std::uint64_t m_digest = 0;  // after the newest cycle
    std::uint64_t m_cycles = 0;
    std::uint64_t m_missing = 0;
    std::int64_t m_startTime = 0;  // of cycle 0 [ns since 1970]
    std::uint64_t m_time = 0;      // of the newest cycle [ns]
    bool m_hasDigest = true;       // of the newest cycle, in the file
    bool m_isOver = false;
    bool m_isDamaged = false;
    bool m_hasEndMetadata = false;  // in the file
    bool m_isSafe = false;          // in the newest cycle
    std::uint32_t m_faulted = 0;    // nodes, in the newest cycle
    std::uint8_t m_triggers = 0;
    std::uint32_t m_marks = 0;  // of those in the header of the ring
};

}  // namespace qplc
