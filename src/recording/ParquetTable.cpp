// SPDX-License-Identifier: Apache-2.0
// Apache Parquet (https://parquet.apache.org/docs/file-format/): row groups of columns, each of
// them one page in the encoding PLAIN, compressed with Zstandard; behind them a footer in the
// compact protocol of Thrift.
#include "RecordingTable.h"

#include "McapFormat.h"

#include <algorithm>

#include <zstd.h>

namespace qplc {

namespace {

const QByteArray magic = QByteArrayLiteral("PAR1");
constexpr qint64 FullGroup = 32 << 20;  // [byte] of values in memory
constexpr int ZstdCodec = 6;
constexpr int ZstdLevel = 1;
constexpr int Plain = 0;
constexpr int Rle = 3;

/// A struct of Thrift: fields of growing numbers.
class Thrift
{
public:
    Thrift &integer(int field, qint64 value, bool isLong = false)
    {
        return head(field, isLong ? 6 : 5).varint(quint64(value) << 1 ^ quint64(value >> 63));
    }
    Thrift &boolean(int field, bool value) { return head(field, value ? 1 : 2); }
    Thrift &text(int field, const QByteArray &value)
    {
        head(field, 8).varint(quint64(value.size()));
        m_bytes += value;
        return *this;
    }
    Thrift &structure(int field, const Thrift &value)
    {
        head(field, 12);
        m_bytes += value.bytes();
        return *this;
    }
    Thrift &structures(int field, const std::vector<Thrift> &values)
    {
        list(field, values.size(), 12);
        for (const Thrift &value : values)
            m_bytes += value.bytes();
        return *this;
    }
    Thrift &integers(int field, const std::vector<int> &values)
    {
        list(field, values.size(), 5);
        for (const int value : values)
            varint(quint64(value) << 1);
        return *this;
    }
    Thrift &texts(int field, const std::vector<QByteArray> &values)
    {
        list(field, values.size(), 8);
        for (const QByteArray &value : values) {
            varint(quint64(value.size()));
            m_bytes += value;
        }
        return *this;
    }
    QByteArray bytes() const { return m_bytes + '\0'; }

private:
    Thrift &head(int field, int type)
    {
        m_bytes += char((field - m_last) << 4 | type);
        m_last = field;
        return *this;
    }
    Thrift &varint(quint64 value)
    {
        for (; value >= 0x80; value >>= 7)
            m_bytes += char(value | 0x80);
        m_bytes += char(value);
        return *this;
    }
    void list(int field, std::size_t count, int type)
    {
        head(field, 9);
        if (count < 15) {
            m_bytes += char(count << 4 | std::size_t(type));
        } else {
            m_bytes += char(0xF0 | type);
            varint(count);
        }
    }

    QByteArray m_bytes;
    int m_last = 0;
};

struct ParquetType
{
    int physical;
    int converted;  // -1: none
};

enum Physical { Boolean = 0, Int32 = 1, Int64 = 2, Float = 4, Double = 5, ByteArray = 6 };

ParquetType parquetTypeOf(const TableColumn &column)
{
    if (column.isBool)
        return {Boolean, -1};
    switch (column.scalar) {
    case QPlcSignalType::Int8:
        return {Int32, 15};
    case QPlcSignalType::Int16:
        return {Int32, 16};
    case QPlcSignalType::Int32:
        return {Int32, -1};
    case QPlcSignalType::Int64:
        return {Int64, -1};
    case QPlcSignalType::UInt8:
        return {Int32, 11};
    case QPlcSignalType::UInt16:
        return {Int32, 12};
    case QPlcSignalType::UInt32:
        return {Int32, 13};
    case QPlcSignalType::UInt64:
        return {Int64, 14};
    case QPlcSignalType::Real32:
        return {Float, -1};
    case QPlcSignalType::Real64:
        return {Double, -1};
    case QPlcSignalType::String:
        return {ByteArray, 0};
    default:
        return {Int64, -1};
    }
}

/// Numbers of one or two bytes become such of four.
template<typename Number>
QByteArray widened(const QByteArray &numbers)
{
    mcap::Fields wide;
    for (int at = 0; at < numbers.size(); at += int(sizeof(Number)))
        wide.number(qint32(loadLittle<Number>(numbers.constData() + at)));
    return wide.bytes();
}

/// The values of a page in the encoding PLAIN.
QByteArray plain(const TableColumn &column, const TableBlock::Values &values)
{
    const QByteArray &numbers = values.numbers;
    if (column.isBool) {
        QByteArray bits((numbers.size() + 7) / 8, '\0');
        for (int i = 0; i < numbers.size(); ++i)
            bits[i / 8] = char(bits.at(i / 8) | (numbers.at(i) != 0 ? 1 << i % 8 : 0));
        return bits;
    }
    if (column.isText()) {
        mcap::Fields texts;
        for (const QByteArray &text : values.texts)
            texts.text(text);
        return texts.bytes();
    }
    switch (column.scalar) {
    case QPlcSignalType::Int8:
        return widened<std::int8_t>(numbers);
    case QPlcSignalType::UInt8:
        return widened<std::uint8_t>(numbers);
    case QPlcSignalType::Int16:
        return widened<std::int16_t>(numbers);
    case QPlcSignalType::UInt16:
        return widened<std::uint16_t>(numbers);
    default:
        return numbers;
    }
}

QByteArray compressed(const QByteArray &bytes)
{
    QByteArray result(int(ZSTD_compressBound(std::size_t(bytes.size()))), Qt::Uninitialized);
    const std::size_t size = ZSTD_compress(result.data(), std::size_t(result.size()), bytes.constData(),
                                           std::size_t(bytes.size()), ZstdLevel);
    result.truncate(ZSTD_isError(size) != 0 ? 0 : int(size));
    return result;
}

class ParquetWriter final : public TableWriter
{
public:
    explicit ParquetWriter(OutputFile *file)
        : m_file(*file)
    {
    }

    bool begin(const std::vector<TableColumn> &columns, QString *error) override
    {
        m_columns = columns;
        for (const TableColumn &column : columns)
            m_names.push_back(uniqueName(column.title().toUtf8()));
        clear();
        return m_file.write(magic, error);
    }
    bool add(const TableBlock &block, QString *error) override
    {
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            const TableBlock::Values &values = block.columns[i];
            m_group.columns[i].numbers += values.numbers;
            m_bytes += values.numbers.size();
            for (const QByteArray &text : values.texts) {
                m_group.columns[i].texts.push_back(text);
                m_bytes += text.size() + int(sizeof text);
            }
        }
        m_group.rows += block.rows;
        return m_bytes < FullGroup || writeGroup(error);
    }
    bool end(QString *error) override
    {
        if (m_group.rows > 0 && !writeGroup(error))
            return false;
        std::vector<Thrift> schema{Thrift().text(4, "recording").integer(5, qint64(m_columns.size()))};
        for (std::size_t i = 0; i < m_columns.size(); ++i)
            schema.push_back(schemaOf(m_columns[i], m_names[i]));
        Thrift meta;
        meta.integer(1, 1).structures(2, schema).integer(3, m_rows, true).structures(4, m_groups).text(6, "QtPLC");
        const QByteArray footer = meta.bytes();
        return m_file.write(footer + mcap::Fields().number(quint32(footer.size())).bytes() + magic, error);
    }

private:
    /// A signal may have the name of a column that each table has.
    QByteArray uniqueName(const QByteArray &title) const
    {
        QByteArray name = title;
        for (int i = 2; std::find(m_names.begin(), m_names.end(), name) != m_names.end(); ++i)
            name = title + '_' + QByteArray::number(i);
        return name;
    }
    static Thrift schemaOf(const TableColumn &column, const QByteArray &name)
    {
        constexpr int required = 0;
        const ParquetType type = parquetTypeOf(column);
        Thrift schema;
        schema.integer(1, type.physical).integer(3, required).text(4, name);
        if (type.converted >= 0)
            schema.integer(6, type.converted);
        if (column.scalar == QPlcSignalType::DateTime)  // nanoseconds, UTC
            schema.structure(10,
                             Thrift().structure(8, Thrift().boolean(1, true).structure(2, Thrift().structure(3, {}))));
        return schema;
    }
    void clear()
    {
        m_group.rows = 0;
        m_group.columns.assign(m_columns.size(), {});
        m_bytes = 0;
    }
    bool writeGroup(QString *error)
    {
        std::vector<Thrift> chunks;
        qint64 all = 0;
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            const QByteArray values = plain(m_columns[i], m_group.columns[i]);
            const QByteArray packed = compressed(values);
            Thrift data;
            data.integer(1, m_group.rows).integer(2, Plain).integer(3, Rle).integer(4, Rle);
            Thrift page;
            page.integer(1, 0).integer(2, values.size()).integer(3, packed.size()).structure(5, data);
            const QByteArray head = page.bytes();
            const qint64 place = m_file.size();
            if (!m_file.write(head + packed, error))
                return false;
            Thrift meta;
            meta.integer(1, parquetTypeOf(m_columns[i]).physical)
                .integers(2, {Plain})
                .texts(3, {m_names[i]})
                .integer(4, ZstdCodec)
                .integer(5, m_group.rows, true)
                .integer(6, head.size() + values.size(), true)
                .integer(7, head.size() + packed.size(), true)
                .integer(9, place, true);
            chunks.push_back(Thrift().integer(2, place, true).structure(3, meta));
            all += head.size() + values.size();
        }
        m_groups.push_back(Thrift().structures(1, chunks).integer(2, all, true).integer(3, m_group.rows, true));
        m_rows += m_group.rows;
        clear();
        return true;
    }

    OutputFile &m_file;
    std::vector<TableColumn> m_columns;
    std::vector<QByteArray> m_names;  // of the columns
    TableBlock m_group;
    qint64 m_bytes = 0;
    qint64 m_rows = 0;
    std::vector<Thrift> m_groups;
};

}  // namespace

std::unique_ptr<TableWriter> makeParquetWriter(OutputFile *file)
{
    return std::make_unique<ParquetWriter>(file);
}

}  // namespace qplc
