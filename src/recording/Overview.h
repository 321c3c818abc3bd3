// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "McapReader.h"
#include "PlantMessage.h"

#include <QtCore/QString>

#include <memory>
#include <vector>

namespace qplc {

/// The smallest and largest values of each number in buckets of cycles, for curves of long times: a
/// part of each file of a recording, the attachment overview.bin.
///
/// Bucket b of a level has the cycles from b times its length up to the next one. So the buckets of
/// two files of one phase are the same. docs/design/recording-format.md has the bytes.
namespace overview {

constexpr char Name[] = "overview.bin";
constexpr char MediaType[] = "application/octet-stream";

/// What a bucket has.
enum Flag : quint8 {
    HasValue = 1,   ///< minimum and maximum are those of its values
    HasHeld = 2,    ///< there were held values
    HasSafe = 4,    ///< there were safe values
    HasInvalid = 8  ///< there were values that are not valid: minimum and maximum leave them out
};
quint8 flagOf(QPlcQuality quality);

/// An element of a numeric signal.
struct Column
{
    QPlcSignalType::Scalar scalar = QPlcSignalType::Invalid;
    quint32 offset = 0;   // in the process image
    quint32 quality = 0;  // in the process image
};
/// All of them, in the order of the table.
std::vector<Column> columnsOf(const ProcessImage &image);
/// The place among the columns of the first element of a signal. -1: it is no number
int firstColumn(const QPlcSignalTable &table, QPlcSignalIndex signal);

/// A value as the image has it.
double numberAt(QPlcSignalType::Scalar scalar, const char *bytes);

struct Bucket
{
    double minimum = 0.0;
    double maximum = 0.0;
    quint8 flags = 0;

    void add(const Bucket &other);
};

struct Level
{
    quint64 length = 0;  // of a bucket [cycles], a power of two
    quint64 first = 0;   // number of the first bucket
    quint32 count = 0;   // buckets
    quint64 place = 0;   // [byte] of the first column
};

/// Makes the overview of a file while its cycles come.
///
/// Its size is bounded: it joins pairs of buckets when there are too many.
class Builder
{
public:
    static constexpr std::size_t UsualBytes = 4 << 20;  // of the buckets

    explicit Builder(const ProcessImage &image, std::size_t mostBytes = UsualBytes);
    /// Cycles come in the order of their numbers. A recorder calls it for each cycle, so it costs
    /// about as much as to copy the values.
    /// \param start  time of cycle 0 [ns]
    void add(quint64 cycle, std::int64_t start, const char *image);
    /// All cycles in the records of a chunk.
    /// \param plant  the channel /plant, \param period [ns]
    void addChunk(const QByteArray &records, std::uint16_t plant, std::int64_t period, PlantMessage *message);
    bool isEmpty() const { return !m_hasCycle; }
    QByteArray bytes() const;

private:
    struct Values
    {
        Column column;
        std::vector<char> minimum;
        std::vector<char> maximum;
        std::vector<quint8> flags;
    };

    /// Columns of one type, side by side in the image.
    struct Run
    {
        QPlcSignalType::Scalar scalar = QPlcSignalType::Invalid;
        quint32 offset = 0;     // in the image
        std::size_t place = 0;  // in m_minimum and m_maximum [byte]
        std::size_t first = 0;  // column
        std::size_t count = 0;
    };

    void makeRuns();
    void forgetNewest();
    void addQualities(const char *image);
    void store();
    void append(quint64 bucket);
    void join();
    std::size_t bytesOfBucket() const;

    std::vector<Values> m_values;
    // The newest bucket grows here, all columns side by side, and joins the others when it is
    // complete. The smallest value is larger than the largest one: there was none.
    std::vector<Run> m_runs;
    std::vector<char> m_minimum;
    std::vector<char> m_maximum;
    std::vector<quint8> m_flags;
    quint32 m_qualities = 0;  // in the image
    std::size_t m_signalCount = 0;
    std::size_t m_mostBytes;
    std::int64_t m_start = 0;
    quint64 m_length = 64;
    quint64 m_first = 0;  // bucket
    quint64 m_count = 0;
    bool m_hasCycle = false;
};

/// Reads parts of an overview, in a file or in memory.
class File
{
public:
    /// \return false when it does not fit the table of \a image, or is damaged
    bool open(QByteArray bytes, const ProcessImage &image);
    bool open(std::shared_ptr<mcap::Reader> reader, const mcap::NamedEntry &attachment, const ProcessImage &image);

    const std::vector<Level> &levels() const { return m_levels; }  // from fine to coarse
    std::int64_t start() const { return m_start; }                 // time of cycle 0 [ns]
    /// The buckets of a column from \a first to before \a end. \return false when they are damaged
    bool read(const Level &level, int column, quint64 first, quint64 end, std::vector<Bucket> *buckets);

private:
    bool readHead(const ProcessImage &image);
    QByteArray bytes(quint64 place, quint64 size);

    QByteArray m_bytes;
    std::shared_ptr<mcap::Reader> m_reader;  // null: they are in memory
    quint64 m_begin = 0;                     // in the file
    quint64 m_size = 0;
    std::int64_t m_start = 0;
    std::vector<Level> m_levels;
    std::vector<Column> m_columns;
    std::vector<quint64> m_bytesBefore;  // of a bucket, of the columns before each
};

}  // namespace overview

}  // namespace qplc
