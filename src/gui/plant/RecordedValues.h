// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantValues.h"
#include "recording/Recording.h"

namespace qplc {

/// Copies rows of a recording into the values of a plant, signal by signal: its table may be
/// another one. A signal that the recording does not have is invalid.
class RecordedValues
{
public:
    RecordedValues(const Recording &recording, const QPlcSignalTable &table);

    /// Those that store() needs.
    const std::vector<int> &columns() const { return m_columns; }
    /// \param rows  with these columns \param time on the clock of the window [ns]
    /// \param values  with the table
    void store(const RecordedRows &rows, PlantValues::Time time, PlantValues *values);

private:
    static constexpr int NoColumn = -1;

    std::vector<int> m_columns;
    std::vector<int> m_places;  // in the columns, of each signal of the table
    std::vector<char> m_payload;
    std::vector<char> m_qualities;
};

}  // namespace qplc
