// SPDX-License-Identifier: Apache-2.0
#include "RecordingTable.h"

#include "protocol/LittleEndian.h"
#include "signals/TableText.h"

namespace qplc {

namespace {

constexpr int NanosecondDigits = 9;

void addNumber(const TableColumn &column, const char *value, TableText *text)
{
    switch (column.scalar) {
    case QPlcSignalType::Int8:
        return text->addNumber(int(loadLittle<std::int8_t>(value)));
    case QPlcSignalType::UInt8:
        return text->addNumber(int(loadLittle<std::uint8_t>(value)));
    case QPlcSignalType::Int16:
        return text->addNumber(loadLittle<std::int16_t>(value));
    case QPlcSignalType::UInt16:
        return text->addNumber(loadLittle<std::uint16_t>(value));
    case QPlcSignalType::Int32:
        return text->addNumber(loadLittle<std::int32_t>(value));
    case QPlcSignalType::UInt32:
        return text->addNumber(loadLittle<std::uint32_t>(value));
    case QPlcSignalType::Int64:
        return text->addNumber(loadLittle<std::int64_t>(value));
    case QPlcSignalType::UInt64:
        return text->addNumber(loadLittle<std::uint64_t>(value));
    case QPlcSignalType::Real32:
        return text->addNumber(loadLittle<float>(value));
    case QPlcSignalType::Real64:
        return text->addNumber(loadLittle<double>(value));
    default:
        return text->addMoment(loadLittle<std::int64_t>(value),
                               column.kind == TableColumn::Moment ? 6 : NanosecondDigits);
    }
}

/// As the window writes its curves, with the number of each cycle and the qualities.
class CsvWriter final : public TableWriter
{
public:
    explicit CsvWriter(OutputFile *file)
        : m_file(*file)
    {
    }

    bool begin(const std::vector<TableColumn> &columns, QString *error) override
    {
        m_columns = columns;
        TableText text(TableText::Csv);
        for (const TableColumn &column : columns)
            text.addTitle(column.title(), column.unit);
        text.endRow();
        return m_file.write(text.text(), error);
    }
    bool add(const TableBlock &block, QString *error) override
    {
        TableText text(TableText::Csv);
        for (int row = 0; row < block.rows; ++row) {
            for (std::size_t i = 0; i < m_columns.size(); ++i) {
                const TableBlock::Values &values = block.columns[i];
                if (m_columns[i].isText())
                    text.addText(QString::fromUtf8(values.texts[std::size_t(row)]));
                else
                    addNumber(m_columns[i], values.numbers.constData() + std::size_t(row) * m_columns[i].size(), &text);
            }
            text.endRow();
        }
        return m_file.write(text.text(), error);
    }
    bool end(QString * /*error*/) override { return true; }

private:
    OutputFile &m_file;
    std::vector<TableColumn> m_columns;
};

}  // namespace

std::unique_ptr<TableWriter> makeCsvWriter(OutputFile *file)
{
    return std::make_unique<CsvWriter>(file);
}

}  // namespace qplc
