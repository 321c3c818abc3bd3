// SPDX-License-Identifier: Apache-2.0
// MATLAB 7.3: a file of HDF5 behind a header of 512 bytes. Each signal is a variable, with a column
// for each element; the struct `quality` has the qualities.
#include "RecordingTable.h"

#include <QtCore/QSet>

#include <hdf5.h>

namespace qplc {

namespace {

constexpr int HeaderSize = 512;
constexpr int HeaderTextSize = 116;
constexpr int LongestName = 63;
constexpr unsigned Deflate = 1;

/// An identifier of HDF5 that is closed with this object.
class Handle
{
public:
    Handle(hid_t id, herr_t (*closing)(hid_t))
        : m_id(id)
        , m_close(closing)
    {
    }
    Handle(Handle &&other) noexcept
        : m_id(std::exchange(other.m_id, -1))
        , m_close(other.m_close)
    {
    }
    Handle &operator=(Handle &&) = delete;
    ~Handle() { close(); }
    /// Leaves it open: after an error, HDF5 crashes where it closes what it could not write.
    void abandon() { m_id = -1; }
    bool close() { return m_id < 0 || m_close(std::exchange(m_id, -1)) >= 0; }
    operator hid_t() const { return m_id; }  // NOLINT: as the functions of HDF5 take it

private:
    hid_t m_id;
    herr_t (*m_close)(hid_t);
};

/// A name that MATLAB allows for a variable: \a name with other characters as `_`, at most 63,
/// unique among \a used.
QByteArray variableName(const QString &name, QSet<QByteArray> *used)
{
    static const QSet<QByteArray> keywords{
        "break",    "case",   "catch", "classdef", "continue",  "else",   "elseif",     "end",    "for",
        "function", "global", "if",    "import",   "otherwise", "parfor", "persistent", "return", "spmd",
        "switch",   "try",    "while", "cycle",    "quality",   "time",   "utc_ns"};
    QSet<QByteArray> taken = *used;
    QByteArray plain = rosFieldName(name, &taken).left(LongestName);
    if (keywords.contains(plain))
        plain = "s_" + plain.left(LongestName - 2);
    QByteArray unique = plain;
    for (int i = 2; used->contains(unique); ++i) {
        const QByteArray suffix = '_' + QByteArray::number(i);
        unique = plain.left(LongestName - suffix.size()) + suffix;
    }
    used->insert(unique);
    return unique;
}

/// The type of a column in the file, and the class that MATLAB gives it.
struct MatType
{
    hid_t type;
    const char *name;
    bool isDecoded = false;  // stored as an integer, but is none
};

MatType matTypeOf(const TableColumn &column)
{
    if (column.isBool)
        return {H5T_STD_U8LE, "logical", true};
    switch (column.scalar) {
    case QPlcSignalType::Int8:
        return {H5T_STD_I8LE, "int8"};
    case QPlcSignalType::Int16:
        return {H5T_STD_I16LE, "int16"};
    case QPlcSignalType::Int32:
        return {H5T_STD_I32LE, "int32"};
    case QPlcSignalType::UInt8:
        return {H5T_STD_U8LE, "uint8"};
    case QPlcSignalType::UInt16:
        return {H5T_STD_U16LE, "uint16"};
    case QPlcSignalType::UInt32:
        return {H5T_STD_U32LE, "uint32"};
    case QPlcSignalType::UInt64:
        return {H5T_STD_U64LE, "uint64"};
    case QPlcSignalType::Real32:
        return {H5T_IEEE_F32LE, "single"};
    case QPlcSignalType::Real64:
        return {H5T_IEEE_F64LE, "double"};
    case QPlcSignalType::String:
        return {H5T_STD_U16LE, "char", true};
    default:
        return {H5T_STD_I64LE, "int64"};
    }
}

bool addText(hid_t object, const char *name, const QByteArray &text)
{
    if (text.isEmpty())
        return true;
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    if (H5Tset_size(type, std::size_t(text.size())) < 0)
        return false;
    const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    return attribute >= 0 && H5Awrite(attribute, type, text.constData()) >= 0;
}

bool addDecode(hid_t object, int value)
{
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(object, "MATLAB_int_decode", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    return attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT, &value) >= 0;
}

/// A text as UTF-16 with blanks behind it, as MATLAB has the rows of a matrix of characters.
QByteArray charsOf(const QByteArray &text, int width)
{
    const QString padded = QString::fromUtf8(text).leftJustified(width, QLatin1Char(' '), true);
    QByteArray bytes;
    for (const QChar c : padded) {
        bytes += char(c.unicode() & 0xFF);
        bytes += char(c.unicode() >> 8);
    }
    return bytes;
}

class MatWriter final : public TableWriter
{
public:
    explicit MatWriter(OutputFile *output)
        : m_output(*output)
    {
        H5dont_atexit();  // see Handle::abandon()
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    bool begin(const std::vector<TableColumn> &columns, QString *error) override
    {
        m_columns = columns;
        const Handle properties(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
        const QByteArray name = QFile::encodeName(m_output.temporaryName());
        if (H5Pset_userblock(properties, HeaderSize) < 0)
            return fail(error);
        m_file
            = std::make_unique<Handle>(H5Fcreate(name.constData(), H5F_ACC_TRUNC, properties, H5P_DEFAULT), H5Fclose);
        if (*m_file < 0)
            return fail(error);
        m_quality
            = std::make_unique<Handle>(H5Gcreate2(*m_file, "quality", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
        if (*m_quality < 0 || !addText(*m_quality, "MATLAB_class", "struct"))
            return fail(error);
        QSet<QByteArray> used;
        QByteArray variable;
        for (const TableColumn &column : m_columns) {
            if (column.kind == TableColumn::Value && column.element == 0)
                variable = variableName(column.name, &used);
            if (column.element > 0)
                m_variables.push_back(m_variables.back());
            else if (!makeVariable(column, variable))
                return fail(error);
        }
        return true;
    }
    bool add(const TableBlock &block, QString *error) override
    {
        for (std::size_t i = 0; i < m_columns.size(); ++i) {
            if (!write(m_columns[i], *m_variables[i], block.columns[i], hsize_t(block.rows)))
                return fail(error);
        }
        m_rows += hsize_t(block.rows);
        return true;
    }
    bool end(QString *error) override
    {
        bool isWritten = true;
        for (const std::shared_ptr<Handle> &variable : m_variables)
            isWritten = variable->close() && isWritten;
        if (!isWritten || !m_quality->close() || H5Fflush(*m_file, H5F_SCOPE_GLOBAL) < 0 || !m_file->close())
            return fail(error);
        return m_output.write(header(), error);  // the file is at its begin
    }

private:
    bool fail(QString *error)
    {
        for (const std::shared_ptr<Handle> &variable : m_variables)
            variable->abandon();
        if (m_quality)
            m_quality->abandon();
        if (m_file)
            m_file->abandon();
        *error = QStringLiteral("cannot write the file of MATLAB: HDF5 has failed; is the disk full?");
        return false;
    }
    static QByteArray header()
    {
        const QByteArray text = "MATLAB 7.3 MAT-file, Platform: GLNXA64, Created by: QtPLC HDF5 schema 1.00 .";
        QByteArray bytes = text.leftJustified(HeaderTextSize, ' ') + QByteArray(8, '\0');
        return bytes + '\0' + '\2' + "IM" + QByteArray(HeaderSize - HeaderTextSize - 12, '\0');
    }
    /// Dimensions are in the order of HDF5: MATLAB shows rows first.
    static hsize_t widthOf(const TableColumn &column)
    {
        return hsize_t(column.isText() ? column.capacity : column.count);
    }
    bool makeVariable(const TableColumn &column, const QByteArray &signal)
    {
        const bool isQuality = column.kind == TableColumn::Quality;
        const QByteArray name = column.kind == TableColumn::Moment ? QByteArray("utc_ns")
            : column.kind == TableColumn::Value || isQuality       ? signal
                                                                   : column.name.toUtf8();
        const MatType type = matTypeOf(column);
        const hsize_t now[] = {widthOf(column), 0};
        const hsize_t most[] = {widthOf(column), H5S_UNLIMITED};
        const hsize_t chunk[] = {column.isText() ? widthOf(column) : 1, RecordingTable::RowsOfABlock};
        const Handle space(H5Screate_simple(2, now, most), H5Sclose);
        const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
        if (H5Pset_chunk(properties, 2, chunk) < 0 || H5Pset_shuffle(properties) < 0
            || H5Pset_deflate(properties, Deflate) < 0)
            return false;
        const hid_t place = isQuality ? *m_quality : *m_file;
        m_variables.push_back(std::make_shared<Handle>(
            H5Dcreate2(place, name.constData(), type.type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose));
        const hid_t variable = *m_variables.back();
        return variable >= 0 && addText(variable, "MATLAB_class", type.name)
            && (!type.isDecoded || addDecode(variable, column.isText() ? 2 : 1))
            && addText(variable, "signal", column.name.toUtf8()) && addText(variable, "unit", column.unit.toUtf8())
            && addText(variable, "description", column.description.toUtf8());
    }
    bool write(const TableColumn &column, hid_t variable, const TableBlock::Values &values, hsize_t rows)
    {
        const hsize_t size[] = {widthOf(column), m_rows + rows};
        if (H5Dset_extent(variable, size) < 0)
            return false;
        const hsize_t start[] = {hsize_t(column.element), m_rows};
        const hsize_t count[] = {column.isText() ? widthOf(column) : 1, rows};
        const Handle there(H5Dget_space(variable), H5Sclose);
        const Handle here(H5Screate_simple(2, count, nullptr), H5Sclose);
        if (H5Sselect_hyperslab(there, H5S_SELECT_SET, start, nullptr, count, nullptr) < 0)
            return false;
        const QByteArray bytes = column.isText() ? matrixOf(values.texts, column.capacity) : values.numbers;
        return H5Dwrite(variable, matTypeOf(column).type, here, there, H5P_DEFAULT, bytes.constData()) >= 0;
    }
    /// A row for each character, a column for each text.
    static QByteArray matrixOf(const std::vector<QByteArray> &texts, int width)
    {
        QByteArray matrix(int(texts.size()) * width * 2, '\0');
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const QByteArray chars = charsOf(texts[i], width);
            for (int c = 0; c < width; ++c) {
                const int to = (c * int(texts.size()) + int(i)) * 2;
                matrix[to] = chars.at(2 * c);
                matrix[to + 1] = chars.at(2 * c + 1);
            }
        }
        return matrix;
    }

    OutputFile &m_output;
    std::vector<TableColumn> m_columns;
    std::unique_ptr<Handle> m_file;
    std::unique_ptr<Handle> m_quality;
    std::vector<std::shared_ptr<Handle>> m_variables;  // of each column
    hsize_t m_rows = 0;
};

}  // namespace

std::unique_ptr<TableWriter> makeMatWriter(OutputFile *file)
{
    return std::make_unique<MatWriter>(file);
}

}  // namespace qplc
