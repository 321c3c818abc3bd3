// SPDX-License-Identifier: Apache-2.0
#include "PlantPast.h"

#include "Plant.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileInfo>

namespace qplc {

namespace {

using Time = PlantValues::Time;

constexpr int lookPeriod = 20;  // [ms]

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
}

PlantPast::~PlantPast()
{
    cancel();
}

/// The store is that of another table.
void PlantPast::begin()
{
    cancel();
    m_attempts = 0;
    m_isDone = m_plant->feed() || m_plant->recording();
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
    m_store.reset();
}

void PlantPast::look()
{
    if (m_isDone || m_work.valid() || m_retry.isActive())
        return;
    const std::optional<PastWish> found = wish();
    if (!found)
        return;
    m_wish = *found;
    m_store = m_plant->sharedStore();
    start();
}

/// \return nothing as long as there is nothing to read, or the first cycle, before which the past
/// ends, has not come
std::optional<PastWish> PlantPast::wish() const
{
    const PlantValues &values = m_plant->values();
    const SignalStore *store = values.store();
    const messages::State &master = m_plant->status().master;
    const bool isRunning = m_plant->status().isRunning();
    if (!store || master.session == 0 || (isRunning && store->isEmpty()))
        return std::nullopt;
    PastWish wish;
    wish.table = values.table();
    wish.period = values.period();
    wish.session = master.session;
    wish.before
        = store->isEmpty() ? Time(QDateTime::currentMSecsSinceEpoch()) * 1'000'000 : store->time(store->firstRow());
    wish.file = master.recorder ? master.recorder->file : QString();
    if (isRunning)
        wish.seam = {values.cycle(), store->newestTime(), Time(quint64(master.cycleZeroTime))};
    const bool isWorthIt = !wish.file.isEmpty() || wish.before - wish.begun() >= LeastOfRing;
    return isWorthIt ? std::optional(wish) : std::nullopt;
}

void PlantPast::start()
{
    ++m_attempts;
    m_isUnwanted = std::make_shared<std::atomic<bool>>(false);
    m_work = std::async(std::launch::async,
                        [wish = m_wish, isUnwanted = m_isUnwanted] { return readPast(wish, *isUnwanted); });
    m_timer.start();
}

void PlantPast::collect()
{
    if (m_work.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    m_timer.stop();
    Past past = m_work.get();
    if (m_store != m_plant->sharedStore()) {  // its period was another one
        begin();
        return;
    }
    const bool isMissing = !past.problem.isEmpty() || past.isLate;
    if (!m_wish.file.isEmpty() && isMissing && m_attempts < MostAttempts) {
        m_retry.start();
        return;
    }
    m_isDone = true;
    m_store.reset();
    give(std::move(past));
}

void PlantPast::give(Past past)
{
    if (!past.problem.isEmpty())
        m_plant->tell(PlantEvent::Information, past.problem);
    const SignalStore *store = past.values.store();
    if (store->isEmpty())
        return;
    const QString begin = QDateTime::fromMSecsSinceEpoch(store->time(store->firstRow()) / 1'000'000)
                              .toString(QStringLiteral("HH:mm:ss"));
    const QString text = past.hasFiles
        ? tr("the curves go back to %1, before this window: from the recordings in '%2'")
              .arg(begin, QFileInfo(m_wish.file).path())
        : tr("the curves go back to %1, before this window: from the ring of the master").arg(begin);
    m_plant->m_values.putBefore(std::move(past.values),
                                past.isJoined ? SignalStore::Continues : SignalStore::BeginsAnew);
    m_plant->tell(PlantEvent::Information, text);
    Q_EMIT m_plant->storeChanged();
}

}  // namespace qplc
