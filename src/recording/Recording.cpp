// SPDX-License-Identifier: Apache-2.0
#include "Recording.h"

#include "protocol/LittleEndian.h"

#include <QtCore/QFileInfo>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

QPlcSignalTable tableOf(const QByteArray &ini)
{
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(ini, &errors);
    return errors.isEmpty() ? table : QPlcSignalTable();
}

}  // namespace

RecordedLayout::RecordedLayout(const RingDescription &description)
    : ini(description.table)
    , message(tableOf(description.table))
{
    if (message.hasTexts())
        return;
    for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(message.table().size()); ++i)
        offsets.push_back(std::uint32_t(PlantMessage::CycleSize) + message.image().offset(i));
}

bool Recording::open(const QStringList &paths, QString *error, Unreadable unreadable)
{
    *this = {};
    for (const QString &path : paths) {
        const bool isFolder = QFileInfo(path).isDir();
        const QStringList files = isFolder ? filesIn(path, {QStringLiteral("*.mcap")}) : QStringList{path};
        if (files.isEmpty()) {
            *error = whyNoRecording(path);
            return false;
        }
        for (const QString &file : files) {
            if (openFile(file, error))
                continue;
            if (unreadable == Refuse && !isFolder)
                return false;
            m_notes << *error;
            ++m_unreadable;
        }
    }
    error->clear();
    if (m_files.empty()) {
        *error = m_notes.isEmpty() ? QStringLiteral("no recording was named") : m_notes.constFirst();
        return false;
    }
    std::stable_sort(m_files.begin(), m_files.end(),
                     [](const RecordedFile &a, const RecordedFile &b) { return a.begin < b.begin; });
    m_overviews.resize(m_files.size());
    listSignals();
    return checkOrder(error);
}

bool Recording::openFile(const QString &name, QString *error)
{
    RecordedFile file;
    if (!file.open(name, error))
        return false;
    file.layout = layoutOf(file.description);
    if (layout(file.layout).message.table().isEmpty()) {
        *error = RecordedFile::unknownText(name);
        return false;
    }
    if (file.isEmpty)
        m_notes << QStringLiteral("'%1' has no cycle").arg(name);
    else
        m_files.push_back(std::move(file));
    return true;
}

int Recording::layoutOf(const RingDescription &description)
{
    const auto known = std::find_if(m_layouts.begin(), m_layouts.end(),
                                    [&](const auto &layout) { return layout->ini == description.table; });
    const int number = int(known - m_layouts.begin());
    if (known == m_layouts.end())
        m_layouts.push_back(std::make_shared<RecordedLayout>(description));
    return number;
}

/// The file that begins last may be a piece of another one.
RecordedTime Recording::end() const
{
    RecordedTime end = m_files.front().end;
    for (const RecordedFile &file : m_files)
        end = std::max(end, file.end);
    return end;
}

/// Files of one phase may share cycles, which are read once. Those of two phases may not.
bool Recording::checkOrder(QString *error) const
{
    for (std::size_t i = 1; i < m_files.size(); ++i) {
        const RecordedFile &before = m_files[i - 1];
        const RecordedFile &file = m_files[i];
        const bool isSamePhase = before.description.session == file.description.session
            && before.description.phase == file.description.phase;
        if (!isSamePhase && file.begin <= before.end) {
            *error = QStringLiteral("'%1' and '%2' have different flights at the same time, as simulations that begin "
                                    "at 0: name the files of one of them")
                         .arg(before.name, file.name);
            return false;
        }
    }
    return true;
}

void Recording::listSignals()
{
    QHash<QString, std::size_t> known;
    for (std::size_t number = 0; number < m_layouts.size(); ++number) {
        const QPlcSignalTable &table = m_layouts[number]->message.table();
        for (QPlcSignalIndex i = 0; i < QPlcSignalIndex(table.size()); ++i) {
            const QPlcSignalDefinition &definition = table.at(i);
            if (!known.contains(definition.name)) {
                known.insert(definition.name, m_signals.size());
                m_signals.push_back({definition, std::vector<int>(m_layouts.size(), -1)});
                m_table.append(definition);
            }
            RecordedSignal &signal = m_signals[known.value(definition.name)];
            if (signal.definition.type == definition.type)
                signal.indices[number] = int(i);
            else
                m_notes << QStringLiteral("signal '%1' is %2 in some files and %3 in others: the second ones are left "
                                          "out")
                               .arg(definition.name, signal.definition.type.name(), definition.type.name());
        }
    }
}

int Recording::indexOf(const QString &name) const
{
    const auto found = std::find_if(m_signals.begin(), m_signals.end(),
                                    [&](const RecordedSignal &signal) { return signal.definition.name == name; });
    return found == m_signals.end() ? -1 : int(found - m_signals.begin());
}

bool Recording::isTimed() const
{
    constexpr RecordedTime year = RecordedTime(365) * 24 * 3600 * 1'000'000'000;
    return begin() > year;
}

std::uint64_t Recording::bytes() const
{
    std::uint64_t bytes = 0;
    for (const RecordedFile &file : m_files)
        bytes += std::uint64_t(QFileInfo(file.name).size());
    return bytes;
}

const mcap::Index *Recording::indexOf(std::size_t number)
{
    RecordedFile &file = m_files[number];
    if (!file.index) {
        mcap::Reader reader;
        QString error;
        if (!reader.open(file.name, &error))
            return nullptr;
        reader.readIndex(&file.index.emplace());
    }
    return &*file.index;
}

/// Of the file, or computed where it has none, as files that were not finished.
overview::File *Recording::overviewOf(std::size_t number)
{
    if (m_overviews[number])
        return m_overviews[number].get();
    const RecordedFile &file = m_files[number];
    RecordedLayout &layout = *m_layouts[std::size_t(file.layout)];
    auto found = std::make_unique<overview::File>();
    auto reader = std::make_shared<mcap::Reader>();
    QString error;
    if (!reader->open(file.name, &error))
        return nullptr;
    const mcap::NamedEntry *entry = file.attachment(overview::Name);
    if (!entry || !found->open(reader, *entry, layout.message.image())) {
        overview::Builder builder(layout.message.image());
        const mcap::Index *index = indexOf(number);
        const std::uint16_t plant = index ? mcap::channelOf(*index, "/plant") : 0;
        QByteArray records;
        for (std::size_t i = 0; index && i < index->chunks.size(); ++i) {
            if (reader->readChunk(index->chunks[i], &records))
                builder.addChunk(records, plant, file.description.period, &layout.message);
        }
        if (!found->open(builder.bytes(), layout.message.image()))
            return nullptr;
    }
    m_overviews[number] = std::move(found);
    return m_overviews[number].get();
}

std::vector<overview::Bucket> Recording::overview(int signal, int element, RecordedTime begin, RecordedTime end,
                                                  int count)
{
    std::vector<overview::Bucket> result(std::size_t(std::max(count, 0)));
    if (result.empty() || end <= begin)
        return result;
    const double width = double(end - begin) / count;
    for (std::size_t i = 0; i < m_files.size(); ++i) {
        const RecordedFile &file = m_files[i];
        if (file.end < begin || file.begin >= end)
            continue;
        const int index = m_signals[std::size_t(signal)].indices[std::size_t(file.layout)];
        if (index < 0)
            continue;
        const QPlcSignalTable &table = m_layouts[std::size_t(file.layout)]->message.table();
        const int column = overview::firstColumn(table, QPlcSignalIndex(index));
        if (column >= 0 && !addBuckets(i, column + element, begin, width, begin, end, &result))
            addRows(signal, element, std::max(begin, file.begin), std::min(end - 1, file.end), begin, width, &result);
    }
    return result;
}

/// \return false when its buckets are too long, or not there
bool Recording::addBuckets(std::size_t number, int column, RecordedTime from, double width, RecordedTime begin,
                           RecordedTime end, std::vector<overview::Bucket> *result)
{
    const RecordedFile &file = m_files[number];
    const double period = double(file.description.period);
    constexpr double bucketsOfInterval = 1.0;  // at least: a value is then an interval away at most
    constexpr double finest = 64.0;            // a level has no shorter buckets
    if (width / period < bucketsOfInterval * finest)
        return false;
    overview::File *overview = overviewOf(number);
    const overview::Level *level = nullptr;
    for (std::size_t i = 0; overview && i < overview->levels().size(); ++i) {
        const overview::Level &each = overview->levels()[i];
        if (double(each.length) * period * bucketsOfInterval <= width)
            level = &each;
    }
    if (!level)
        return false;
    const RecordedTime start = overview->start();
    const auto cycleOf = [&](RecordedTime time) {
        return quint64(std::max<RecordedTime>(time - start, 0)) / quint64(file.description.period);
    };
    const quint64 first = cycleOf(begin) / level->length;
    const quint64 last = cycleOf(end - 1) / level->length;
    std::vector<overview::Bucket> buckets;
    if (!overview->read(*level, column, first, last + 1, &buckets))
        return false;
    quint64 bucket = std::max(first, level->first);
    for (const overview::Bucket &each : buckets) {
        const double middle = double(start - from) + (double(bucket++) + 0.5) * double(level->length) * period;
        const auto place
            = std::clamp<std::int64_t>(std::int64_t(std::floor(middle / width)), 0, std::int64_t(result->size()) - 1);
        (*result)[std::size_t(place)].add(each);
    }
    return true;
}

void Recording::addRows(int signal, int element, RecordedTime begin, RecordedTime end, RecordedTime from, double width,
                        std::vector<overview::Bucket> *result)
{
    RecordedRows rows(*this, {signal}, begin, end);
    while (rows.next()) {
        if (!rows.value(0))
            continue;
        overview::Bucket bucket;
        bucket.minimum = bucket.maximum = rows.number(0, element);
        bucket.flags = overview::flagOf(rows.quality(0));
        if (std::isnan(bucket.minimum))
            bucket.flags &= quint8(~overview::HasValue);
        const auto place = std::size_t(double(rows.time() - from) / width);
        (*result)[std::min(place, result->size() - 1)].add(bucket);
    }
}

}  // namespace qplc
