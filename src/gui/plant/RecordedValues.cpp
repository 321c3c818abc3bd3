// SPDX-License-Identifier: Apache-2.0
#include "RecordedValues.h"

#include <algorithm>

namespace qplc {

RecordedValues::RecordedValues(const Recording &recording, const QPlcSignalTable &table)
    : m_payload(std::size_t(ChannelMap(table).payloadSize()), char(0))
    , m_qualities(std::size_t(table.size()), char(0))
{
    for (const QPlcSignalDefinition &definition : table) {
        const int column = recording.indexOf(definition.name);
        const bool isThere = column >= 0 && recording.table().at(QPlcSignalIndex(column)).type == definition.type;
        m_places.push_back(isThere ? int(m_columns.size()) : NoColumn);
        if (isThere)
            m_columns.push_back(column);
    }
}

void RecordedValues::store(const RecordedRows &rows, PlantValues::Time time, PlantValues *values)
{
    const QPlcSignalTable &table = values->table();
    for (QPlcSignalIndex signal = 0; signal < table.size(); ++signal) {
        char *place = m_payload.data() + values->channels().offset(signal);
        const auto size = std::size_t(table.at(signal).type.size());
        const int column = m_places[signal];
        const char *bytes = column == NoColumn ? nullptr : rows.value(std::size_t(column));
        const std::size_t known = bytes ? std::min<std::size_t>(rows.size(std::size_t(column)), size) : 0;
        std::copy_n(bytes, known, place);
        std::fill(place + known, place + size, char(0));
        const QPlcQuality quality = bytes ? rows.quality(std::size_t(column)) : QPlcQuality(QPlcQuality::Invalid);
        m_qualities[signal] = char(quality.toByte());
    }
    values->storeRow(m_payload.data(), time, m_qualities.data());
}

}  // namespace qplc
