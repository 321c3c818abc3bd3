// SPDX-License-Identifier: Apache-2.0
#include "Overview.h"

#include "protocol/LittleEndian.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace qplc::overview {

namespace {

const QByteArray format = QByteArrayLiteral("QTPLCOV1");
constexpr quint64 Coarser = 16;     // a level, than the one before
constexpr quint32 FewBuckets = 16;  // a level of so many is the last one
constexpr int HeadSize = 24;
constexpr int LevelSize = 20;
constexpr quint32 MostLevels = 32;
constexpr quint64 CrcSize = 4;  // behind the buckets of a column

/// Calls \a use with a value of the type of \a scalar.
template<typename Use>
auto withType(QPlcSignalType::Scalar scalar, Use use)
{
    switch (scalar) {
    case QPlcSignalType::Int8:
        return use(std::int8_t());
    case QPlcSignalType::Int16:
        return use(std::int16_t());
    case QPlcSignalType::Int32:
        return use(std::int32_t());
    case QPlcSignalType::UInt8:
        return use(std::uint8_t());
    case QPlcSignalType::UInt16:
        return use(std::uint16_t());
    case QPlcSignalType::UInt32:
        return use(std::uint32_t());
    case QPlcSignalType::UInt64:
        return use(std::uint64_t());
    case QPlcSignalType::Real32:
        return use(float());
    case QPlcSignalType::Real64:
        return use(double());
    default:  // and points in time
        return use(std::int64_t());
    }
}

std::size_t sizeOf(QPlcSignalType::Scalar scalar)
{
    return std::size_t(QPlcSignalType(scalar).elementSize());
}

/// Whether the last bytes are the CRC of those before.
bool hasItsCrc(const QByteArray &bytes)
{
    const int size = bytes.size() - int(CrcSize);
    const auto wanted = size < 0 ? 0 : loadLittle<quint32>(bytes.constData() + size);
    return size >= 0 && mcap::crc32(bytes.constData(), std::size_t(size)) == wanted;
}

/// Takes the values of \a from into those of \a to.
void merge(QPlcSignalType::Scalar scalar, const char *fromMinimum, const char *fromMaximum, quint8 from,
           char *toMinimum, char *toMaximum, quint8 *to)
{
    withType(scalar, [&](auto type) {
        using Number = decltype(type);
        if (from & HasValue) {
            const auto low = loadLittle<Number>(fromMinimum);
            const auto high = loadLittle<Number>(fromMaximum);
            if (!(*to & HasValue) || low < loadLittle<Number>(toMinimum))
                storeLittle(low, toMinimum);
            if (!(*to & HasValue) || high > loadLittle<Number>(toMaximum))
                storeLittle(high, toMaximum);
        }
    });
    *to |= from;
}

/// Of a bucket without values: any value is smaller.
template<typename Number>
constexpr Number Largest = std::numeric_limits<Number>::has_infinity ? std::numeric_limits<Number>::infinity()
                                                                     : std::numeric_limits<Number>::max();
template<typename Number>
constexpr Number Smallest = std::numeric_limits<Number>::has_infinity ? -std::numeric_limits<Number>::infinity()
                                                                      : std::numeric_limits<Number>::lowest();

/// A value that is no number is neither smaller nor larger.
template<typename Number, std::size_t Count>
void extend(const char *__restrict values, char *__restrict minimum, char *__restrict maximum)
{
    for (std::size_t at = 0; at < Count * sizeof(Number); at += sizeof(Number)) {
        const auto value = loadLittle<Number>(values + at);
        const auto low = loadLittle<Number>(minimum + at);
        const auto high = loadLittle<Number>(maximum + at);
        storeLittle(value < low ? value : low, minimum + at);
        storeLittle(value > high ? value : high, maximum + at);
    }
}

template<typename Number>
void extendAll(const char *values, std::size_t count, char *minimum, char *maximum)
{
    constexpr std::size_t Block = 16;  // a known number: the compiler takes several at once
    std::size_t at = 0;
    for (; count >= Block; count -= Block, at += Block * sizeof(Number))
        extend<Number, Block>(values + at, minimum + at, maximum + at);
    for (; count > 0; --count, at += sizeof(Number))
        extend<Number, 1>(values + at, minimum + at, maximum + at);
}

}  // namespace

quint8 flagOf(QPlcQuality quality)
{
    switch (quality.kind()) {
    case QPlcQuality::Good:
        return HasValue;
    case QPlcQuality::Held:
        return HasValue | HasHeld;
    case QPlcQuality::Safe:
        return HasValue | HasSafe;
    default:
        return HasInvalid;
    }
}

std::vector<Column> columnsOf(const ProcessImage &image)
{
    std::vector<Column> columns;
    for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(image.table().size()); ++i) {
        const QPlcSignalType type = image.table().at(i).type;
        for (int element = 0; !type.isString() && element < type.count(); ++element)
            columns.push_back(
                {type.scalar(), image.offset(i) + quint32(element * type.elementSize()), image.qualityOffset(i)});
    }
    return columns;
}

int firstColumn(const QPlcSignalTable &table, QPlcSignalIndex signal)
{
    int column = 0;
    for (QPlcSignalIndex i = 0; i < signal; ++i)
        column += table.at(i).type.isString() ? 0 : table.at(i).type.count();
    return table.at(signal).type.isString() ? -1 : column;
}

double numberAt(QPlcSignalType::Scalar scalar, const char *bytes)
{
    return withType(scalar, [bytes](auto type) { return double(loadLittle<decltype(type)>(bytes)); });
}

void Bucket::add(const Bucket &other)
{
    if (other.flags & HasValue) {
        minimum = flags & HasValue ? std::min(minimum, other.minimum) : other.minimum;
        maximum = flags & HasValue ? std::max(maximum, other.maximum) : other.maximum;
    }
    flags |= other.flags;
}

Builder::Builder(const ProcessImage &image, std::size_t mostBytes)
    : m_qualities(quint32(image.totalSize() - std::size_t(image.table().size())))
    , m_signalCount(std::size_t(image.table().size()))
    , m_mostBytes(mostBytes)
{
    for (const Column &column : columnsOf(image))
        m_values.push_back({column, {}, {}, {}});
    makeRuns();
}

void Builder::makeRuns()
{
    std::size_t place = 0;
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        const Column &column = m_values[i].column;
        const std::size_t size = sizeOf(column.scalar);
        const bool goesOn = !m_runs.empty() && m_runs.back().scalar == column.scalar
            && m_runs.back().offset + m_runs.back().count * size == column.offset;
        if (!goesOn)
            m_runs.push_back({column.scalar, column.offset, place, i, 0});
        ++m_runs.back().count;
        place += size;
    }
    m_minimum.resize(place);
    m_maximum.resize(place);
    m_flags.resize(m_values.size());
    forgetNewest();
}

void Builder::forgetNewest()
{
    for (const Run &run : m_runs) {
        withType(run.scalar, [&](auto type) {
            using Number = decltype(type);
            for (std::size_t i = 0; i < run.count; ++i) {
                storeLittle(Largest<Number>, m_minimum.data() + run.place + i * sizeof(Number));
                storeLittle(Smallest<Number>, m_maximum.data() + run.place + i * sizeof(Number));
            }
        });
    }
    std::fill(m_flags.begin(), m_flags.end(), quint8(0));
}

std::size_t Builder::bytesOfBucket() const
{
    std::size_t bytes = 0;
    for (const Values &values : m_values)
        bytes += 2 * sizeOf(values.column.scalar) + 1;
    return bytes;
}

void Builder::addChunk(const QByteArray &records, std::uint16_t plant, std::int64_t period, PlantMessage *message)
{
    mcap::forEachMessage(
        records, [](const mcap::Channel &) {},
        [&](const mcap::Message &each, std::uint64_t) {
            if (each.channel != plant)
                return;
            const std::optional<PlantMessage::Cycle> cycle = message->decode(each.bytes, each.size);
            if (cycle)
                add(cycle->number, std::int64_t(each.time - cycle->number * std::uint64_t(period)),
                    message->image().data());
        });
}

void Builder::add(quint64 cycle, std::int64_t start, const char *image)
{
    if (m_values.empty())
        return;
    if (!m_hasCycle) {
        m_first = cycle / m_length;
        m_start = start;
    }
    m_hasCycle = true;
    if (cycle / m_length >= m_first + m_count)
        append(cycle);
    const char *qualities = image + m_qualities;
    static_assert(QPlcQuality::fromByte(0).isGood());
    const bool isGood = *qualities == 0 && std::memcmp(qualities, qualities + 1, m_signalCount - 1) == 0;
    if (!isGood)
        return addQualities(image);
    for (const Run &run : m_runs)
        withType(run.scalar, [&](auto type) {
            extendAll<decltype(type)>(image + run.offset, run.count, m_minimum.data() + run.place,
                                      m_maximum.data() + run.place);
        });
}

/// A cycle in which some values are not good.
void Builder::addQualities(const char *image)
{
    for (const Run &run : m_runs)
        withType(run.scalar, [&](auto type) {
            using Number = decltype(type);
            for (std::size_t i = 0; i < run.count; ++i) {
                const quint32 quality = m_values[run.first + i].column.quality;
                const quint8 flags = flagOf(QPlcQuality::fromByte(quint8(image[quality])));
                const std::size_t at = i * sizeof(Number);
                m_flags[run.first + i] |= flags & quint8(~HasValue);
                if (flags & HasValue)
                    extend<Number, 1>(image + run.offset + at, m_minimum.data() + run.place + at,
                                      m_maximum.data() + run.place + at);
            }
        });
}

/// Takes the newest bucket to the others.
void Builder::store()
{
    if (m_count == 0)
        return;
    for (const Run &run : m_runs) {
        for (std::size_t i = 0; i < run.count; ++i) {
            Values &values = m_values[run.first + i];
            const std::size_t size = sizeOf(run.scalar);
            const char *minimum = m_minimum.data() + run.place + i * size;
            const char *maximum = m_maximum.data() + run.place + i * size;
            quint8 flags = m_flags[run.first + i];
            withType(run.scalar, [&](auto type) {
                using Number = decltype(type);
                if (loadLittle<Number>(minimum) <= loadLittle<Number>(maximum))
                    flags |= HasValue;
            });
            const std::size_t last = values.minimum.size() - size;
            merge(run.scalar, minimum, maximum, flags, values.minimum.data() + last, values.maximum.data() + last,
                  &values.flags.back());
        }
    }
    forgetNewest();
}

/// Makes room for the bucket of \a cycle, behind all others.
void Builder::append(quint64 cycle)
{
    store();
    const quint64 most = std::max<quint64>(m_mostBytes / bytesOfBucket(), 2);
    while (cycle / m_length - m_first >= most)
        join();
    m_count = cycle / m_length - m_first + 1;
    for (Values &values : m_values) {
        values.minimum.resize(std::size_t(m_count) * sizeOf(values.column.scalar));
        values.maximum.resize(values.minimum.size());
        values.flags.resize(std::size_t(m_count));
    }
}

/// Each bucket is twice as long. The newest one has been stored.
void Builder::join()
{
    const quint64 first = m_first / 2;
    const quint64 count = m_count == 0 ? 0 : (m_first + m_count - 1) / 2 - first + 1;
    for (Values &values : m_values) {
        const std::size_t size = sizeOf(values.column.scalar);
        Values joined{values.column, {}, {}, {}};
        joined.minimum.resize(std::size_t(count) * size);
        joined.maximum.resize(std::size_t(count) * size);
        joined.flags.resize(std::size_t(count));
        for (quint64 i = 0; i < m_count; ++i) {
            const std::size_t to = std::size_t((m_first + i) / 2 - first);
            merge(values.column.scalar, values.minimum.data() + i * size, values.maximum.data() + i * size,
                  values.flags[i], joined.minimum.data() + to * size, joined.maximum.data() + to * size,
                  &joined.flags[to]);
        }
        values = std::move(joined);
    }
    m_first = first;
    m_count = count;
    m_length *= 2;
}

QByteArray Builder::bytes() const
{
    std::vector<Builder> levels{*this};
    levels.front().store();
    while (levels.back().m_count > FewBuckets) {
        Builder coarse = levels.back();
        for (quint64 factor = 1; factor < Coarser; factor *= 2)
            coarse.join();
        levels.push_back(std::move(coarse));
    }
    mcap::Fields head;
    head.raw(format).number(m_start).number(quint32(m_values.size())).number(quint32(levels.size()));
    mcap::Fields body;
    for (const Builder &level : levels) {
        head.number(level.m_length).number(level.m_first).number(quint32(level.m_count));
        for (const Values &values : level.m_values) {
            QByteArray column(values.minimum.data(), int(values.minimum.size()));
            column.append(values.maximum.data(), int(values.maximum.size()));
            column.append(reinterpret_cast<const char *>(values.flags.data()), int(values.flags.size()));
            body.raw(column).number(mcap::crc32(column.constData(), std::size_t(column.size())));
        }
    }
    const std::uint32_t crc = mcap::crc32(head.bytes().constData(), std::size_t(head.bytes().size()));
    return head.number(crc).bytes() + body.bytes();
}

bool File::open(QByteArray bytes, const ProcessImage &image)
{
    m_bytes = std::move(bytes);
    m_reader.reset();
    m_size = quint64(m_bytes.size());
    return readHead(image);
}

bool File::open(std::shared_ptr<mcap::Reader> reader, const mcap::NamedEntry &attachment, const ProcessImage &image)
{
    const quint64 head = mcap::RecordHeadSize + 16 + 4 + quint64(attachment.name.size()) + 4
        + quint64(attachment.mediaType.size()) + 8;
    if (attachment.length < head || attachment.length - head < attachment.dataSize)
        return false;
    m_reader = std::move(reader);
    m_begin = attachment.offset + head;
    m_size = attachment.dataSize;
    return readHead(image);
}

QByteArray File::bytes(quint64 place, quint64 size)
{
    if (place > m_size || size > m_size - place)
        return {};
    return m_reader ? m_reader->read(m_begin + place, size) : m_bytes.mid(int(place), int(size));
}

bool File::readHead(const ProcessImage &image)
{
    m_levels.clear();
    m_columns = columnsOf(image);
    m_bytesBefore.clear();
    quint64 bytesOfBucket = 0;
    for (const Column &column : m_columns) {
        m_bytesBefore.push_back(bytesOfBucket);
        bytesOfBucket += 2 * sizeOf(column.scalar) + 1;
    }
    const QByteArray start = bytes(0, HeadSize);
    mcap::FieldReader fields(start.constData(), std::size_t(start.size()));
    const bool isKnown = fields.bytes(quint64(format.size())) == format;
    m_start = fields.number<std::int64_t>();
    const auto columns = fields.number<quint32>();
    const auto levels = fields.number<quint32>();
    if (!isKnown || !fields.isWhole() || columns != m_columns.size() || levels > MostLevels)
        return false;
    const QByteArray head = bytes(0, HeadSize + quint64(levels) * LevelSize + CrcSize);
    if (head.size() < HeadSize || !hasItsCrc(head))
        return false;
    mcap::FieldReader each(head.constData() + HeadSize, std::size_t(head.size() - HeadSize));
    quint64 place = quint64(head.size());
    for (quint32 i = 0; i < levels; ++i) {
        Level level;
        level.length = each.number<quint64>();
        level.first = each.number<quint64>();
        level.count = each.number<quint32>();
        level.place = place;
        if (level.length == 0)
            return false;
        place += level.count * bytesOfBucket + columns * CrcSize;
        m_levels.push_back(level);
    }
    return place == m_size;
}

bool File::read(const Level &level, int column, quint64 first, quint64 end, std::vector<Bucket> *buckets)
{
    buckets->clear();
    const std::size_t number = std::size_t(column);
    const quint64 size = sizeOf(m_columns[number].scalar);
    const quint64 all = level.count * (2 * size + 1);
    const QByteArray bytes
        = this->bytes(level.place + m_bytesBefore[number] * level.count + number * CrcSize, all + CrcSize);
    if (quint64(bytes.size()) != all + CrcSize || !hasItsCrc(bytes))
        return false;
    const char *minimum = bytes.constData();
    const char *maximum = minimum + level.count * size;
    const char *flags = maximum + level.count * size;
    const quint64 from = std::clamp<quint64>(first, level.first, level.first + level.count) - level.first;
    const quint64 to = std::clamp<quint64>(end, level.first + from, level.first + level.count) - level.first;
    for (quint64 i = from; i < to; ++i) {
        Bucket bucket;
        bucket.flags = quint8(flags[i]);
        if (bucket.flags & HasValue) {
            bucket.minimum = numberAt(m_columns[number].scalar, minimum + i * size);
            bucket.maximum = numberAt(m_columns[number].scalar, maximum + i * size);
        }
        buckets->push_back(bucket);
    }
    return true;
}

}  // namespace qplc::overview
