// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecordLayout.h"
#include "RingMemory.h"

#include <vector>

namespace qplc {

/// Reads the records of a region of a ring, while they are written or after their writer has ended.
class RegionReader
{
public:
    enum Result : std::uint8_t {
        Found,    ///< kind(), body() and size() are those of the next record
        Nothing,  ///< there is none yet
        Lost,     ///< records before the next one have been replaced before they were read
        Damaged   ///< what is there is no record: all that is in the ring is left out
    };

    /// Begins with the oldest record.
    void open(const RingRegion &region);
    /// See RingReader::attach(). \pre no other one records
    void attach();
    void detach();

    Result next();
    RecordKind kind() const { return m_head.kind; }
    /// What follows the head, until the next call of next().
    const char *body() const { return m_body.data(); }
    std::uint32_t size() const { return m_head.size - std::uint32_t(sizeof(RecordHead)); }
    /// next() finds the record again that it has found last.
    void putBack() { m_place -= m_head.size; }
    /// All records that next() has found are in safety: the writer may replace them.
    void release();
    bool isEmpty() const { return m_region.capacity == 0; }

protected:
    RingRegion m_region;

private:
    void leaveRoom();

    std::uint64_t m_place = 0;
    RecordHead m_head;
    std::vector<char> m_body;
    bool m_isAttached = false;
};

/// Reads a ring, of this process or another one. Its own functions read the records of cycles.
class RingReader : public RegionReader
{
public:
    /// Begins with the oldest record.
    bool open(const QByteArray &file, QString *error);
    /// Records from now on: the writer keeps every record that has not been released. Goes on where
    /// a recorder has stopped that has ended without detach().
    /// \return false when there is another recorder
    bool attach();
    /// Records no more.
    void detach();
    /// All records and texts that next() has found are in safety.
    void release();
    /// Those of the texts.
    RegionReader &texts() { return m_texts; }

    /// Tells the writer, and others that have the ring open, what this recorder does.
    void report(const RecorderReport &report);

    /// Whether the process that writes the ring is there, and has not ended the phase.
    bool hasWriter() const { return m_memory.isLocked(RingMemory::WriterLock); }
    RingMemory &memory() { return m_memory; }

private:
    RingMemory m_memory;
    RegionReader m_texts;
    bool m_isAttached = false;
};

/// A record of a cycle, whose parts lie in the body of the record.
struct CycleView
{
    RecordedCycle cycle;
    const char *nodes = nullptr;   // RecordedNodes
    const char *image = nullptr;   // cycle.imageSize bytes
    const char *before = nullptr;  // cycle.beforeSize bytes
    const char *raw = nullptr;     // cycle.rawSize bytes

    RecordedNode node(std::uint32_t number) const noexcept;
    /// \return false when the parts do not fit into \a size bytes
    static bool read(const char *body, std::uint32_t size, CycleView *view) noexcept;
};

}  // namespace qplc
