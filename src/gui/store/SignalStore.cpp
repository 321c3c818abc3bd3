// SPDX-License-Identifier: Apache-2.0
#include "gui/store/SignalStore.h"

#include "QPlcQuality.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace qplc {

namespace {

using Row = SignalStore::Row;

constexpr SignalStore::Time periodsOfNewest = 3;
constexpr SignalStore::Time leastOfNewest = 500'000'000;  // [ns]
constexpr int binBits = 5;                                // of the first level: half the memory of bins of 16 rows
constexpr int fanOutBits = 4;                             // from there on: larger steps would be slower to draw
constexpr Row rowsOfBin = Row(1) << binBits;
constexpr Row fanOut = Row(1) << fanOutBits;
constexpr int wordBits = 64;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float noValue = std::numeric_limits<float>::quiet_NaN();
constexpr SignalStore::Range nothing{infinity, -infinity};

Row roundedUp(Row row, int bits)
{
    const Row step = Row(1) << bits;
    return (row + step - 1) & ~(step - 1);
}

Row roundedDown(Row row, int bits)
{
    return row & ~((Row(1) << bits) - 1);
}

// Each comparison with NaN is false: NaN changes nothing.
void include(SignalStore::Range *range, float minimum, float maximum)
{
    range->minimum = minimum < range->minimum ? minimum : range->minimum;
    range->maximum = maximum > range->maximum ? maximum : range->maximum;
}

std::uint64_t maskOf(std::size_t bit)
{
    return std::uint64_t(1) << (bit % wordBits);
}

/// Walks through rows or bins \a begin ... \a end - 1 of a ring, in one piece or two.
template<typename Visit>
void forPieces(std::size_t slots, Row begin, Row end, Visit visit)
{
    const auto from = std::size_t(begin % slots);
    const auto count = std::size_t(end - begin);
    const std::size_t first = std::min(count, slots - from);
    visit(from, from + first);
    visit(0, count - first);
}

/// The first of bits \a from ... \a to - 1 that is set; \a to when there is none.
std::size_t firstBit(const std::vector<std::uint64_t> &words, std::size_t from, std::size_t to)
{
    std::size_t index = from / wordBits;
    std::uint64_t word = words[index] >> (from % wordBits) << (from % wordBits);
    while (word == 0 && (index + 1) * wordBits < to)
        word = words[++index];
    std::size_t bit = std::max(from, index * wordBits);
    while (bit < to && (word & maskOf(bit)) == 0)
        bit = word == 0 ? to : bit + 1;
    return bit;
}

}  // namespace

SignalStore::SignalStore(int channels, int capacity)
    : m_channels(channels)
    , m_capacity(capacity)
    , m_rows(std::size_t(roundedUp(Row(std::max(capacity, int(rowsOfBin))), binBits)))
    , m_times(m_rows)
    , m_values(std::size_t(channels) * m_rows)
    , m_beginsAnew((m_rows + wordBits - 1) / wordBits)
    , m_marks(std::size_t(std::max(channels, 0)))
{
    assert(channels >= 0 && capacity >= 16);
    for (std::size_t size = rowsOfBin; size <= m_rows; size *= fanOut) {
        const std::size_t slots = m_rows / size;  // no more bins than that are whole
        m_levels.push_back({slots, std::vector<Range>(std::size_t(channels) * slots)});
    }
}

std::size_t SignalStore::memory() const
{
    std::size_t bytes
        = m_times.size() * sizeof(Time) + m_values.size() * sizeof(float) + m_beginsAnew.size() * sizeof(std::uint64_t);
    for (const Level &level : m_levels)
        bytes += level.bins.size() * sizeof(Range);
    for (const RowMarks &marks : m_marks)
        bytes += sizeof(marks) + marks.memory();
    return bytes;
}

bool SignalStore::append(Time time, const float *values)
{
    if (!isEmpty() && time <= this->time(m_end - 1))
        return false;
    const std::size_t at = slot(m_end);
    m_times[at] = time;
    std::uint64_t &word = m_beginsAnew[at / wordBits];
    word = m_interrupted ? word | maskOf(at) : word & ~maskOf(at);
    m_interrupted = false;
    float *value = m_values.data() + at;
    for (int channel = 0; channel < m_channels; ++channel, value += m_rows)
        *value = values[channel];
    ++m_end;
    closeBins();
    return true;
}

void SignalStore::append(const SignalStore &other, Row begin, Row end, Seam seam)
{
    std::vector<float> values(static_cast<std::size_t>(m_channels));
    for (Row row = begin; row < end; ++row) {
        if (row == begin ? seam == BeginsAnew : other.beginsAnew(row))
            interrupt();
        for (int channel = 0; channel < m_channels; ++channel)
            values[std::size_t(channel)] = other.value(channel, row);
        if (!append(other.time(row), values.data()))
            continue;
        for (int channel = 0; channel < m_channels; ++channel) {
            if (const Mark mark = other.greatestMark(channel, row, row + 1); mark != RowMarks::None)
                this->mark(channel, mark);
        }
    }
    m_interrupted = m_interrupted || (end == other.endRow() && other.m_interrupted);
}

void SignalStore::mark(int channel, Mark mark)
{
    RowMarks &marks = m_marks[std::size_t(channel)];
    marks.forgetBefore(firstRow());
    marks.mark(m_end - 1, mark);
}

void SignalStore::clear()
{
    m_begin = m_end;
    for (RowMarks &marks : m_marks)
        marks.clear();
    m_interrupted = false;
}

bool SignalStore::beginsAnew(Row row) const
{
    const std::size_t at = slot(row);
    return (m_beginsAnew[at / wordBits] & maskOf(at)) != 0;
}

Row SignalStore::nextBeginAnew(Row begin, Row end) const
{
    Row row = begin;
    bool isFound = false;
    forPieces(m_rows, begin, std::max(begin, end), [&](std::size_t from, std::size_t to) {
        if (isFound || from == to)
            return;
        const std::size_t bit = firstBit(m_beginsAnew, from, to);
        row += bit - from;
        isFound = bit < to;
    });
    return row;
}

Row SignalStore::rowAt(Time time) const
{
    Row begin = firstRow();
    for (Row count = m_end - begin; count > 0;) {
        const Row half = count / 2;
        const bool isBefore = this->time(begin + half) < time;
        begin += isBefore ? half + 1 : 0;
        count = isBefore ? count - half - 1 : half;
    }
    return begin;
}

Row SignalStore::rowAt(Time time, Row guess) const
{
    Row low = std::min(std::max(guess, firstRow()), m_end);  // in the end all rows before it are too early
    Row high = low;                                          // in the end not too early, or none
    for (Row step = 1; low > firstRow() && this->time(low - 1) >= time; step *= 2) {
        high = low - 1;
        low = low - firstRow() > step ? low - step : firstRow();
    }
    for (Row step = 1; high < m_end && this->time(high) < time; step *= 2) {
        low = high + 1;
        high = m_end - high > step ? high + step : m_end;
    }
    while (low < high) {
        const Row middle = low + (high - low) / 2;
        if (this->time(middle) < time)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

std::optional<SignalStore::Row> SignalStore::rowHoldingAt(Time time) const
{
    const std::optional<Row> row = rowUpTo(time);
    if (!row)
        return std::nullopt;
    const Time age = time - this->time(*row);
    const bool isNewest = *row + 1 == m_end;
    if (isNewest)
        return age <= std::max(periodsOfNewest * periodBefore(*row), leastOfNewest) ? row : std::nullopt;
    return !beginsAnew(*row + 1) || age == 0 || age < periodBefore(*row) ? row : std::nullopt;
}

/// From the row before to this one; 0: not known.
SignalStore::Time SignalStore::periodBefore(Row row) const
{
    return row > firstRow() && !beginsAnew(row) ? time(row) - time(row - 1) : 0;
}

float SignalStore::writtenValue(int channel, Row row) const
{
    const bool isWritten = greatestMark(channel, row, row + 1) < QPlcQuality::Safe;
    return isWritten ? value(channel, row) : std::numeric_limits<float>::quiet_NaN();
}

SignalStore::Range SignalStore::range(int channel, Row begin, Row end) const
{
    Range range = nothing;
    const Level *level = nullptr;  // null: single rows
    const auto add = [&](Row from, Row to) {
        if (from < to)
            level ? includeBins(&range, *level, channel, from, to) : includeValues(&range, channel, from, to);
    };
    for (const Level &coarser : m_levels) {
        const int bits = level ? fanOutBits : binBits;
        const Row first = roundedUp(begin, bits);
        const Row last = roundedDown(end, bits);
        if (first >= last)
            break;
        add(begin, first);
        add(last, end);
        begin = first >> bits;
        end = last >> bits;
        level = &coarser;
    }
    add(begin, end);
    return range.isEmpty() ? Range{noValue, noValue} : range;
}

void SignalStore::prefetch(int channel, Row row) const
{
    constexpr std::size_t lineSize = 64;  // [byte]
    const auto fetch = [](const auto *begin, std::size_t count) {
        const auto *bytes = reinterpret_cast<const char *>(begin);
        for (std::size_t line = 0; line < count * sizeof(*begin); line += lineSize)
            __builtin_prefetch(bytes + line);
    };
    const std::size_t bin = slot(row) >> binBits;
    const Level &level = m_levels.front();
    fetch(m_values.data() + std::size_t(channel) * m_rows + (bin << binBits), rowsOfBin);
    fetch(level.bins.data() + std::size_t(channel) * level.slots + (bin & ~(fanOut - 1)), fanOut);
}

void SignalStore::includeValues(Range *range, int channel, Row begin, Row end) const
{
    const float *values = m_values.data() + std::size_t(channel) * m_rows;
    forPieces(m_rows, begin, end, [=](std::size_t from, std::size_t to) {
        Range even = *range;
        Range odd = nothing;
        std::size_t i = from;
        for (; i + 1 < to; i += 2) {  // two chains, so that comparisons need not wait for each other
            include(&even, values[i], values[i]);
            include(&odd, values[i + 1], values[i + 1]);
        }
        if (i < to)
            include(&even, values[i], values[i]);
        include(&even, odd.minimum, odd.maximum);
        *range = even;
    });
}

void SignalStore::includeBins(Range *range, const Level &level, int channel, Row begin, Row end) const
{
    const Range *bins = level.bins.data() + std::size_t(channel) * level.slots;
    forPieces(level.slots, begin, end, [=](std::size_t from, std::size_t to) {
        Range piece = *range;
        for (std::size_t i = from; i < to; ++i)
            include(&piece, bins[i].minimum, bins[i].maximum);
        *range = piece;
    });
}

/// Writes the bins whose last row is the one before endRow().
void SignalStore::closeBins()
{
    Row end = m_end;
    const Level *finer = nullptr;  // null: single rows
    for (Level &level : m_levels) {
        const int bits = finer ? fanOutBits : binBits;
        const Row size = Row(1) << bits;
        if (end % size != 0)
            return;
        const Row begin = end - size;
        end >>= bits;
        Range *bin = level.bins.data() + (end - 1) % level.slots;
        for (int channel = 0; channel < m_channels; ++channel, bin += level.slots) {
            *bin = nothing;
            finer ? includeBins(bin, *finer, channel, begin, begin + size)
                  : includeValues(bin, channel, begin, begin + size);
        }
        finer = &level;
    }
}

}  // namespace qplc
