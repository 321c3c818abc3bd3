// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RecordRing.h"
#include "Roster.h"
#include "SafetyGuard.h"
#include "realtime/Counter.h"
#include "realtime/TimeSource.h"

#include <atomic>
#include <memory>
#include <vector>

namespace qplc {

/// Writes what each cycle of a master has computed into a ring, from which recorders read it.
///
/// With a clock that is timed, a cycle never waits for a recorder: cycles for which there is no
/// room are counted, and a RecordedGap says which ones they are. Otherwise a cycle waits for room,
/// as long as somebody records and makes progress.
///
/// Used by the cycle thread, but for what is marked.
class CycleTap
{
public:
    struct Cycle
    {
        std::uint64_t number = 0;
        std::uint64_t skipped = 0;
        std::int64_t lateness = 0;  // [ns]
        std::uint32_t flags = 0;    // of RecordedCycle::Flag
        std::uint64_t digest = 0;
        std::int64_t wallTime = 0;   // [ns since 1970]
        std::uint64_t settings = 0;  // number of the newest value from outside that was adopted
    };

    /// A recorder that puts nothing to safety for so long is not waited for until it does [ns].
    static constexpr std::int64_t Patience = 10'000'000'000;

    /// Both outlive this object.
    CycleTap(const ProcessImage &image, TimeSource &time);

    /// Before a phase. \param ring  null: nothing is written
    /// \param waits  for a recorder: the clock is not timed
    /// \param startTime  of cycle 0 [ns since 1970]; 0: not timed
    void start(std::shared_ptr<RecordRing> ring, bool waits, std::int64_t startTime);
    /// The image as inputs of the cycle at hand are cut from it, goes into its record.
    void keepBefore() noexcept;
    /// Whether the last cycle has no record: then the next one needs the image before.
    bool hasGap() const noexcept { return m_gap.cycles > 0; }
    void record(const Cycle &cycle, const Roster &roster, const std::atomic<bool> &stop,
                const SafetyGuard &guard) noexcept;
    /// The nodes of the cycles from now on.
    /// \param text  RosterContent::toText(); lasts until the next call or the end of the phase
    void setRoster(const QByteArray *text, std::uint64_t first) noexcept;
    /// A node takes part from the cycle \a first on; its initial values are there.
    void join(const NodeSlot &slot, std::uint64_t first) noexcept;
    /// After the last cycle of a phase.
    void end() noexcept;
    /// Cycles of this phase that have no record. \threadsafe yes
    std::uint64_t missing() const { return m_missing; }
    /// [byte] of a usual record with so many nodes.
    static std::size_t usualSize(const ProcessImage &image, std::size_t nodes);

private:
    bool makeRoom(std::uint32_t size, const std::atomic<bool> &stop, const SafetyGuard &guard) noexcept;
    void noteGap(const Cycle &cycle) noexcept;
    bool writeGap() noexcept;
    bool wantsRoster() const noexcept;
    std::uint32_t rosterSize() const noexcept;
    void writeRoster() noexcept;
    void writeSettings() noexcept;
    char *writeNodes(const Roster &roster, char *to) const noexcept;
    char *writeRaw(const Roster &roster, char *to) const noexcept;

    const ProcessImage &m_image;
    TimeSource &m_time;
    std::shared_ptr<RecordRing> m_ring;
    bool m_waits = false;
    std::uint64_t m_givenUpAt = ~std::uint64_t(0);  // how far the recorder had got that was not waited for any more
    std::vector<char> m_before;
    bool m_hasBefore = false;
    const QByteArray *m_rosterText = nullptr;
    RecordedRoster m_roster;
    bool m_hasNewRoster = false;      // it is not in the ring
    std::uint64_t m_rosterPlace = 0;  // behind the newest one in the ring
    RecordedSettings m_settings;
    bool m_hasNewSettings = false;  // they are not in the ring
    RecordedGap m_gap;
    RecordedEnd m_end;
    Counter m_missing;
};

}  // namespace qplc
