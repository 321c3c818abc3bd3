// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/store/RowMarks.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace qplc {

/// The past of many channels with common times, in constant memory: a ring of rows, a row being one
/// time and one value for each channel.
///
/// Rows are numbered from 0 on for ever; those of firstRow() ... endRow() - 1 are kept. A value is
/// a 32-bit real, NaN where there was none: curves are interrupted there, as they are at a row that
/// begins after a gap. For each 32, 512, ... rows, counted from row 0 and so never shifting,
/// smallest and largest value are kept, so that a range of a million rows costs as much as one of a
/// thousand. Single values can have a mark that says in which way they are not like others: the
/// kind of their quality (QPlcQuality).
///
/// Memory: 4.3 bytes for each value, 9 bytes for each row, all of it taken at the begin; up to 8
/// KiB more for a channel with marks. One thread.
class SignalStore
{
public:
    using Row = std::uint64_t;
    using Time = std::int64_t;  // [ns] on the clock of the plant
    static constexpr Time Second = 1'000'000'000;
    using Mark = RowMarks::Mark;

    struct Range
    {
        float minimum;  // NaN: no value
        float maximum;
        bool isEmpty() const { return !(minimum <= maximum); }
    };

    /// \param channels  >= 0
    /// \param capacity  rows that are kept at least, >= 16
    SignalStore(int channels, int capacity);

    int channels() const { return m_channels; }
    int capacity() const { return m_capacity; }
    /// What rows, values and their bins take [bytes], whether there are rows or not.
    std::size_t memory() const;

    /// Adds a row. \param time after that of the row before, else the row is not taken; a clock
    /// that begins again needs clear()
    /// \param values  one for each channel
    /// \return whether it was taken
    bool append(Time time, const float *values);
    enum Seam { BeginsAnew, Continues };
    /// Adds rows \a begin ... \a end - 1 of a store with the same channels. Those not after the
    /// newest one are not taken. \param seam  whether the first one continues what is there
    void append(const SignalStore &other, Row begin, Row end, Seam seam);
    void append(const SignalStore &other, Seam seam) { append(other, other.firstRow(), other.endRow(), seam); }
    /// Marks the value of a channel in the newest row. \param mark  above 0
    void mark(int channel, Mark mark);
    /// What is appended next does not continue what is there.
    void interrupt() { m_interrupted = true; }
    /// Rows are not those of cycles: two in turn have the smallest and the largest value of an
    /// interval.
    void setOverview() { m_isOverview = true; }
    bool isOverview() const { return m_isOverview; }
    /// Forgets all rows. Their numbers are not given again, and any time may follow.
    void clear();

    bool isEmpty() const { return m_end == firstRow(); }
    Row firstRow() const { return m_begin + m_rows < m_end ? m_end - m_rows : m_begin; }
    Row endRow() const { return m_end; }
    /// \pre the row is kept, as for all that follows
    Time time(Row row) const { return m_times[slot(row)]; }
    /// Whether the row begins after an interruption: no line leads to it.
    bool beginsAnew(Row row) const;
    /// The first row of \a begin ... \a end - 1 that begins after an interruption; \a end when
    /// there is none.
    Row nextBeginAnew(Row begin, Row end) const;
    float value(int channel, Row row) const { return m_values[std::size_t(channel) * m_rows + slot(row)]; }
    /// The value that the writer of the signal gave; NaN where another one stands in for it, as a
    /// mark of QPlcQuality::Safe or above says.
    float writtenValue(int channel, Row row) const;
    /// The first row at or after \a time; endRow() when there is none.
    Row rowAt(Time time) const;
    /// The same, in few steps when the row is near \a guess, firstRow() ... endRow().
    Row rowAt(Time time, Row guess) const;
    /// The last row at or before \a time; none when it is before all that is kept.
    std::optional<Row> rowUpTo(Time time) const
    {
        const Row behind = rowAt(time + 1);
        return behind > firstRow() ? std::optional<Row>(behind - 1) : std::nullopt;
    }
    std::optional<Row> newestRow() const { return isEmpty() ? std::nullopt : std::optional<Row>(m_end - 1); }
    /// Of the newest row; 0: there is none.
    Time newestTime() const { return isEmpty() ? 0 : time(m_end - 1); }
    /// The row whose values are those of \a time: the last one up to it, until the next row comes.
    /// Not across an interruption: the last row before one holds for a period. The newest row holds
    /// for as long as values of a running plant may be old: three periods, at least half a second.
    std::optional<Row> rowHoldingAt(Time time) const;
    /// Smallest and largest value of rows \a begin ... \a end - 1; NaN counts as nothing.
    Range range(int channel, Row begin, Row end) const;
    /// A range that begins or ends about \a row is wanted soon: what it needs comes from memory
    /// meanwhile.
    void prefetch(int channel, Row row) const;
    /// The greatest mark of rows \a begin ... \a end - 1; 0: there is none. May be above 0 for rows
    /// between very many marked ones.
    Mark greatestMark(int channel, Row begin, Row end) const
    {
        const RowMarks &marks = m_marks[std::size_t(channel)];
        return marks.isEmpty() ? RowMarks::None : marks.greatest(begin, end);
    }

private:
    /// Smallest and largest values of as many rows, of all channels. A bin is written when its last
    /// row is there, and overwritten after its first row has gone: each bin whose rows are all kept
    /// is right.
    struct Level
    {
        std::size_t slots;        // bins of a channel
        std::vector<Range> bins;  // channel after channel
    };

    Time periodBefore(Row row) const;
    std::size_t slot(Row row) const { return std::size_t(row % m_rows); }
    void closeBins();
    void includeValues(Range *range, int channel, Row begin, Row end) const;
    void includeBins(Range *range, const Level &level, int channel, Row begin, Row end) const;

    int m_channels;
    int m_capacity;
    std::size_t m_rows;                       // the capacity, rounded up to whole bins of 32 rows
    std::vector<Time> m_times;                // [rows]
    std::vector<float> m_values;              // [channels x rows], channel after channel
    std::vector<std::uint64_t> m_beginsAnew;  // a bit for each row
    std::vector<RowMarks> m_marks;            // of each channel
    std::vector<Level> m_levels;              // bins of 32, 512, ... rows
    Row m_begin = 0;                          // the first row since clear()
    Row m_end = 0;
    bool m_interrupted = false;
    bool m_isOverview = false;
};

}  // namespace qplc
