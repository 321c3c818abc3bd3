// SPDX-License-Identifier: Apache-2.0
#include "PlantValues.h"

#include <algorithm>
#include <limits>

namespace qplc {

namespace {

constexpr int leastRows = 16;

}  // namespace

void PlantValues::setTable(const QPlcSignalTable &table, Time period, Budget budget)
{
    m_budget = budget;
    m_table = table;
    m_channels = ChannelMap(table);
    m_period = std::max<Time>(period, 1);
    m_row.assign(std::size_t(m_channels.channels()), 0.0F);
    m_newest.assign(std::size_t(m_channels.payloadSize()), 0);
    m_qualities.assign(std::size_t(table.size()), char(QPlcQuality(QPlcQuality::Good).toByte()));
    m_hasValues = false;
    m_lastTime = 0;
    m_toldPhase = {};
    m_phaseOfFrames = {};
    m_isRejoining = false;
    makeStore();
    beginBatch();
    interrupt();
}

int PlantValues::wantedRows() const
{
    constexpr std::int64_t most = 100'000'000;
    const std::int64_t affordable = m_budget.memory / bytesOfRow(m_channels.channels());
    return int(std::clamp<std::int64_t>(std::min(m_budget.history / m_period, affordable), leastRows, most));
}

void PlantValues::makeStore()
{
    m_store = std::make_shared<SignalStore>(m_channels.channels(), wantedRows());
}

void PlantValues::beginBatch()
{
    m_batch.clear();
    m_batchSize = 0;
}

void PlantValues::interrupt()
{
    m_isContinued = false;
    if (m_store)
        m_store->interrupt();
}

void PlantValues::beginPhase(const QPlcIOBufferSlaveNode::Frame &frame, Time wallTime)
{
    m_phase = frame.phase;
    m_period = std::max<Time>(frame.period.count(), 1);
    m_interval = ListeningInterval(frame.every);
    if (wantedRows() / 2 > m_store->capacity())  // the period has become much shorter
        makeStore();
    if (!goesOn(frame)) {
        m_phaseStart = std::max(wallTime, m_lastTime + rowPeriod()) - Time(frame.cycle) * m_period;
        m_phaseOfFrames = {};
    }
    m_isRejoining = false;
    interrupt();
}

/// Whether it is of the same phase as the rows before the connection was lost.
bool PlantValues::goesOn(const QPlcIOBufferSlaveNode::Frame &frame) const
{
    return m_isRejoining && m_phaseOfFrames.isTimed() && m_toldPhase == m_phaseOfFrames && frame.cycle > m_lastCycle;
}

void PlantValues::rejoin()
{
    m_isRejoining = true;
    m_toldPhase = {};
}

/// An answer may be older than the frames that have come meanwhile: it counts if no phase has begun
/// since the answer before.
void PlantValues::setPhase(const Phase &phase)
{
    if (m_isContinued && m_phase == m_phaseWhenTold)
        m_phaseOfFrames = phase;
    m_phaseWhenTold = m_phase;
    m_toldPhase = phase;
}

void PlantValues::storeFrame(const QPlcIOBufferSlaveNode::Frame &frame, Time wallTime)
{
    if (!m_store || frame.size != m_channels.payloadSize())
        return;  // of another table
    if (isLeftOver(frame))
        return;
    if (!m_isContinued || frame.phase != m_phase) {
        beginPhase(frame, wallTime);
    } else if (frame.cycle <= m_lastCycle || m_interval.missed(m_lastCycle, frame.cycle) > 0) {
        ++m_gaps;
        noteHole(frame.cycle);
        interrupt();
    }
    m_isContinued = true;
    m_lastCycle = frame.cycle;
    storeRow(frame.inputs, m_phaseStart + Time(frame.cycle) * m_period, frame.qualities);
}

/// Of the connection before, and taken when another one was there: it would get the time of now.
bool PlantValues::isLeftOver(const QPlcIOBufferSlaveNode::Frame &frame) const
{
    return frame.phase == m_phase && (m_isRejoining || !m_isContinued);
}

/// \param cycle  behind it
void PlantValues::noteHole(quint64 cycle)
{
    const Time before = m_phaseStart + Time(cycle) * m_period;
    if (before - m_lastTime >= LeastHole && m_holes.size() < MostHoles)
        m_holes.push_back({m_phase, m_lastCycle, m_lastTime, before});
}

void PlantValues::fill(const Gap &gap, PlantValues past, Time history)
{
    const std::shared_ptr<SignalStore> store = std::move(m_store);
    m_store = std::move(past.m_store);
    m_budget.history = std::max(m_budget.history, history);
    const bool hasRowsBefore = !store->isEmpty() && store->time(store->firstRow()) <= gap.after;
    if (hasRowsBefore || m_store->capacity() < store->capacity()) {
        const std::shared_ptr<SignalStore> found = std::move(m_store);
        makeStore();
        if (hasRowsBefore)
            m_store->append(*store, store->firstRow(), store->rowAt(gap.after + 1), SignalStore::BeginsAnew);
        m_store->append(*found, gap.begin);
    }
    if (store->rowAt(gap.before) == store->endRow())
        m_phaseOfFrames = {};  // the newest row is not that of a frame any more
    m_store->append(*store, store->rowAt(gap.before), store->endRow(), gap.end);
    m_lastTime = std::max(m_lastTime, m_store->newestTime());
}

void PlantValues::storeRow(const char *payload, Time time, const char *qualities)
{
    const int size = m_channels.payloadSize();
    m_lastTime = time;
    m_channels.toFloats(payload, m_row.data());
    m_doubts.clear();
    if (qualities)
        storeQualities(qualities);
    if (m_store->append(time, m_row.data())) {
        for (const Doubt &doubt : m_doubts)
            m_store->mark(doubt.channel, doubt.kind);
    }
    std::copy_n(payload, size, m_newest.begin());
    m_batch.insert(m_batch.end(), payload, payload + size);
    ++m_batchSize;
    ++m_rows;
    m_hasValues = true;
}

/// Finds the values of the row that are not good. One that nobody has written is none for a curve.
void PlantValues::storeQualities(const char *qualities)
{
    const auto isDoubtful = [](char quality) { return !QPlcQuality::fromByte(quint8(quality)).isGood(); };
    std::copy_n(qualities, m_qualities.size(), m_qualities.begin());
    auto found = std::find_if(m_qualities.begin(), m_qualities.end(), isDoubtful);
    for (; found != m_qualities.end(); found = std::find_if(found + 1, m_qualities.end(), isDoubtful)) {
        const auto signal = QPlcSignalIndex(found - m_qualities.begin());
        const int first = m_channels.channel(signal);
        const int behind = first != ChannelMap::NoChannel ? first + m_table.at(signal).type.count() : first;
        const QPlcQuality::Kind kind = QPlcQuality::fromByte(quint8(*found)).kind();
        for (int channel = first; channel < behind; ++channel) {
            m_doubts.push_back({channel, kind});
            if (kind == QPlcQuality::Invalid)
                m_row[std::size_t(channel)] = std::numeric_limits<float>::quiet_NaN();
        }
    }
}

void PlantValues::storeValue(QPlcSignalIndex signal, const QPlcValue &value, QPlcQuality quality)
{
    if (signal >= m_table.size() || value.type() != m_table.at(signal).type)
        return;
    value.toBytes(m_newest.data() + m_channels.offset(signal));
    m_qualities[signal] = char(quality.toByte());
    m_hasValues = true;
}

QPlcQuality PlantValues::quality(QPlcSignalIndex signal) const
{
    return m_hasValues && signal < m_table.size() ? QPlcQuality::fromByte(quint8(m_qualities[signal])) : QPlcQuality();
}

QPlcValue PlantValues::valueIn(const char *payload, QPlcSignalIndex signal) const
{
    return QPlcValue::fromBytes(m_table.at(signal).type, payload + m_channels.offset(signal));
}

QPlcValue PlantValues::value(QPlcSignalIndex signal) const
{
    return m_hasValues && signal < m_table.size() ? valueIn(m_newest.data(), signal) : QPlcValue();
}

std::vector<float> PlantValues::newestChannels() const
{
    std::vector<float> values(std::size_t(m_channels.channels()));
    m_channels.toFloats(m_newest.data(), values.data());
    return values;
}

QList<QPlcSignalList> PlantValues::batch(const QVector<QPlcSignalIndex> &signalIndices) const
{
    QList<QPlcSignalList> batch;
    for (int i = 0; i < m_batchSize; ++i) {
        const char *payload = m_batch.data() + std::ptrdiff_t(i) * m_channels.payloadSize();
        QPlcSignalList values;
        values.reserve(signalIndices.size());
        for (const QPlcSignalIndex signal : signalIndices) {
            if (signal < m_table.size())
                values.insert(signal, valueIn(payload, signal));
        }
        batch.append(values);
    }
    return batch;
}

}  // namespace qplc
