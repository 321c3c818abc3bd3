// SPDX-License-Identifier: Apache-2.0
#include "SignalGuard.h"

#include <algorithm>
#include <cstring>

namespace qplc {

// ---- making ----

SignalGuard::SignalGuard(ProcessImage &image, Observer *observer)
    : m_values(image.data())
    , m_qualities(image.data() ? image.data() + image.qualityOffset(0) : nullptr)
    , m_observer(observer)
    , m_safe(image.size())
    , m_nonFinite(std::size_t(image.table().size()))
    , m_outOfRange(std::size_t(image.table().size()))
    , m_sources(std::size_t(image.table().size()))
{
    m_signals.reserve(m_nonFinite.size());
    for (const QPlcSignalDefinition &definition : image.table())
        add(definition, image.offset(QPlcSignalIndex(m_signals.size())));
    m_growing.reserve(m_signals.size());
}

SignalGuard::SignalGuard(const QPlcSignalTable &table, const PayloadLayout &layout, char *values, char *qualities,
                         Observer *observer)
    : m_values(values)
    , m_qualities(qualities)
    , m_observer(observer)
    , m_safe(layout.valueSize())
    , m_nonFinite(layout.fields().size())
    , m_outOfRange(layout.fields().size())
{
    m_signals.reserve(layout.fields().size());
    for (const PayloadLayout::Field &field : layout.fields()) {
        const QPlcSignalDefinition &definition = table.at(field.signal);
        setQuality(Place(m_signals.size()), QPlcQuality::Invalid);
        add(definition, field.offset);
        (definition.initial.isFinite() ? definition.initial : definition.safeValue()).toBytes(values + field.offset);
    }
    m_growing.reserve(m_signals.size());
}

void SignalGuard::add(const QPlcSignalDefinition &definition, quint32 offset)
{
    Signal signal;
    signal.offset = offset;
    signal.size = quint32(definition.type.size());
    signal.hold = definition.hold.value_or(int(UsualHold));
    signal.hasOwnHold = definition.hold.has_value();
    m_signals.push_back(signal);
    definition.safeValue().toBytes(m_safe.data() + offset);
}

void SignalGuard::setUsualHold(std::int64_t cycles) noexcept
{
    for (Signal &signal : m_signals) {
        if (!signal.hasOwnHold)
            signal.hold = cycles;
    }
}

SignalGuard::Frame SignalGuard::frameFor(const ProcessImage &image, const PayloadLayout &layout,
                                         const std::vector<bool> &held)
{
    Frame frame;
    frame.rules = PayloadRules(image.table(), layout);
    std::vector<bool> others = held;  // signals that this frame does not set by itself
    others.resize(std::size_t(image.table().size()));
    for (std::size_t i = 0; i < layout.fields().size(); ++i) {
        const PayloadLayout::Field &field = layout.fields()[i];
        if (others[field.signal])
            continue;
        const bool isContested = image.table().at(field.signal).writers.size() > 1;
        (isContested ? frame.contested : frame.fields).push_back({i, field.offset, field.signal});
        others[field.signal] = isContested;
    }
    frame.runs = image.scatterRuns(layout, others);
    frame.qualities = layout.valueSize();
    frame.qualityCount = layout.hasQualities() ? quint32(layout.fields().size()) : 0;
    return frame;
}

SignalGuard::Frame SignalGuard::frameFor(const QPlcSignalTable &table, const PayloadLayout &layout)
{
    Frame frame;
    frame.rules = PayloadRules(table, layout);
    for (std::size_t i = 0; i < layout.fields().size(); ++i)
        frame.fields.push_back({i, layout.fields()[i].offset, Place(i)});
    if (layout.valueSize() > 0)
        frame.runs.push_back({0, 0, layout.valueSize()});
    return frame;
}

// ---- taking ----

void SignalGuard::storeOneByOne(const Frame &frame, Writer &writer, const char *payload, std::int64_t cycle,
                                std::int64_t now) noexcept
{
    partWays(frame, writer);
    bool isWhole = cycle >= now;
    for (const Frame::Field &field : frame.fields) {
        Signal &signal = m_signals[field.place];
        const QPlcQuality given = frame.quality(field, payload);
        const std::int64_t written = cycle - given.heldCycles();
        const ValueFault fault = frame.fault(field, payload);
        if (fault)
            refuse(writer.id, field.place, fault, !signal.isRefused);
        signal.isRefused = bool(fault);
        isWhole = isWhole && given == QPlcQuality::Good && !fault;
        if (!given.isUsable() || fault || now - written > signal.hold)
            startGrowing(field.place);
        else
            put(field.place, payload + field.from, written, now);
    }
    writer.taken = cycle;
    writer.isWhole = isWhole;
}

void SignalGuard::put(Place place, const char *value, std::int64_t cycle, std::int64_t now) noexcept
{
    Signal &signal = m_signals[place];
    std::memcpy(m_values + signal.offset, value, signal.size);
    signal.good = cycle;
    setQuality(place, QPlcQuality::held(now - cycle));
    signal.isGrowing = signal.isAbandoned = false;
    if (cycle < now)
        startGrowing(place);
}

void SignalGuard::refuse(std::uint16_t writer, Place place, const ValueFault &fault, bool isFirst) noexcept
{
    (fault.kind == ValueFault::NotFinite ? m_nonFinite : m_outOfRange)[place].add();
    if (m_observer)
        m_observer->valueRefused(writer, place, fault, isFirst);
}

/// From now on each signal of the writer has an age of its own.
void SignalGuard::partWays(const Frame &frame, Writer &writer) noexcept
{
    if (!writer.isWhole)
        return;
    writer.isWhole = false;
    for (const Frame::Field &field : frame.fields) {
        m_signals[field.place].good = writer.taken;
        startGrowing(field.place);
    }
}

// ---- several writers ----

void SignalGuard::Claims::resize(const PayloadLayout &layout)
{
    bytes.assign(layout.valueSize(), 0);
    good.assign(layout.fields().size(), Never);
}

void SignalGuard::Claims::forget()
{
    std::fill(good.begin(), good.end(), Never);
}

void SignalGuard::claim(const Frame &frame, const Writer &writer, Claims &claims, const char *payload,
                        std::int64_t cycle) noexcept
{
    for (const Frame::Field &field : frame.contested) {
        const QPlcQuality given = frame.quality(field, payload);
        const std::int64_t written = cycle - given.heldCycles();
        const ValueFault fault = frame.fault(field, payload);
        const std::int64_t former = claims.good[field.number];
        if (fault)
            refuse(writer.id, field.place, fault, former != Never);
        if (fault || !given.isUsable()) {
            claims.good[field.number] = Never;  // who says nonsense now is not believed either in what it said before
        } else if (written > former) {
            std::memcpy(claims.bytes.data() + field.from, payload + field.from, m_signals[field.place].size);
            claims.good[field.number] = written;
        }
    }
}

void SignalGuard::decide(const Contest &contest, std::int64_t now) noexcept
{
    Signal &signal = m_signals[contest.place];
    const std::int64_t fresh = std::min(FreshCycles, signal.hold);
    for (const Contest::Candidate &candidate : contest.candidates) {
        const std::int64_t good = candidate.claims->good[candidate.field];
        if (now - good > fresh)
            continue;
        put(contest.place, candidate.claims->bytes.data() + candidate.from, good, now);
        setSource(contest.place, candidate.writer);
        return;
    }
    setSource(contest.place, 0);
    if (signal.good == Forever)
        signal.good = now;  // it was a person's
    startGrowing(contest.place);
    if (quality(contest.place).isUsable())
        age(contest.place, now);
}

void SignalGuard::setSource(Place place, std::uint16_t writer) noexcept
{
    const std::uint16_t former = source(place);
    if (former == writer)
        return;
    m_sources[place].set(writer);
    if (m_observer)
        m_observer->sourceChanged(place, former, writer);
}

// ---- growing old ----

void SignalGuard::startGrowing(Place place) noexcept
{
    Signal &signal = m_signals[place];
    if (!quality(place).isUsable())
        return;
    signal.isGrowing = true;
    if (signal.isListed)
        return;
    signal.isListed = true;
    m_growing.push_back(place);
}

/// \return whether the signal goes on growing old
bool SignalGuard::age(Place place, std::int64_t now) noexcept
{
    const Signal &signal = m_signals[place];
    const std::int64_t cycles = now < signal.good ? 0 : now - signal.good;
    if (cycles == 0)
        return false;
    if (cycles <= signal.hold) {
        setQuality(place, QPlcQuality::held(cycles));
        return true;
    }
    std::memcpy(m_values + signal.offset, m_safe.data() + signal.offset, signal.size);
    setQuality(place, QPlcQuality::Safe);
    if (m_observer)
        m_observer->signalBecameSafe(place);
    return false;
}

void SignalGuard::grow(const Frame &frame, Writer &writer, std::int64_t now) noexcept
{
    partWays(frame, writer);
    for (const Frame::Field &field : frame.fields) {
        startGrowing(field.place);
        if (quality(field.place).isUsable())
            age(field.place, now);
    }
}

void SignalGuard::settle(std::int64_t now) noexcept
{
    std::size_t kept = 0;
    for (const Place place : m_growing) {
        Signal &signal = m_signals[place];
        signal.isGrowing = signal.isGrowing && quality(place).isUsable() && age(place, now);
        signal.isListed = signal.isGrowing;
        if (signal.isListed)
            m_growing[kept++] = place;
    }
    m_growing.resize(kept);
}

void SignalGuard::leave(const Frame &frame, Writer &writer) noexcept
{
    partWays(frame, writer);
    for (const Frame::Field &field : frame.fields)
        abandon(field.place);
    for (const Frame::Field &field : frame.contested)
        startGrowing(field.place);
}

void SignalGuard::abandon(Place place) noexcept
{
    startGrowing(place);
    m_signals[place].isAbandoned = true;
}

void SignalGuard::ageAbandoned(std::int64_t now) noexcept
{
    for (const Place place : m_growing) {
        if (m_signals[place].isAbandoned && m_signals[place].isGrowing && quality(place).isUsable())
            age(place, now);
    }
}

void SignalGuard::resume(const Frame &frame, Writer &writer, std::int64_t last) noexcept
{
    partWays(frame, writer);
    for (const Frame::Field &field : frame.fields) {
        Signal &signal = m_signals[field.place];
        if (signal.good == Forever)
            signal.good = last;
        startGrowing(field.place);
    }
}

void SignalGuard::forget() noexcept
{
    for (Place place = 0; place < m_signals.size(); ++place) {
        if (m_signals[place].good == Forever)
            continue;
        m_signals[place].good = Never;
        startGrowing(place);
    }
}

// ---- from outside ----

void SignalGuard::set(Place place, QPlcQuality quality) noexcept
{
    setQuality(place, quality);
    m_signals[place].good = Forever;
}

void SignalGuard::keep(Place place) noexcept
{
    if (quality(place).isUsable())
        setQuality(place, QPlcQuality::Good);
    m_signals[place].good = Forever;
}

void SignalGuard::clearCounters() noexcept
{
    for (std::size_t i = 0; i < m_nonFinite.size(); ++i) {
        m_nonFinite[i].set(0);
        m_outOfRange[i].set(0);
    }
}

}  // namespace qplc
