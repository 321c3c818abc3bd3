// SPDX-License-Identifier: Apache-2.0
#include "PlantRecording.h"

#include "Plant.h"
#include "RecordedValues.h"
#include "gui/WindowText.h"

#include <QtCore/QDateTime>
#include <QtCore/QElapsedTimer>

#include <algorithm>
#include <cmath>
#include <limits>

namespace qplc {

namespace {

constexpr int sliceTime = 10;        // [ms] of reading, before the window goes on
constexpr int rowsOfSlice = 64;      // between two looks at the clock
constexpr int mostIntervals = 4096;  // more than a screen has columns
constexpr PlantRecording::Time aDay = 24 * 3'600 * SignalStore::Second;

/// 00:00 of a day, on the clock of this computer, near to the begin of times and behind it.
PlantRecording::Time firstMidnight()
{
    const QDateTime midnight(QDate(1970, 1, 2), QTime(0, 0));
    return midnight.isValid() ? PlantRecording::Time(midnight.toMSecsSinceEpoch()) * 1'000'000 : aDay;
}

/// That of the worst values of an interval.
SignalStore::Mark markOf(quint8 flags)
{
    if ((flags & overview::HasInvalid) != 0)
        return QPlcQuality::Invalid;
    if ((flags & overview::HasSafe) != 0)
        return QPlcQuality::Safe;
    return (flags & overview::HasHeld) != 0 ? SignalStore::Mark(QPlcQuality::Held) : RowMarks::None;
}

QString lengthText(PlantRecording::Time length)
{
    const double seconds = double(length) * 1e-9;
    if (seconds < 120.0)
        return WindowText::tr("%1 s").arg(seconds, 0, 'g', 3);
    if (seconds < 2.0 * 3600.0)
        return WindowText::tr("%1 min").arg(seconds / 60.0, 0, 'g', 3);
    return seconds < 48.0 * 3600.0 ? WindowText::tr("%1 h").arg(seconds / 3600.0, 0, 'g', 3)
                                   : WindowText::tr("%1 days").arg(seconds / 86400.0, 0, 'g', 3);
}

}  // namespace

/// A part of the recording on its way into a store.
struct PlantRecording::Section
{
    struct Channel
    {
        int signal;
        int element;
    };

    Part part;
    PlantValues values;
    std::unique_ptr<RecordedValues> recorded;  // if it has cycles
    std::unique_ptr<RecordedRows> rows;        // likewise
    std::optional<quint64> lastCycle;
    Time lastTime = 0;
    int intervals = 0;              // of an overview
    std::vector<Channel> channels;  // of an overview
    std::vector<std::vector<overview::Bucket>> columns;
};

PlantRecording::PlantRecording(Plant *plant, std::unique_ptr<Recording> recording, std::int64_t memory)
    : QObject(plant)
    , m_plant(plant)
    , m_recording(std::move(recording))
    , m_memory(memory)
    , m_mostRows(memory / PlantValues::bytesOfRow(ChannelMap(m_recording->table()).channels()))
{
    m_period = std::numeric_limits<Time>::max();
    for (const RecordedFile &file : m_recording->files())
        m_period = std::min<Time>(m_period, file.description.period);
    m_period = std::max<Time>(m_period, 1);
    m_shift = m_recording->isTimed() ? 0 : firstMidnight();
    m_begin = m_recording->begin() + m_shift;
    m_end = m_recording->end() + m_shift;
    m_timer.setInterval(0);
    connect(&m_timer, &QTimer::timeout, this, &PlantRecording::readSome);
    m_happeningTimer.setInterval(0);
    connect(&m_happeningTimer, &QTimer::timeout, this, &PlantRecording::tellSome);
    beginSection(m_begin, m_end);
}

PlantRecording::~PlantRecording() = default;

bool PlantRecording::fits(Time begin, Time end) const
{
    return (end - begin) / m_period < m_mostRows;
}

void PlantRecording::setMemory(std::int64_t memory)
{
    const bool didFit = fits(m_begin, m_end);
    m_memory = memory;
    m_mostRows = memory / PlantValues::bytesOfRow(ChannelMap(m_recording->table()).channels());
    if (!didFit || !fits(m_begin, m_end))
        beginSection(m_begin, m_end);
}

double PlantRecording::progress() const
{
    if (!m_section)
        return 1.0;
    if (!m_section->rows)
        return double(m_section->columns.size()) / double(std::max<std::size_t>(m_section->channels.size(), 1));
    const Time length = std::max<Time>(m_section->part.end - m_section->part.begin, 1);
    return std::clamp(double(m_section->lastTime - m_section->part.begin) / double(length), 0.0, 1.0);
}

QString PlantRecording::text() const
{
    QStringList parts{WindowText::tr("%1 signals").arg(m_recording->table().size()),
                      WindowText::tr("%1 Hz").arg(1e9 / double(m_period), 0, 'g', 4), lengthText(m_end - m_begin)};
    if (m_damages > 0)
        parts << WindowText::tr("damaged at %1 places").arg(m_damages);
    if (!m_recording->notes().isEmpty())
        parts << WindowText::tr("not all files: event log (F8)");
    return parts.join(QStringLiteral(" · "));
}

/// All cycles are wanted as soon as they fit, with as much before and behind, so that not each
/// movement needs other ones.
void PlantRecording::see(Time begin, Time end)
{
    if (fits(m_begin, m_end) || !m_isRead)
        return;
    const Time from = std::clamp(begin, m_begin, m_end);
    const Time to = std::clamp(end, from, m_end);
    const Time span = to - from;
    const bool canHaveCycles = 3 * (span / m_period + 1) < m_mostRows;
    const Part &part = m_section ? m_section->part : m_part;
    if (canHaveCycles == part.hasCycles && part.begin <= from && part.end >= to)
        return;
    if (canHaveCycles)
        beginSection(std::max(from - span, m_begin), std::min(to + span, m_end));
    else
        beginSection(m_begin, m_end);
}

void PlantRecording::beginSection(Time begin, Time end)
{
    m_section = std::make_unique<Section>();
    Section &section = *m_section;
    section.part = {begin, end, fits(begin, end)};
    section.lastTime = begin;
    const QPlcSignalTable &table = m_recording->table();
    section.intervals = int(std::clamp<std::int64_t>(m_mostRows / 2, 1, mostIntervals));
    const Time rowPeriod
        = section.part.hasCycles ? m_period : std::max<Time>((end - begin) / (2 * section.intervals), 1);
    section.values.setTable(table, rowPeriod, {end - begin + 4 * rowPeriod, m_memory});
    if (section.part.hasCycles) {
        section.recorded = std::make_unique<RecordedValues>(*m_recording, table);
        section.rows
            = std::make_unique<RecordedRows>(*m_recording, section.recorded->columns(), begin - m_shift, end - m_shift);
    } else {
        for (QPlcSignalIndex signal = 0; signal < table.size(); ++signal) {
            const bool hasChannels = section.values.channels().channel(signal) != ChannelMap::NoChannel;
            for (int element = 0; hasChannels && element < table.at(signal).type.count(); ++element)
                section.channels.push_back({int(signal), element});
        }
    }
    m_timer.start();
    Q_EMIT m_plant->stateChanged();
}

void PlantRecording::readSome()
{
    QElapsedTimer clock;
    clock.start();
    bool isMore = true;
    while (isMore && clock.elapsed() < sliceTime)
        isMore = m_section->rows ? readRow() : readColumn();
    if (!isMore)
        finish();
    else if (!m_isRead)
        Q_EMIT m_plant->statusChanged();  // progress
}

/// \return false behind the last one
bool PlantRecording::readRow()
{
    for (int row = 0; row < rowsOfSlice; ++row) {
        if (!m_section->rows->next())
            return false;
        storeRow(*m_section->rows);
    }
    return true;
}

void PlantRecording::storeRow(const RecordedRows &rows)
{
    Section &section = *m_section;
    const bool isNext = section.lastCycle && rows.cycle().number == *section.lastCycle + 1;
    if (!isNext)
        section.values.interrupt();
    section.lastCycle = rows.cycle().number;
    section.lastTime = rows.time() + m_shift;
    section.values.beginBatch();
    section.recorded->store(rows, section.lastTime, &section.values);
}

/// \return false when it was the last one
bool PlantRecording::readColumn()
{
    Section &section = *m_section;
    if (section.columns.size() < section.channels.size()) {
        const Section::Channel channel = section.channels[section.columns.size()];
        section.columns.push_back(m_recording->overview(channel.signal, channel.element, section.part.begin - m_shift,
                                                        section.part.end - m_shift + 1, section.intervals));
        return true;
    }
    storeOverview();
    return false;
}

/// Two rows of an interval: one with the smallest values, and one with the largest ones.
void PlantRecording::storeOverview()
{
    Section &section = *m_section;
    SignalStore *store = section.values.store();
    store->setOverview();
    const double width = double(section.part.end - section.part.begin) / section.intervals;
    std::vector<float> row(section.columns.size());
    for (int half = 0; half < 2 * section.intervals; ++half) {
        for (std::size_t column = 0; column < section.columns.size(); ++column) {
            const overview::Bucket &bucket = section.columns[column][std::size_t(half / 2)];
            const bool hasValue = (bucket.flags & overview::HasValue) != 0;
            row[column] = !hasValue ? std::nanf("") : float(half % 2 == 0 ? bucket.minimum : bucket.maximum);
        }
        store->append(section.part.begin + Time(std::llround((half + 0.5) * 0.5 * width)), row.data());
        for (std::size_t column = 0; column < section.columns.size(); ++column) {
            if (const SignalStore::Mark mark = markOf(section.columns[column][std::size_t(half / 2)].flags))
                store->mark(int(column), mark);
        }
    }
}

void PlantRecording::finish()
{
    m_timer.stop();
    m_part = m_section->part;
    m_damages = m_section->rows ? m_section->rows->damages() : m_damages;
    PlantValues values = std::move(m_section->values);
    m_section.reset();
    const bool isFirst = !std::exchange(m_isRead, true);
    m_plant->giveValues(std::move(values));
    if (isFirst)
        Q_EMIT m_plant->tableChanged();
    Q_EMIT m_plant->storeChanged();
    Q_EMIT m_plant->stateChanged();
    Q_EMIT m_plant->statusChanged();
    Q_EMIT m_plant->updated();
    Q_EMIT read();
    if (isFirst) {
        tellWhatIsLeftOut();
        m_happenings
            = std::make_unique<HappeningReader>(*m_recording, Happening::Event | Happening::Command | Happening::Lease);
        m_happeningTimer.start();
    }
}

// ---- what has happened ----

void PlantRecording::tellWhatIsLeftOut()
{
    const QStringList notes = m_recording->notes().mid(0, MostHappenings);
    for (const QString &note : notes) {
        PlantEvent event;
        event.time = QDateTime::fromMSecsSinceEpoch(m_begin / 1'000'000);
        event.severity = PlantEvent::Warning;
        event.source = m_plant->sourceOf({});
        event.text = WindowText::tr("left out of the recording: %1").arg(note);
        m_plant->tell(event);
    }
}

void PlantRecording::tellSome()
{
    QElapsedTimer clock;
    clock.start();
    bool isMore = true;
    for (Happening happening; isMore && clock.elapsed() < sliceTime;) {
        isMore = m_told < MostHappenings && m_happenings->next(&happening);
        if (isMore)
            tell(happening);
    }
    if (isMore)
        return;
    m_happeningTimer.stop();
    m_happenings.reset();
}

/// Nobody has to acknowledge what is over.
void PlantRecording::tell(const Happening &happening)
{
    ++m_told;
    const QString severity = happening.severity();
    PlantEvent event;
    event.time = QDateTime::fromMSecsSinceEpoch((happening.time + m_shift) / 1'000'000);
    event.severity = severity == QLatin1String("error") ? PlantEvent::Error
        : severity == QLatin1String("warning")          ? PlantEvent::Warning
                                                        : PlantEvent::Information;
    event.source = m_plant->sourceOf({});
    event.text = happening.sentence();
    event.isAcknowledged = true;
    event.isNote = happening.kind() == messages::noteEvent;
    m_plant->tell(event);
}

}  // namespace qplc
