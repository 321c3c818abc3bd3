// SPDX-License-Identifier: Apache-2.0
#include "ProcessImage.h"

#include <QtCore/qendian.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

namespace qplc {

namespace {

constexpr std::size_t alignment = 64;  // [byte] a cache line; the image is padded with zeros to a multiple of it

std::size_t paddedSize(quint32 size)
{
    return (std::size_t(size) / alignment + 1) * alignment;
}

// A step of the digest: for a given `state` each `word` gives another result, and the other way
// round.
quint64 mixed(quint64 state, quint64 word) noexcept
{
    state = (state ^ word) * 0x9e3779b97f4a7c15u;
    return state ^ (state >> 32);
}

void appendRun(std::vector<CopyRun> &runs, const CopyRun &run)
{
    if (!runs.empty() && runs.back().from + runs.back().size == run.from && runs.back().to + runs.back().size == run.to)
        runs.back().size += run.size;
    else
        runs.push_back(run);
}

}  // namespace

void ProcessImage::AlignedDelete::operator()(char *bytes) const
{
    ::operator delete[](bytes, std::align_val_t(alignment));
}

ProcessImage::ProcessImage(const QPlcSignalTable &table)
    : m_table(table)
{
    m_offsets.reserve(std::size_t(table.size()));
    for (const QPlcSignalDefinition &signal : m_table) {
        m_offsets.push_back(m_size);
        m_size += quint32(signal.type.size());
    }
    m_qualityOffset = quint32(paddedSize(m_size));
    const std::size_t bytes = paddedSize(totalSize());
    m_bytes.reset(static_cast<char *>(::operator new[](bytes, std::align_val_t(alignment))));
    std::memset(m_bytes.get(), 0, bytes);
    reset();
}

QPlcValue ProcessImage::value(QPlcSignalIndex index) const
{
    if (index >= m_table.size())
        return QPlcValue();
    return QPlcValue::fromBytes(m_table.at(index).type, data() + offset(index));
}

bool ProcessImage::setValue(QPlcSignalIndex index, const QPlcValue &value)
{
    if (index >= m_table.size())
        return false;
    const QPlcValue converted = value.convertedTo(m_table.at(index).type);
    if (!converted.isValid())
        return false;
    converted.toBytes(data() + offset(index));
    return true;
}

void ProcessImage::reset()
{
    for (std::size_t i = 0; i < m_offsets.size(); ++i)
        m_table.at(QPlcSignalIndex(i)).initial.toBytes(data() + m_offsets[i]);
    if (!m_offsets.empty())
        std::memset(data() + m_qualityOffset, QPlcQuality().toByte(), m_offsets.size());
}

std::vector<CopyRun> ProcessImage::gatherRuns(const PayloadLayout &layout) const
{
    return gatherRuns(layout, std::vector<bool>(layout.fields().size(), true));
}

std::vector<CopyRun> ProcessImage::gatherRuns(const PayloadLayout &layout, const std::vector<bool> &wanted) const
{
    std::vector<CopyRun> runs;
    const std::size_t count = std::min(wanted.size(), layout.fields().size());
    for (std::size_t i = 0; i < count; ++i) {
        const PayloadLayout::Field &field = layout.fields()[i];
        if (wanted[i])
            appendRun(runs, {offset(field.signal), field.offset, quint32(field.type.size())});
    }
    for (std::size_t i = 0; i < count && layout.hasQualities(); ++i) {
        if (wanted[i])
            appendRun(runs, {qualityOffset(layout.fields()[i].signal), layout.valueSize() + quint32(i), 1});
    }
    return runs;
}

std::vector<CopyRun> ProcessImage::scatterRuns(const PayloadLayout &layout, const std::vector<bool> &held) const
{
    std::vector<CopyRun> runs;
    for (const PayloadLayout::Field &field : layout.fields()) {
        if (field.signal >= held.size() || !held[field.signal])
            appendRun(runs, {field.offset, offset(field.signal), quint32(field.type.size())});
    }
    return runs;
}

quint64 ProcessImage::digest(quint64 digest) const noexcept
{
    // Four independent lanes keep the multiplier busy. The zeros behind the last value are read
    // with it.
    constexpr quint32 lanes = 4;
    std::array<quint64, lanes> states = {1, 2, 3, 4};
    for (quint32 position = 0; position < m_size; position += lanes * 8) {
        for (quint32 lane = 0; lane < lanes; ++lane)
            states[lane] = mixed(states[lane], qFromLittleEndian<quint64>(data() + position + lane * 8));
    }
    quint64 result = mixed(digest, m_size);
    for (const quint64 state : states)
        result = mixed(result, state);
    return mixed(result, result >> 29);
}

}  // namespace qplc
