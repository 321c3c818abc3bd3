// SPDX-License-Identifier: Apache-2.0
#include "PayloadLayout.h"

#include "TypeNames.h"

namespace qplc {

PayloadLayout::PayloadLayout(const QPlcSignalTable &table, const QVector<QPlcSignalIndex> &signalIndices,
                             Qualities qualities)
{
    m_fields.reserve(std::size_t(signalIndices.size()));
    TypeNames names;
    for (const QPlcSignalIndex index : signalIndices) {
        const QPlcSignalDefinition &signal = table.at(index);
        m_fields.push_back({index, m_size, signal.type});
        m_hash = fnv1a64(signal.name.toUtf8(), m_hash);
        m_hash = fnv1a64(':' + names.of(signal.type).toUtf8() + '@' + QByteArray::number(m_size) + '\n', m_hash);
        m_size += quint32(signal.type.size());
    }
    m_valueSize = m_size;
    if (qualities == WithoutQualities || m_fields.empty())
        return;
    m_hash = fnv1a64("qualities@" + QByteArray::number(m_valueSize) + '\n', m_hash);
    m_size += quint32(m_fields.size());
}

std::vector<quint32> PayloadLayout::partBorders(quint32 maximum) const
{
    std::vector<quint32> borders = {0};
    for (const Field &field : m_fields) {
        const bool fits = field.offset + quint32(field.type.size()) - borders.back() <= maximum;
        if (!fits && field.offset > borders.back())
            borders.push_back(field.offset);
    }
    if (hasQualities() && m_valueSize - borders.back() > maximum)
        borders.push_back(m_valueSize);
    while (hasQualities() && m_size - borders.back() > maximum)
        borders.push_back(borders.back() + maximum);
    borders.push_back(m_size);
    return borders;
}

}  // namespace qplc
