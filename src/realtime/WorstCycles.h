// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace qplc {

/// The parts of a cycle of a master, in the order in which they first occur.
enum class CycleStage : std::uint8_t {
    Commands,    // values and nodes given from outside, the signals of the master itself
    Ask,         // inputs packed and sent
    LocalNodes,  // nodes of this process computed
    Collect,     // waited for answers and took them
    Finish       // outputs of local nodes, digest, snapshot
};
constexpr std::size_t CycleStageCount = 5;

/// What is kept of one cycle.
struct CycleRecord
{
    std::uint64_t cycle = 0;
    std::uint64_t skipped = 0;                           // cycles left out before it
    std::int64_t lateness = 0;                           // [ns]
    std::int64_t execution = 0;                          // [ns]
    std::int64_t roundTrip = -1;                         // [ns]; -1: nobody answered
    std::int64_t slack = 0;                              // [ns]
    std::array<std::int64_t, CycleStageCount> stages{};  // [ns]
};

/// The cycles with the largest cost, in constant memory: a cycle replaces the cheapest one that is
/// kept when it costs more; of two that cost the same the first one stays. One thread offers (and
/// clears), others read at any time.
class WorstCycles
{
public:
    static constexpr std::size_t Count = 16;

    /// \param cost  [ns]
    void offer(std::int64_t cost, const CycleRecord &record) noexcept
    {
        if (cost > m_least)
            insert(cost, record);
    }
    /// Forgets everything. Offering thread only.
    void clear() noexcept;
    /// Those kept, the worst one first; of two that cost the same the first one first.
    std::vector<CycleRecord> read() const;

private:
    static constexpr std::size_t Words = 6 + CycleStageCount;
    struct Entry
    {
        std::int64_t cost = -1;  // offering thread
        std::atomic<std::int64_t> visibleCost{-1};
        std::array<std::atomic<std::uint64_t>, Words> words{};
    };

    void insert(std::int64_t cost, const CycleRecord &record) noexcept;
    void findLeast() noexcept;

    std::array<Entry, Count> m_entries;
    std::size_t m_leastEntry = 0;             // offering thread: the one to be replaced next
    std::int64_t m_least = -1;                // offering thread: its cost
    std::atomic<std::uint64_t> m_version{0};  // odd while an entry is being written
};

}  // namespace qplc
