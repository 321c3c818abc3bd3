// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapWriter.h"
#include "Overview.h"
#include "PlantMessage.h"
#include "node/cycle/RingDescription.h"
#include "node/cycle/RingReader.h"

#include <memory>

namespace qplc {

/// Writes the records of a ring into a recording: docs/recording.md says what is in it.
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
        Failed      ///< the file could not be written: the ring keeps the records, try again
    };

    PlantRecorder();
    ~PlantRecorder();

    /// Becomes the recorder of the ring \a ringFile. \return false when there is another one, or it
    /// is no ring
    bool attach(const QByteArray &ringFile, QString *error);
    /// The recording goes into \a sink. \return false when it cannot be written
    bool begin(std::unique_ptr<mcap::FileSink> sink, QString *error);
    /// Takes what is in the ring, but not more than fits into a chunk.
    Progress proceed(QString *error);
    /// Puts what is in memory into the file, and has the ring replace it. \param sync  see FileSink
    bool save(bool sync, QString *error);
    /// Completes the file. Records that come later are not recorded.
    bool finish(QString *error);
    /// Records no more from the ring.
    void detach() { m_reader.detach(); }
    /// Deletes the ring, whose records are all in the file.
    void removeRing() { m_reader.memory().remove(); }

    const RingDescription &description() const { return m_description; }
    std::uint64_t cycles() const { return m_cycles; }    // in the file, or in memory
    std::uint64_t missing() const { return m_missing; }  // that have no record
    std::uint64_t bytes() const { return m_writer ? m_writer->size() : 0; }

private:
    void add();
    void addCycle();
    void addNodes(const CycleView &view);
    void addRaw(const CycleView &view);
    void addGap(const RecordedGap &gap);
    void addEnd(const RecordedEnd &end);
    void addDigest(const QByteArray &more);
    void addOverview();
    bool isChunkFull() const;

    RingReader m_reader;
    RingDescription m_description;
    std::unique_ptr<PlantMessage> m_message;
    std::unique_ptr<mcap::Writer> m_writer;
    std::unique_ptr<overview::Builder> m_overview;  // null: it has been written
    std::uint16_t m_plant = 0;                      // channels
    std::uint16_t m_before = 0;
    std::uint16_t m_nodes = 0;
    std::uint16_t m_raw = 0;
    std::uint16_t m_gaps = 0;
    std::uint16_t m_digests = 0;
    QByteArray m_body;
    QByteArray m_exchange;       // of the newest message of /nodes
    std::uint64_t m_next = 0;    // cycle that comes next
    std::uint64_t m_digest = 0;  // after the newest cycle
    std::uint64_t m_cycles = 0;
    std::uint64_t m_missing = 0;
    std::int64_t m_startTime = 0;  // of cycle 0 [ns since 1970]
    std::uint64_t m_time = 0;      // of the newest cycle [ns]
    bool m_hasDigest = true;       // of the newest cycle, in the file
    bool m_isOver = false;
    bool m_isDamaged = false;
};

}  // namespace qplc
