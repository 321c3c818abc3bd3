// SPDX-License-Identifier: Apache-2.0
#include "SpectrumTable.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double sameFrequency = 1.0 + 1e-9;     // a quotient: two spectra have a line there
constexpr std::size_t numbersOfPiece = 100'000;  // some milliseconds

/// The first of \a count places, each a step further, that is at or behind \a begin.
std::size_t firstFrom(double begin, double origin, double step, std::size_t count)
{
    std::size_t first = 0;
    while (first < count && origin + double(first) * step < begin)
        ++first;
    return first;
}

}  // namespace

// ---- spectra ----

SpectrumTable::SpectrumTable(TableText::Format format, std::vector<Column> columns, SeenRange frequencies)
    : m_format(format)
    , m_columns(std::move(columns))
    , m_frequencies(frequencies)
{
    for (const Column &column : m_columns)
        m_lines.push_back(firstFrom(frequencies.begin, 0.0, column.lines.step, column.lines.values.size()));
}

QByteArray SpectrumTable::header() const
{
    TableText text(m_format);
    text.addTitle(QStringLiteral("frequency"), QStringLiteral("Hz"));
    for (const Column &column : m_columns)
        text.addTitle(column.name, column.unit);
    text.endRow();
    return text.take();
}

bool SpectrumTable::hasLine(std::size_t column) const
{
    return m_lines[column] < m_columns[column].lines.values.size();
}

double SpectrumTable::frequency() const
{
    double next = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
        if (hasLine(i))
            next = std::min(next, double(m_lines[i]) * m_columns[i].lines.step);
    }
    return next;
}

bool SpectrumTable::isAtEnd() const
{
    const double next = frequency();
    return std::isinf(next) || next > m_frequencies.end;
}

QByteArray SpectrumTable::next(int mostRows)
{
    TableText text(m_format);
    for (int row = 0; row < mostRows && !isAtEnd(); ++row) {
        const double at = frequency();
        text.addNumber(at);
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            const Spectrum::Lines &lines = m_columns[i].lines;
            if (hasLine(i) && double(m_lines[i]) * lines.step <= at * sameFrequency)
                text.addNumber(lines.values[m_lines[i]++]);
            else
                text.addNothing();
        }
        text.endRow();
        ++m_rows;
    }
    return text.take();
}

// ---- spectrograms ----

SpectrogramTable::SpectrogramTable(TableText::Format format, Source source, SeenRange times, SeenRange frequencies)
    : m_format(format)
    , m_source(std::move(source))
{
    const Spectrum::Picture &picture = m_source.picture;
    m_firstLine = firstFrom(frequencies.begin, 0.0, picture.step, picture.lines);
    for (m_endLine = m_firstLine; m_endLine < picture.lines && double(m_endLine) * picture.step <= frequencies.end;)
        ++m_endLine;
    m_next = firstFrom(times.begin, time(0), picture.duration, picture.columns);
    for (m_end = m_next; m_end < picture.columns && time(m_end) <= times.end;)
        ++m_end;
}

double SpectrogramTable::time(std::size_t column) const
{
    return m_source.picture.begin + (double(column) + 0.5) * m_source.picture.duration;
}

QByteArray SpectrogramTable::header() const
{
    TableText text(m_format);
    text.addText(QStringLiteral("UTC"));
    text.addTitle(QStringLiteral("time"), QStringLiteral("s"));
    for (std::size_t line = m_firstLine; line < m_endLine; ++line) {
        const QString frequency = QString::number(double(line) * m_source.picture.step, 'g', 9);
        text.addTitle(QStringLiteral("%1 at %2 Hz").arg(m_source.name, frequency), m_source.unit);
    }
    text.endRow();
    return text.take();
}

QByteArray SpectrogramTable::next(int mostRows)
{
    TableText text(m_format);
    const std::size_t usual = numbersOfPiece / std::max<std::size_t>(m_endLine - m_firstLine, 1);
    const std::size_t most = std::clamp<std::size_t>(usual, 1, std::size_t(std::max(mostRows, 1)));
    for (std::size_t row = 0; row < most && m_next < m_end; ++row, ++m_next, ++m_rows) {
        const auto sinceBegin = std::int64_t(std::llround(time(m_next) * 1e9));
        text.addMoment(m_source.begin + sinceBegin);
        text.addSeconds(sinceBegin);
        for (std::size_t line = m_firstLine; line < m_endLine; ++line)
            text.addNumber(m_source.picture.at(m_next, line));
        text.endRow();
    }
    return text.take();
}

}  // namespace qplc
