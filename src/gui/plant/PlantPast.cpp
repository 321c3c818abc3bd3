// SPDX-License-Identifier: Apache-2.0
#include "PlantPast.h"

#include "Plant.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileInfo>

#include <algorithm>

namespace qplc {

namespace {

using Time = PlantValues::Time;

constexpr int lookPeriod = 20;  // [ms]

QString clockText(Time time)
{
    return QDateTime::fromMSecsSinceEpoch(time / 1'000'000).toString(QStringLiteral("HH:mm:ss"));
}

QString folderOf(const QString &file)
{
    return file.isEmpty() ? QString() : QFileInfo(file).path();
}

/// Rows that are there already in a gap.
SignalStore::Row rowsIn(const SignalStore &store, const PastWish &wish)
{
    const SignalStore::Row first = wish.isBetweenRows() ? store.rowAt(wish.after + 1) : store.firstRow();
    return store.rowAt(wish.before) - first;
}

}  // namespace

PlantPast::PlantPast(Plant *plant)
    : QObject(plant)
    , m_plant(plant)
{
    m_timer.setInterval(lookPeriod);
    connect(&m_timer, &QTimer::timeout, this, &PlantPast::collect);
    m_retry.setSingleShot(true);
    m_retry.setInterval(Pause);
    connect(&m_retry, &QTimer::timeout, this, &PlantPast::start);
    connect(plant, &Plant::tableChanged, this, &PlantPast::begin);
    connect(plant, &Plant::statusChanged, this, &PlantPast::look);
    connect(&plant->m_connection, &PlantConnection::listenerFailed, this, &PlantPast::lose);
}

PlantPast::~PlantPast()
{
    cancel();
}

/// The store is an empty one: of another table, or of another period.
void PlantPast::begin()
{
    cancel();
    m_gaps.clear();
    m_problem.clear();
    m_store.reset();
    if (m_plant->feed() || m_plant->recording())
        return;
    m_store = m_plant->sharedStore();
    m_gaps.emplace_back();
}

/// The future waits for its thread, which looks at the flag.
void PlantPast::cancel()
{
    m_timer.stop();
    m_retry.stop();
    if (m_isUnwanted)
        *m_isUnwanted = true;
    m_work = {};
    m_isUnwanted.reset();
    m_reading = nullptr;
}

void PlantPast::look()
{
    if (!m_store)
        return;  // there was no table yet, or its values come from elsewhere
    if (m_store != m_plant->sharedStore())
        begin();
    if (!m_plant->isConnected()) {
        lose();
        return;
    }
    if (!m_gaps.empty() && m_gaps.back().isOpen())
        close(&m_gaps.back());
    if (m_gaps.empty() || !m_gaps.back().isOpen())
        addHoles();
    if (m_reading)
        return;
    m_reading = nextGap();
    if (!m_reading)
        return;
    m_reading->lookedIn = folderOf(file());
    m_reading->attempts = 0;
    start();
}

/// The next row that comes does not follow the newest one.
void PlantPast::lose()
{
    const PlantValues &values = m_plant->values();
    const SignalStore *store = values.store();
    const bool isOpen = !m_gaps.empty() && m_gaps.back().isOpen();
    if (!m_store || !store || store->isEmpty() || (isOpen && store->newestTime() <= m_gaps.back().wish.after))
        return;
    if (isOpen)
        m_gaps.pop_back();  // the master has not told what was behind it
    Gap gap;
    gap.wish.after = store->newestTime();
    gap.wish.lost = PastWish::Seam{values.cycle(), gap.wish.after, values.phase().cycleZero};
    gap.sessionBefore = values.phase().session;
    append(gap);
}

void PlantPast::append(const Gap &gap)
{
    m_gaps.push_back(gap);
    if (m_gaps.size() > MostGaps && m_reading != &m_gaps.front())
        m_gaps.pop_front();
}

/// Those of the phase that runs.
void PlantPast::addHoles()
{
    const PlantValues &values = m_plant->values();
    const PlantValues::Phase phase = values.phase();
    const quint64 session = m_plant->status().master.session;
    if (session == 0)
        return;  // the master has not told it yet
    for (const PlantValues::Hole &hole : m_plant->m_values.takeHoles()) {
        if (hole.run != values.run())
            continue;
        Gap gap;
        gap.wish.table = values.table();
        gap.wish.period = values.period();
        gap.wish.session = session;
        gap.wish.after = hole.after;
        gap.wish.before = hole.before;
        gap.wish.seam = PastWish::Seam{values.cycle(), values.store()->newestTime(), phase.cycleZero};
        gap.wish.lost = PastWish::Seam{hole.cycle, hole.after, phase.cycleZero};
        gap.sessionBefore = session;
        gap.run = hole.run;
        gap.isClosed = gap.hasEnd = true;
        append(gap);
    }
}

/// Tells what is behind a gap, as soon as the master has told its state, and the first cycle has
/// come.
void PlantPast::close(Gap *gap) const
{
    const PlantValues &values = m_plant->values();
    const SignalStore *store = values.store();
    const messages::State &master = m_plant->status().master;
    const bool isRunning = m_plant->status().isRunning();
    PastWish &wish = gap->wish;
    const SignalStore::Row behind = wish.isBetweenRows() ? store->rowAt(wish.after + 1) : store->firstRow();
    const bool hasRows = behind < store->endRow();
    if (master.session == 0 || (isRunning && !hasRows))
        return;
    gap->isClosed = true;
    gap->hasEnd = hasRows;
    gap->run = values.run();
    wish.table = values.table();
    wish.period = values.period();
    wish.session = master.session;
    wish.before = hasRows ? store->time(behind) : Time(QDateTime::currentMSecsSinceEpoch()) * 1'000'000;
    if (isRunning)
        wish.seam = PastWish::Seam{values.cycle(), store->newestTime(), Time(quint64(master.cycleZeroTime))};
    if (gap->sessionBefore != wish.session)
        wish.lost.reset();
}

PlantPast::Gap *PlantPast::nextGap()
{
    const auto found = std::find_if(m_gaps.begin(), m_gaps.end(), [this](const Gap &gap) { return isWanted(gap); });
    return found == m_gaps.end() ? nullptr : &*found;
}

bool PlantPast::isWanted(const Gap &gap) const
{
    const PastWish &wish = gap.wish;
    if (!gap.isClosed || gap.isDone || isOutdated(gap))
        return false;
    const QString folder = folderOf(file());
    if (gap.lookedIn && (folder.isEmpty() || folder == *gap.lookedIn))
        return false;
    return !folder.isEmpty() || wish.isBetweenRows() || wish.before - wish.begun() >= LeastOfRing;
}

/// The store has no room for it; or it belongs to a phase that is not timed, and another one may
/// run: they look the same.
bool PlantPast::isOutdated(const Gap &gap) const
{
    const SignalStore *store = m_plant->store();
    const PastWish &wish = gap.wish;
    const bool isGone = wish.isBetweenRows()
        ? store->isEmpty() || store->time(store->firstRow()) > wish.after
        : store->endRow() - store->firstRow() >= SignalStore::Row(store->capacity());
    const bool isTimed = !wish.seam || wish.seam->cycleZero != 0;
    return isGone || (!isTimed && gap.run != m_plant->values().run());
}

/// That the recorder writes; empty: nobody records.
QString PlantPast::file() const
{
    const auto &recorder = m_plant->status().master.recorder;
    return recorder ? recorder->file : QString();
}

void PlantPast::start()
{
    PastWish wish = m_reading->wish;
    wish.file = file();
    ++m_reading->attempts;
    m_isUnwanted = std::make_shared<std::atomic<bool>>(false);
    m_work = std::async(std::launch::async, [wish, isUnwanted = m_isUnwanted] { return readPast(wish, *isUnwanted); });
    m_timer.start();
}

void PlantPast::collect()
{
    if (m_work.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    m_timer.stop();
    Past past = m_work.get();
    if (m_store != m_plant->sharedStore()) {
        begin();
        return;
    }
    const bool isMissing = !past.problem.isEmpty() || past.isLate;
    const bool isRecorded = !m_reading->lookedIn->isEmpty();
    if (isRecorded && isMissing && m_reading->attempts < MostAttempts && !isOutdated(*m_reading))
        m_retry.start();
    else
        finish(std::move(past));
}

void PlantPast::finish(Past past)
{
    Gap *gap = m_reading;
    m_reading = nullptr;
    gap->isDone = past.isWhole();
    if (!isOutdated(*gap))
        give(*gap, std::move(past));
}

void PlantPast::give(const Gap &gap, Past past)
{
    if (!past.problem.isEmpty() && past.problem != m_problem)
        m_plant->tell(PlantEvent::Information, past.problem);
    m_problem = past.problem;
    const SignalStore *found = past.values.store();
    const SignalStore::Row rows = found->endRow() - found->firstRow();
    if (rows <= rowsIn(*m_store, gap.wish))
        return;
    const bool isBetweenRows = gap.wish.isBetweenRows();
    const QString source
        = past.hasFiles ? tr("from the recordings in '%1'").arg(*gap.lookedIn) : tr("from the ring of the master");
    const QString text = isBetweenRows
        ? tr("the curves have what was from %1 to %2, which this window had not heard: %3")
              .arg(clockText(gap.wish.after), clockText(gap.wish.before), source)
        : tr("the curves go back to %1, before this window: %2").arg(clockText(found->time(found->firstRow())), source);
    const auto seam = [](bool continues) { return continues ? SignalStore::Continues : SignalStore::BeginsAnew; };
    const Time history = gap.lookedIn->isEmpty() ? Time(0) : RecordedBudget.history;
    m_plant->m_values.fill({gap.wish.after, gap.wish.before, seam(past.goesOn), seam(past.isJoined)},
                           std::move(past.values), history);
    m_store = m_plant->sharedStore();
    m_plant->tell(PlantEvent::Information, text);
    Q_EMIT m_plant->storeChanged();
}

}  // namespace qplc
