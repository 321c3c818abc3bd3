// SPDX-License-Identifier: Apache-2.0
#include "CycleTap.h"

#include <algorithm>
#include <cstring>

namespace qplc {

namespace {

constexpr std::uint32_t GapSize = sizeof(RecordHead) + sizeof(RecordedGap);
constexpr std::uint32_t EndSize = sizeof(RecordHead) + sizeof(RecordedEnd);
constexpr std::uint32_t SettingsSize = sizeof(RecordHead) + sizeof(RecordedSettings);
constexpr std::int64_t LookAfter = 200'000;  // [ns] between two looks for room

const char *rawOutputs(const NodeSlot &slot)
{
    return slot.local ? slot.local->outputs() : slot.decoder.payload();
}

/// Whether the image does not show what was stored.
bool isHidden(const NodeSlot &slot) noexcept
{
    return slot.exchange.isStored
        && (slot.exchange.isChanged || slot.paste != &slot.outputs || !slot.paste->contested.empty());
}

/// The answer of a two-phase node is for the next cycle, and another one may have come since.
bool hasRawOutputs(const NodeSlot &slot) noexcept
{
    return !slot.twoPhase && isHidden(slot);
}

/// Whether the node has got other inputs of the same cycle than those at its end: their writer has
/// answered too late for it.
bool hasRawInputs(const NodeSlot &slot, const ProcessImage &image) noexcept
{
    const auto differs
        = [&](const CopyRun &run) { return std::memcmp(image.data() + run.from, slot.inputs + run.to, run.size) != 0; };
    return slot.due && std::any_of(slot.sameCycleRuns.begin(), slot.sameCycleRuns.end(), differs);
}

char *append(char *to, const void *bytes, std::uint32_t size) noexcept
{
    if (size > 0)  // of nothing, the place may be null
        std::memcpy(to, bytes, size);
    const std::uint32_t padded = paddedRecordSize(size);
    std::memset(to + size, 0, padded - size);
    return to + padded;
}

}  // namespace

CycleTap::CycleTap(const ProcessImage &image, TimeSource &time)
    : m_image(image)
    , m_time(time)
    , m_before(image.totalSize())
{
}

void CycleTap::start(std::shared_ptr<RecordRing> ring, bool waits, std::int64_t startTime)
{
    m_ring = std::move(ring);
    m_waits = waits;
    m_givenUpAt = ~std::uint64_t(0);
    m_hasBefore = false;
    m_rosterText = nullptr;
    m_roster = {};
    m_hasNewRoster = false;
    m_hasNewSettings = false;
    m_gap = {};
    m_end = {};
    m_missing.set(0);
    if (m_ring)
        m_ring->memory().header()->startTime = startTime;
}

void CycleTap::setRoster(const QByteArray *text, std::uint64_t first) noexcept
{
    if (!m_ring)
        return;
    m_rosterText = text;
    const auto length = std::uint32_t(text ? text->size() : 0);
    m_roster = {first, m_roster.number + 1, length <= m_ring->memory().capacity() / 16 ? length : 0};
    m_hasNewRoster = true;
}

/// A recorder that comes later finds one, whatever has been replaced.
bool CycleTap::wantsRoster() const noexcept
{
    const std::uint64_t head = m_ring->head();
    return m_hasNewRoster || (m_roster.number > 0 && head - m_rosterPlace > m_ring->memory().capacity() / 8);
}

std::uint32_t CycleTap::rosterSize() const noexcept
{
    return std::uint32_t(sizeof(RecordHead) + sizeof m_roster) + paddedRecordSize(m_roster.textSize);
}

void CycleTap::writeRoster() noexcept
{
    const std::uint32_t size = rosterSize();
    char *to = append(m_ring->begin(size), &m_roster, sizeof m_roster);
    if (m_roster.textSize > 0)
        append(to, m_rosterText->constData(), m_roster.textSize);
    m_ring->commit(RecordKind::Roster, size);
    m_rosterPlace = m_ring->head();
    m_hasNewRoster = false;
}

void CycleTap::writeSettings() noexcept
{
    append(m_ring->begin(SettingsSize), &m_settings, sizeof m_settings);
    m_ring->commit(RecordKind::Settings, SettingsSize);
    m_hasNewSettings = false;
}

/// A recorder that leaves no room for it gets a recording from which this node cannot be replayed.
void CycleTap::join(const NodeSlot &slot, std::uint64_t first) noexcept
{
    if (!m_ring)
        return;
    const bool hasOutputs = slot.local || !slot.initialOutputs.empty();
    RecordedJoin join{first, hasOutputs ? slot.outputLayout.size() : 0, std::uint32_t(slot.initialInputs.size()),
                      slot.id};
    const std::uint32_t size = std::uint32_t(sizeof(RecordHead) + sizeof join) + paddedRecordSize(join.outputsSize)
        + paddedRecordSize(join.inputsSize);
    if (size + GapSize + EndSize > m_ring->memory().capacity() || !m_ring->hasRoomFor(size + GapSize + EndSize))
        return;
    char *to = append(m_ring->begin(size), &join, sizeof join);
    if (hasOutputs)
        to = append(to, slot.local ? slot.local->outputs() : slot.initialOutputs.data(), join.outputsSize);
    append(to, slot.initialInputs.data(), join.inputsSize);
    m_ring->commit(RecordKind::Join, size);
}

void CycleTap::keepBefore() noexcept
{
    if (!m_ring)
        return;
    std::memcpy(m_before.data(), m_image.data(), m_before.size());
    m_hasBefore = true;
}

std::size_t CycleTap::usualSize(const ProcessImage &image, std::size_t nodes)
{
    return sizeof(RecordHead) + sizeof(RecordedCycle) + nodes * sizeof(RecordedNode)
        + paddedRecordSize(image.totalSize());
}

void CycleTap::record(const Cycle &cycle, const Roster &roster, const std::atomic<bool> &stop,
                      const SafetyGuard &guard) noexcept
{
    if (!m_ring)
        return;
    ++m_end.cycles;
    m_end.last = cycle.number;
    m_end.digest = cycle.digest;
    if (cycle.settings != m_settings.adopted) {
        m_settings = {cycle.number, cycle.settings};
        m_hasNewSettings = true;
    }
    RecordedCycle record{cycle.number, cycle.wallTime, cycle.lateness, cycle.skipped, cycle.digest, cycle.flags};
    record.nodes = std::uint32_t(roster.nodes.size());
    record.imageSize = m_image.totalSize();
    record.beforeSize = m_hasBefore ? record.imageSize : 0;
    m_hasBefore = false;
    record.roster = m_roster.number;
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        record.rawSize += hasRawOutputs(*slot) ? paddedRecordSize(slot->outputLayout.size()) : 0;
        slot->exchange.hasRawInputs = hasRawInputs(*slot, m_image);
        record.rawSize += slot->exchange.hasRawInputs ? paddedRecordSize(slot->inputLayout.size()) : 0;
    }
    const std::uint32_t image = paddedRecordSize(record.imageSize);
    const std::uint32_t size = std::uint32_t(sizeof(RecordHead) + sizeof record + record.nodes * sizeof(RecordedNode))
        + image + (record.beforeSize > 0 ? image : 0) + record.rawSize;
    const bool hasRoster = wantsRoster();
    if (!makeRoom(size + (hasRoster ? rosterSize() : 0) + (m_hasNewSettings ? SettingsSize : 0), stop, guard)) {
        noteGap(cycle);
        return;
    }
    if (hasRoster)
        writeRoster();
    if (m_hasNewSettings)
        writeSettings();
    char *to = append(m_ring->begin(size), &record, sizeof record);
    to = writeNodes(roster, to);
    to = append(to, m_image.data(), record.imageSize);
    if (record.beforeSize > 0)
        to = append(to, m_before.data(), record.beforeSize);
    if (record.rawSize > 0)
        writeRaw(roster, to);
    m_ring->commit(RecordKind::Cycle, size);
}

/// Some room is always left for the end of the phase, which says what is missing before it. Behind
/// a gap, the recorder first gets a part of the ring free: many short gaps tell less than a long
/// one.
bool CycleTap::makeRoom(std::uint32_t size, const std::atomic<bool> &stop, const SafetyGuard &guard) noexcept
{
    const auto behindGap = std::max(size + GapSize, std::uint32_t(m_ring->memory().capacity() / 8));
    const std::uint32_t wanted = (m_gap.cycles > 0 ? behindGap : size) + GapSize + EndSize;
    std::uint64_t place = m_ring->readPlace();
    std::int64_t progress = 0;  // [ns] when the recorder has made some; 0: not looked yet
    while (!m_ring->hasRoomFor(wanted)) {
        if (!m_waits || place == m_givenUpAt || stop.load(std::memory_order_relaxed) || guard.isTripped()
            || wanted > m_ring->memory().capacity())
            return false;
        const std::int64_t now = m_time.now();
        if (progress == 0 || m_ring->readPlace() != place) {
            place = m_ring->readPlace();
            progress = now;
        } else if (now - progress > Patience) {
            m_givenUpAt = place;
            return false;
        }
        m_time.sleepUntil(now + LookAfter);
    }
    return m_gap.cycles == 0 || writeGap();
}

void CycleTap::noteGap(const Cycle &cycle) noexcept
{
    if (m_gap.cycles == 0)
        m_gap.first = cycle.number;
    m_gap.last = cycle.number;
    m_gap.digest = cycle.digest;
    m_gap.skipped += cycle.skipped;
    ++m_gap.cycles;
    ++m_end.missing;
    m_missing.add();
}

bool CycleTap::writeGap() noexcept
{
    char *to = m_ring->begin(GapSize);
    if (!to)
        return false;
    std::memcpy(to, &m_gap, sizeof m_gap);
    m_ring->commit(RecordKind::Gap, GapSize);
    m_gap = {};
    return true;
}

char *CycleTap::writeNodes(const Roster &roster, char *to) const noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        const bool hasRaw = hasRawOutputs(*slot);
        const bool hasInputs = slot->exchange.hasRawInputs;
        const auto flag = [](bool isSet, RecordedNode::Flag value) { return isSet ? std::uint16_t(value) : 0; };
        RecordedNode record{slot->exchange.cycle, slot->exchange.arrival, slot->exchange.info, slot->id};
        record.flags = std::uint16_t(
            flag(slot->asked || (slot->local && slot->due), RecordedNode::Asked)
            | flag(slot->answered, RecordedNode::Answered) | flag(slot->exchange.isStored, RecordedNode::Stored)
            | flag(slot->late, RecordedNode::Late) | flag(slot->faulted, RecordedNode::Faulted)
            | flag(slot->isSafe.load(std::memory_order_relaxed), RecordedNode::IsSafe)
            | flag(slot->lost.load(std::memory_order_relaxed), RecordedNode::Lost) | flag(hasRaw, RecordedNode::HasRaw)
            | flag(slot->local != nullptr, RecordedNode::IsLocal) | flag(slot->listener, RecordedNode::Listens)
            | flag(hasInputs, RecordedNode::HasInputs) | flag(slot->twoPhase && isHidden(*slot), RecordedNode::Hidden));
        record.rawSize = hasRaw ? slot->outputLayout.size() : 0;
        record.history = slot->exchange.history;
        record.inputsSize = hasInputs ? slot->inputLayout.size() : 0;
        to = append(to, &record, sizeof record);
    }
    return to;
}

char *CycleTap::writeRaw(const Roster &roster, char *to) const noexcept
{
    for (const std::shared_ptr<NodeSlot> &slot : roster.nodes) {
        if (hasRawOutputs(*slot))
            to = append(to, rawOutputs(*slot), slot->outputLayout.size());
        if (slot->exchange.hasRawInputs)
            to = append(to, slot->inputs, slot->inputLayout.size());
    }
    return to;
}

/// A recorder may have put nothing to safety meanwhile: room for this was left.
void CycleTap::end() noexcept
{
    if (!m_ring)
        return;
    if (m_gap.cycles > 0)
        writeGap();
    if (char *to = m_ring->begin(EndSize)) {
        std::memcpy(to, &m_end, sizeof m_end);
        m_ring->commit(RecordKind::End, EndSize);
    }
    m_ring.reset();
}

}  // namespace qplc
