// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace qplc {

/// The past of many channels with common times, in constant memory: a ring of rows, a row being one time and one value for each channel.
///
/// Rows are numbered from 0 on for ever; those of firstRow() ... endRow() - 1 are kept. A value is a 32-bit real, NaN where there was none: curves are interrupted there, as they are at a row
/// that begins after a gap. For each 16, 256, ... rows, counted from row 0 and so never shifting, smallest and largest value are kept, so that a range of a million rows
/// costs as much as one of a thousand.
///
/// Memory: 4.6 bytes for each value, 9 bytes for each row, all of it taken at the begin. One thread.
class SignalStore
{
public:
    using Row = std::uint64_t;
    using Time = std::int64_t;  // [ns] on the clock of the plant

    struct Range
    {
        float minimum;            // NaN: no value
        float maximum;
        bool isEmpty() const { return !(minimum <= maximum); }
    };

    /// \param channels  >= 0
    /// \param capacity  rows that are kept at least, >= 16
    SignalStore(int channels, int capacity);

    int channels() const { return m_channels; }
    int capacity() const { return m_capacity; }

    /// Adds a row. \param time  after that of the row before, else the row is not taken
    /// \param values  one for each channel
    /// \return whether it was taken
    bool append(Time time, const float *values);
    /// What is appended next does not continue what is there.
    void interrupt() { m_interrupted = true; }
    void clear();

    bool isEmpty() const { return m_end == firstRow(); }
    Row firstRow() const;
    Row endRow() const { return m_end; }
    /// \pre the row is kept, as for all that follows
    Time time(Row row) const;
    /// Whether the row begins after an interruption: no line leads to it.
    bool beginsAnew(Row row) const;
    float value(int channel, Row row) const;
    /// The first row at or after \a time; endRow() when there is none.
    Row rowAt(Time time) const;
    /// Smallest and largest value of rows \a begin ... \a end - 1; NaN counts as nothing.
    Range range(int channel, Row begin, Row end) const;

private:
    int m_channels;
    int m_capacity;
    Row m_end = 0;
    bool m_interrupted = false;
};

}  // namespace qplc
