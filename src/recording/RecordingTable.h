// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "OutputFile.h"
#include "Recording.h"

namespace qplc {

/// A column of a table: time or number of the cycles, an element of a signal, or its quality.
struct TableColumn
{
    enum Kind : std::uint8_t { Moment, Seconds, CycleNumber, Value, Quality };

    Kind kind = Value;
    QString name;  // of the signal, without the element
    int element = 0;
    int count = 1;  // elements of the signal
    QString unit;
    QString description;
    QPlcSignalType::Scalar scalar = QPlcSignalType::Invalid;
    int capacity = 0;  // [byte] of a text
    bool isBool = false;

    /// "force[1]", "force.quality"
    QString title() const;
    /// [byte] of a number
    std::size_t size() const { return std::size_t(QPlcSignalType(scalar).elementSize()); }
    bool isText() const { return scalar == QPlcSignalType::String; }
};

/// Rows of a table, column by column.
struct TableBlock
{
    struct Values
    {
        QByteArray numbers;             // little-endian, one behind the other
        std::vector<QByteArray> texts;  // of a text
    };

    int rows = 0;
    std::vector<Values> columns;
};

/// What of a recording goes into a table.
struct TableSelection
{
    std::vector<int> signalNumbers;  // of Recording::signalList()
    RecordedTime begin = 0;
    RecordedTime end = 0;
    std::uint64_t every = 1;   // one cycle of so many: those whose number it divides
    bool hasQualities = true;  // a column for each signal
};

/// A recording as a table with a row for each cycle.
///
/// A value that is in none of the files has the quality Invalid: NaN, 0, or an empty text.
class RecordingTable
{
public:
    static constexpr int RowsOfABlock = 4096;

    RecordingTable(Recording &recording, const TableSelection &selection);

    const std::vector<TableColumn> &columns() const { return m_columns; }
    /// The next rows. \return false when there are none left
    bool next(TableBlock *block);
    std::uint64_t rows() const { return m_rows; }
    int damages() const { return m_cycles.damages(); }

private:
    void addRow(TableBlock *block);

    TableSelection m_selection;
    std::vector<TableColumn> m_columns;
    std::vector<std::size_t> m_signalOf;  // of each column, in the selection
    RecordedRows m_cycles;
    RecordedTime m_begin = 0;  // of the first row
    std::uint64_t m_rows = 0;
};

/// Writes a table into a file of some format.
class TableWriter
{
public:
    virtual ~TableWriter();
    virtual bool begin(const std::vector<TableColumn> &columns, QString *error) = 0;
    virtual bool add(const TableBlock &block, QString *error) = 0;
    virtual bool end(QString *error) = 0;

    /// \param file  open; outlives the writer
    /// \param format "csv", "mat" or "parquet". \return null when there is no such format here
    static std::unique_ptr<TableWriter> create(const QString &format, OutputFile *file);
    /// Those of this build.
    static QStringList formats();
};

std::unique_ptr<TableWriter> makeCsvWriter(OutputFile *file);
std::unique_ptr<TableWriter> makeParquetWriter(OutputFile *file);
std::unique_ptr<TableWriter> makeMatWriter(OutputFile *file);

}  // namespace qplc
