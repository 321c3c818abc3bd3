// SPDX-License-Identifier: Apache-2.0
#include "RecordingTable.h"

#include "protocol/LittleEndian.h"

#include <limits>

namespace qplc {

namespace {

TableColumn columnOf(TableColumn::Kind kind, const QString &name, const QString &unit, QPlcSignalType::Scalar scalar)
{
    TableColumn column;
    column.kind = kind;
    column.name = name;
    column.unit = unit;
    column.scalar = scalar;
    return column;
}

TableColumn columnOf(const QPlcSignalDefinition &signal, int element)
{
    TableColumn column = columnOf(TableColumn::Value, signal.name, signal.unit, signal.type.scalar());
    column.element = element;
    column.count = signal.type.count();
    column.description = signal.description;
    column.capacity = signal.type.capacity();
    column.isBool = signal.typeName == QLatin1String("Bool");
    return column;
}

template<typename Number>
void append(Number number, QByteArray *numbers)
{
    char bytes[sizeof number];
    storeLittle(number, bytes);
    numbers->append(bytes, int(sizeof number));
}

/// What stands where a file does not have a signal.
void appendNothing(const TableColumn &column, QByteArray *numbers)
{
    if (column.scalar == QPlcSignalType::Real32)
        append(std::numeric_limits<float>::quiet_NaN(), numbers);
    else if (column.scalar == QPlcSignalType::Real64)
        append(std::numeric_limits<double>::quiet_NaN(), numbers);
    else
        numbers->append(int(column.size()), '\0');
}

}  // namespace

QString TableColumn::title() const
{
    if (kind == Quality)
        return name + QStringLiteral(".quality");
    return count > 1 ? QStringLiteral("%1[%2]").arg(name).arg(element) : name;
}

RecordingTable::RecordingTable(Recording &recording, const TableSelection &selection)
    : m_selection(selection)
    , m_cycles(recording, selection.signalNumbers, selection.begin, selection.end)
{
    if (recording.isTimed())
        m_columns.push_back(columnOf(TableColumn::Moment, QStringLiteral("UTC"), {}, QPlcSignalType::DateTime));
    m_columns.push_back(
        columnOf(TableColumn::Seconds, QStringLiteral("time"), QStringLiteral("s"), QPlcSignalType::Real64));
    m_columns.push_back(columnOf(TableColumn::CycleNumber, QStringLiteral("cycle"), {}, QPlcSignalType::Int64));
    m_signalOf.assign(m_columns.size(), 0);
    for (std::size_t i = 0; i < selection.signalNumbers.size(); ++i) {
        const QPlcSignalDefinition &signal = recording.signalList()[std::size_t(selection.signalNumbers[i])].definition;
        for (int element = 0; element < signal.type.count(); ++element)
            m_columns.push_back(columnOf(signal, element));
        if (selection.hasQualities)
            m_columns.push_back(columnOf(TableColumn::Quality, signal.name, {}, QPlcSignalType::UInt8));
        m_signalOf.resize(m_columns.size(), i);
    }
}

bool RecordingTable::next(TableBlock *block)
{
    block->rows = 0;
    block->columns.assign(m_columns.size(), {});
    while (block->rows < RowsOfABlock && m_cycles.next()) {
        if (m_cycles.cycle().number % m_selection.every == 0)
            addRow(block);
    }
    return block->rows > 0;
}

void RecordingTable::addRow(TableBlock *block)
{
    if (m_rows == 0)
        m_begin = m_cycles.time();
    for (std::size_t i = 0; i < m_columns.size(); ++i) {
        const TableColumn &column = m_columns[i];
        const std::size_t signal = m_signalOf[i];
        TableBlock::Values &values = block->columns[i];
        if (column.kind == TableColumn::Moment) {
            append(m_cycles.time(), &values.numbers);
        } else if (column.kind == TableColumn::Seconds) {
            append(double(m_cycles.time() - m_begin) / 1e9, &values.numbers);
        } else if (column.kind == TableColumn::CycleNumber) {
            append(m_cycles.cycle().number, &values.numbers);
        } else if (column.kind == TableColumn::Quality) {
            values.numbers.append(char(m_cycles.quality(signal).toByte()));
        } else if (column.isText()) {
            const char *text = m_cycles.value(signal);
            values.texts.push_back(text ? QByteArray(text, int(m_cycles.size(signal))) : QByteArray());
        } else if (const char *value = m_cycles.value(signal)) {
            values.numbers.append(value + std::size_t(column.element) * column.size(), int(column.size()));
        } else {
            appendNothing(column, &values.numbers);
        }
    }
    ++m_rows;
    ++block->rows;
}

TableWriter::~TableWriter() = default;

std::unique_ptr<TableWriter> TableWriter::create(const QString &format, OutputFile *file)
{
    if (format == QLatin1String("csv"))
        return makeCsvWriter(file);
    if (format == QLatin1String("parquet"))
        return makeParquetWriter(file);
#ifdef QTPLC_HAS_HDF5
    if (format == QLatin1String("mat"))
        return makeMatWriter(file);
#endif
    return nullptr;
}

QStringList TableWriter::formats()
{
    QStringList formats{QStringLiteral("csv"), QStringLiteral("parquet")};
#ifdef QTPLC_HAS_HDF5
    formats << QStringLiteral("mat");
#endif
    return formats;
}

}  // namespace qplc
