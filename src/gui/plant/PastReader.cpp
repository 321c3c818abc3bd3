// SPDX-License-Identifier: Apache-2.0
#include "PastReader.h"

#include "RecordedValues.h"
#include "gui/WindowText.h"
#include "node/cycle/RingDescription.h"
#include "node/cycle/RingReader.h"
#include "recording/RecordingName.h"
#include "signals/ProcessImage.h"

#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QFileInfo>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace qplc {

namespace {

using Time = PlantValues::Time;

/// Of a ring: PhaseRing calls it ...-SESSION-PHASE.
quint64 phaseOfRing(const QString &file)
{
    return file.section(QLatin1Char('-'), -1).toULongLong();
}

/// \return 0 if no recorder gives such a name
quint64 phaseOfRecording(const QString &file)
{
    const auto name = RecordingName::parse(QFileInfo(file).fileName());
    return name ? name->phase : 0;
}

/// Some cycles later, or before. A file may have any numbers: they wrap around.
Time timeAfter(Time time, quint64 cycles, Time period)
{
    return Time(quint64(time) + cycles * quint64(period));
}

/// The newest files of a session, in the order of phases and times.
/// \param pattern  of their names, with %1 for the session
QStringList filesOfSession(const QDir &folder, const QString &pattern, quint64 session,
                           quint64 (*phaseOf)(const QString &file))
{
    const QStringList names
        = folder.entryList({pattern.arg(QString::number(session, 16))}, QDir::Files | QDir::NoSymLinks);
    std::vector<std::pair<quint64, QString>> found;  // phases and names
    for (const QString &name : names) {
        if (const quint64 phase = phaseOf(name))
            found.emplace_back(phase, name);
    }
    std::sort(found.begin(), found.end());
    QStringList files;
    for (std::size_t i = found.size() - std::min(found.size(), MostFilesOfPast); i < found.size(); ++i)
        files << found[i].second;
    return files;
}

/// One reading.
class PastReading
{
public:
    PastReading(const PastWish &wish, const std::atomic<bool> &isUnwanted)
        : m_wish(wish)
        , m_isUnwanted(isUnwanted)
    {
        m_clock.start();
        m_rings = filesOfSession(m_ringFolder, QStringLiteral("qtplc-ring-*-%1-*"), wish.session, phaseOfRing);
        PlantValues::Budget budget = wish.file.isEmpty() ? PlantValues::Budget() : RecordedBudget;
        if (wish.isBetweenRows())
            budget.history = std::min(budget.history, wish.before - wish.after);
        m_past.values.setTable(wish.table, wish.period, budget);
    }

    Past read()
    {
        if (!m_wish.file.isEmpty())
            readFiles();
        for (const QString &ring : qAsConst(m_rings))
            readRing(m_ringFolder.filePath(ring));
        const SignalStore *store = m_past.values.store();
        const bool hasRows = !store->isEmpty();
        m_past.isJoined = hasRows && m_isCurrent && store->newestTime() + m_wish.period >= m_wish.before;
        // The first row of a phase comes with its second cycle.
        m_past.isLate = !m_past.isJoined && m_wish.begun() + m_wish.period < m_wish.before;
        m_past.goesOn = hasRows && m_goesOn && store->time(store->firstRow()) == m_wish.after + m_wish.period;
        return std::move(m_past);
    }

private:
    struct Origin
    {
        Time cycleZero;  // on the clock of recordings [ns]
        Time period;     // [ns]
    };

    bool isOver();
    bool mayBeShown(const RingDescription &description) const;
    QStringList files(QString *problem) const;
    QString whatIsMissing() const;
    Time firstWanted(Time end) const;
    void readFiles();
    void readRing(const QString &file);
    bool isLost(const Origin &origin) const;
    std::optional<Time> timeOf(const Origin &origin, quint64 cycle) const;
    std::optional<Time> begin(const Origin &origin, quint64 cycle);

    const PastWish &m_wish;
    const std::atomic<bool> &m_isUnwanted;
    QElapsedTimer m_clock;
    const QDir m_ringFolder{QFile::decodeName(RingMemory::folder())};
    QStringList m_rings;  // of the session, the newest last
    Past m_past;
    bool m_goesOn = false;     // the oldest row is the cycle behind the one that was heard before
    bool m_isCurrent = false;  // the newest row is of the phase of the seam
    Time m_cycleZero = 0;      // of the newest row
    quint64 m_cycle = 0;       // likewise
};

bool PastReading::isOver()
{
    if (m_isUnwanted || m_clock.elapsed() < LongestReading * 1000)
        return m_isUnwanted;
    if (m_past.problem.isEmpty())
        m_past.problem = WindowText::tr("reading the recordings of this plant takes longer than %1 s: its curves have "
                                        "a gap. Remedy: open '%2' as a recording.")
                             .arg(LongestReading)
                             .arg(QFileInfo(m_wish.file).path());
    return true;
}

QString PastReading::whatIsMissing() const
{
    return m_wish.isBetweenRows() ? WindowText::tr("its curves have a gap where this window heard nothing")
                                  : WindowText::tr("its curves begin with this window");
}

/// The times of all phases that are not timed begin at 0: only the ring tells which of them runs.
bool PastReading::mayBeShown(const RingDescription &description) const
{
    const bool isTimed = !m_wish.seam || m_wish.seam->cycleZero != 0;
    return description.session == m_wish.session
        && (isTimed || (!m_rings.isEmpty() && phaseOfRing(m_rings.constLast()) == description.phase));
}

/// Of the phase of the row before the gap, if it is known which one that was.
bool PastReading::isLost(const Origin &origin) const
{
    return m_wish.lost && m_wish.lost->cycleZero != 0 && origin.cycleZero == m_wish.lost->cycleZero;
}

/// A window hears the values of the end of a cycle with the next one: inputs are one cycle old.
/// \return the time of the row of a cycle on the clock of the window; nothing if the window does
///         not need it
std::optional<Time> PastReading::timeOf(const Origin &origin, quint64 cycle) const
{
    const bool isCurrent = m_wish.seam && origin.cycleZero == m_wish.seam->cycleZero;
    if (!isCurrent && origin.cycleZero == 0)
        return std::nullopt;
    if (isCurrent && cycle < m_wish.heardCycles())
        return std::nullopt;
    PastWish::Seam known{0, origin.cycleZero, origin.cycleZero};
    if (isCurrent)
        known = *m_wish.seam;
    else if (isLost(origin))
        known = *m_wish.lost;
    const Time time = timeAfter(known.time, cycle + 1 - known.cycle, origin.period);
    // The time of a plant may run ahead of that of people: the phase of the seam counts.
    if (!isCurrent && m_wish.seam && time > m_wish.begun())
        return std::nullopt;
    return time > m_wish.after && time < m_wish.before ? std::optional(time) : std::nullopt;
}

/// Prepares the store for the row of a cycle. \return its time, as above
std::optional<Time> PastReading::begin(const Origin &origin, quint64 cycle)
{
    const bool isCurrent = m_wish.seam && origin.cycleZero == m_wish.seam->cycleZero;
    const std::optional<Time> time = timeOf(origin, cycle);
    if (!time)
        return std::nullopt;
    const SignalStore *store = m_past.values.store();
    if (*time <= store->newestTime())
        return std::nullopt;  // a file has it
    if (store->isEmpty())
        m_goesOn = isLost(origin) && cycle == m_wish.lost->cycle;
    const bool continues = !store->isEmpty() && origin.cycleZero == m_cycleZero && cycle == m_cycle + 1;
    if (!continues)
        m_past.values.interrupt();
    m_past.values.beginBatch();
    m_isCurrent = isCurrent;
    m_cycleZero = origin.cycleZero;
    m_cycle = cycle;
    return time;
}

/// Those in the folder of the recorder, or the one that it writes where it writes no folder.
QStringList PastReading::files(QString *problem) const
{
    const QFileInfo told(m_wish.file);
    const bool isPath = m_wish.file.startsWith(QLatin1Char('/'));
    const QDir folder(told.path());
    QStringList names;
    if (isPath)
        names = filesOfSession(folder, QStringLiteral("*_%1_phase*.mcap*"), m_wish.session, phaseOfRecording);
    if (isPath && names.isEmpty() && told.isFile() && !told.isSymLink())
        names << told.fileName();
    QStringList files;
    for (const QString &name : qAsConst(names)) {
        const QString file = folder.filePath(name);
        mcap::Reader reader;
        mcap::Outline outline;
        QString error;
        if (!reader.open(file, &error))
            continue;  // deleted meanwhile, or of another person
        if (reader.size() > LargestUnfinishedFile && !reader.readOutline(&outline))
            *problem = WindowText::tr("the recording '%1' of this plant is larger than %2 MiB and not finished: %3. "
                                      "Remedy: record into a folder, whose files end earlier.")
                           .arg(file)
                           .arg(LargestUnfinishedFile >> 20)
                           .arg(whatIsMissing());
        else
            files << file;
    }
    return files;
}

/// Where in the recordings the store has room from, if the row behind the newest one is at \a end.
Time PastReading::firstWanted(Time end) const
{
    const Time length = std::min(RecordedBudget.history, Time(m_past.values.store()->capacity()) * m_wish.period);
    const bool isShort = m_wish.isBetweenRows() && m_wish.before - m_wish.after <= RecordedBudget.history;
    const bool isKnown = isShort && m_wish.lost && m_wish.lost->cycleZero != 0;
    if (!isKnown)
        return end - length;
    return std::min(end - length, timeAfter(m_wish.lost->cycleZero, m_wish.lost->cycle, m_wish.period));
}

void PastReading::readFiles()
{
    const QString unreachable
        = WindowText::tr("the recordings of this plant are in '%1', where this window cannot read them: %2. Remedy: "
                         "open them as a recording on the computer that has them, or copy them to this one.")
              .arg(m_wish.file.startsWith(QLatin1Char('/')) ? QFileInfo(m_wish.file).path() : m_wish.file,
                   whatIsMissing());
    Recording recording;
    QString error;
    QStringList names = files(&m_past.problem);
    if (!m_past.problem.isEmpty())
        return;
    bool isOpen = !names.isEmpty() && recording.open(names, &error, Recording::LeaveOut);
    if (!isOpen && !names.isEmpty()) {  // phases that are not timed cannot be one recording
        const quint64 newest = phaseOfRecording(names.constLast());
        const auto isOlder = [newest](const QString &name) { return phaseOfRecording(name) != newest; };
        names.erase(std::remove_if(names.begin(), names.end(), isOlder), names.end());
        isOpen = recording.open(names, &error, Recording::LeaveOut);
    }
    const auto isOther = [this](const RecordedFile &file) { return file.description.session != m_wish.session; };
    if (!isOpen || std::any_of(recording.files().begin(), recording.files().end(), isOther)) {
        m_past.problem = unreachable;
        return;
    }
    const Time end = m_wish.before - (m_wish.seam ? m_wish.begun() - m_wish.seam->cycleZero : 0);
    RecordedValues values(recording, m_wish.table);
    RecordedRows rows(recording, values.columns(), firstWanted(end), std::numeric_limits<Time>::max());
    while (!isOver() && rows.next()) {
        const Time period = std::max<Time>(rows.file().description.period, 1);
        const quint64 cycle = rows.cycle().number;
        if (!mayBeShown(rows.file().description))
            continue;
        if (const auto time = begin({timeAfter(rows.time(), 0 - cycle, period), period}, cycle))
            values.store(rows, *time, &m_past.values);
    }
    m_past.hasFiles = !m_past.values.store()->isEmpty();
}

/// That of a phase which is over may still be there.
void PastReading::readRing(const QString &file)
{
    RingReader ring;
    RingDescription description;
    QString error;
    if (!ring.open(QFile::encodeName(file), &error)
        || !RingDescription::fromText(ring.memory().description(), &description) || !mayBeShown(description))
        return;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(description.table);
    if (table.toIni() != m_wish.table.toIni())
        return;
    const ProcessImage image(table);
    const Origin origin{ring.memory().header()->startTime, std::max<Time>(description.period, 1)};
    for (auto result = ring.next(); result != RegionReader::Nothing && !isOver(); result = ring.next()) {
        CycleView view;
        if (result != RegionReader::Found || ring.kind() != RecordKind::Cycle
            || !CycleView::read(ring.body(), ring.size(), &view) || view.cycle.imageSize != image.totalSize())
            continue;
        if (const auto time = begin(origin, view.cycle.number))
            m_past.values.storeRow(view.image, *time, view.image + image.qualityOffset(0));
    }
}

}  // namespace

Past readPast(const PastWish &wish, const std::atomic<bool> &isUnwanted)
{
    return PastReading(wish, isUnwanted).read();
}

}  // namespace qplc
