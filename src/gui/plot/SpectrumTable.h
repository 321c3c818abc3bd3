// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Spectrum.h"
#include "TextTable.h"

#include <QtCore/QString>

#include <limits>
#include <vector>

namespace qplc {

/// What is seen of an axis.
struct SeenRange
{
    double begin = -std::numeric_limits<double>::infinity();
    double end = std::numeric_limits<double>::infinity();

    bool contains(double value) const { return value >= begin && value <= end; }
};

/// Spectra as text: a row for each frequency of any of them, with a value for each one that has a
/// line there.
class SpectrumTable : public TextTable
{
public:
    struct Column
    {
        QString name;
        QString unit;
        Spectrum::Lines lines;
    };

    SpectrumTable(TableText::Format format, std::vector<Column> columns, SeenRange frequencies);

    /// "frequency [Hz],force [N],speed [m/s]"
    QByteArray header() const override;
    bool isAtEnd() const override;
    QByteArray next(int mostRows) override;
    std::int64_t rows() const override { return m_rows; }

private:
    /// The frequency of the next row; infinite at the end.
    double frequency() const;
    bool hasLine(std::size_t column) const;

    TableText::Format m_format;
    std::vector<Column> m_columns;
    std::vector<std::size_t> m_lines;  // the next one of each column
    SeenRange m_frequencies;
    std::int64_t m_rows = 0;
};

/// A spectrogram as text: a row for each piece of time, with its middle, and a column for each
/// frequency.
class SpectrogramTable : public TextTable
{
public:
    struct Source
    {
        QString name;
        QString unit;            // of the densities
        std::int64_t begin = 0;  // of the first sample [ns since 1970]
        Spectrum::Picture picture;
    };

    SpectrogramTable(TableText::Format format, Source source, SeenRange times, SeenRange frequencies);

    /// "UTC,time [s],force at 0.5 Hz [N²/Hz],force at 1 Hz [N²/Hz]"
    QByteArray header() const override;
    bool isAtEnd() const override { return m_next == m_end; }
    QByteArray next(int mostRows) override;
    std::int64_t rows() const override { return m_rows; }

private:
    double time(std::size_t column) const;  // [s] since the first sample

    TableText::Format m_format;
    Source m_source;
    std::size_t m_firstLine = 0;
    std::size_t m_endLine = 0;
    std::size_t m_next = 0;  // columns of the picture
    std::size_t m_end = 0;
    std::int64_t m_rows = 0;
};

}  // namespace qplc
