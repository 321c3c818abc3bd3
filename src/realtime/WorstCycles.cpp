// SPDX-License-Identifier: Apache-2.0
#include "WorstCycles.h"

#include <algorithm>
#include <thread>

namespace qplc {

namespace {

template<typename Words>
void pack(const CycleRecord &record, Words *words) noexcept
{
    std::size_t word = 0;
    // Released: a reader that sees any of these sees that the version has changed, too.
    const auto put = [&](std::uint64_t value) { (*words)[word++].store(value, std::memory_order_release); };
    put(record.cycle);
    put(record.skipped);
    for (const std::int64_t duration : {record.lateness, record.execution, record.roundTrip, record.slack})
        put(std::uint64_t(duration));
    for (const std::int64_t duration : record.stages)
        put(std::uint64_t(duration));
}

template<typename Words>
CycleRecord unpack(const Words &words) noexcept
{
    std::size_t word = 0;
    const auto take = [&] { return words[word++].load(std::memory_order_acquire); };
    CycleRecord record;
    record.cycle = take();
    record.skipped = take();
    for (std::int64_t *duration : {&record.lateness, &record.execution, &record.roundTrip, &record.slack})
        *duration = std::int64_t(take());
    for (std::int64_t &duration : record.stages)
        duration = std::int64_t(take());
    return record;
}

}  // namespace

void WorstCycles::insert(std::int64_t cost, const CycleRecord &record) noexcept
{
    Entry &entry = m_entries[m_leastEntry];
    const std::uint64_t version = m_version.load(std::memory_order_relaxed);
    m_version.store(version + 1, std::memory_order_relaxed);
    entry.cost = cost;
    entry.visibleCost.store(cost, std::memory_order_release);
    pack(record, &entry.words);
    m_version.store(version + 2, std::memory_order_release);
    findLeast();
}

/// Of several that cost the same the newest cycle goes first.
void WorstCycles::findLeast() noexcept
{
    const auto cycleOf = [](const Entry &entry) { return entry.words[0].load(std::memory_order_relaxed); };
    const auto least = std::min_element(m_entries.begin(), m_entries.end(), [&](const Entry &a, const Entry &b) {
        return a.cost != b.cost ? a.cost < b.cost : cycleOf(a) > cycleOf(b);
    });
    m_leastEntry = std::size_t(least - m_entries.begin());
    m_least = least->cost;
}

void WorstCycles::clear() noexcept
{
    const std::uint64_t version = m_version.load(std::memory_order_relaxed);
    m_version.store(version + 1, std::memory_order_relaxed);
    for (Entry &entry : m_entries) {
        entry.cost = -1;
        entry.visibleCost.store(-1, std::memory_order_release);
    }
    m_version.store(version + 2, std::memory_order_release);
    findLeast();
}

std::vector<CycleRecord> WorstCycles::read() const
{
    std::vector<std::pair<std::int64_t, CycleRecord>> kept;
    for (std::uint64_t version = 1; version % 2 == 1 || m_version.load(std::memory_order_relaxed) != version;) {
        if (version % 2 == 1)
            std::this_thread::yield();  // the writer may be waiting for this processor
        version = m_version.load(std::memory_order_acquire);
        kept.clear();
        for (const Entry &entry : m_entries) {
            const std::int64_t cost = entry.visibleCost.load(std::memory_order_acquire);
            if (cost >= 0)
                kept.emplace_back(cost, unpack(entry.words));
        }
    }
    std::sort(kept.begin(), kept.end(), [](const auto &a, const auto &b) {
        return a.first != b.first ? a.first > b.first : a.second.cycle < b.second.cycle;
    });
    std::vector<CycleRecord> records;
    for (const auto &[cost, record] : kept)
        records.push_back(record);
    return records;
}

}  // namespace qplc
