// SPDX-License-Identifier: Apache-2.0
#include "SafeValues.h"

namespace qplc {

std::vector<char> safeFrame(const QPlcSignalTable &table, const PayloadLayout &layout)
{
    std::vector<char> bytes(layout.size(),
                            char(QPlcQuality(QPlcQuality::Safe).toByte()));  // the qualities behind the values
    for (const PayloadLayout::Field &field : layout.fields())
        table.at(field.signal).safeValue().toBytes(bytes.data() + field.offset);
    return bytes;
}

SafeImage::SafeImage(const ProcessImage &image, const std::vector<bool> &wanted)
    : m_bytes(image.totalSize())
{
    const QPlcSignalTable &table = image.table();
    for (QPlcSignalIndex signal = 0; signal < wanted.size(); ++signal) {
        if (!wanted[signal])
            continue;
        const quint32 offset = image.offset(signal);
        const auto size = quint32(table.at(signal).type.size());
        table.at(signal).safeValue().toBytes(m_bytes.data() + offset);
        add(offset, size);
    }
    for (QPlcSignalIndex signal = 0; signal < wanted.size(); ++signal) {
        if (!wanted[signal])
            continue;
        m_bytes[image.qualityOffset(signal)] = char(QPlcQuality(QPlcQuality::Safe).toByte());
        add(image.qualityOffset(signal), 1);
    }
}

void SafeImage::add(quint32 offset, quint32 size)
{
    if (!m_runs.empty() && m_runs.back().to + m_runs.back().size == offset)
        m_runs.back().size += size;  // neighbours: one copy
    else
        m_runs.push_back({offset, offset, size});
}

void SafeImage::applyTo(char *bytes) const noexcept
{
    copyRuns(m_runs, m_bytes.data(), bytes);
}

}  // namespace qplc
