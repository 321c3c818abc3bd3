// SPDX-License-Identifier: Apache-2.0
#include "PlantFeed.h"

#include "Plant.h"
#include "node/state/StateText.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace qplc {

namespace {

constexpr int watchPause = 250;  // [ms]

}  // namespace

PlantFeed::PlantFeed(Plant *plant)
    : QObject(plant)
    , m_plant(plant)
{
    m_watch.setInterval(watchPause);
    connect(&m_watch, &QTimer::timeout, this, &PlantFeed::tellQuality);
}

void PlantFeed::connected(const QPlcSignalTable &table)
{
    PlantValues &values = m_plant->m_values;
    const bool isNewTable = !values.store() || table.toIni() != values.table().toIni();
    m_isConnected = true;
    m_watch.start();
    m_isInStep = false;
    if (isNewTable) {
        values.setTable(table, Time(m_period));
        m_plant->m_writers.fill(QString(), table.size());
        m_payload.assign(std::size_t(values.channels().payloadSize()), 0);
        for (QPlcSignalIndex signal = 0; signal < table.size(); ++signal)
            table.at(signal).initial.toBytes(m_payload.data() + values.channels().offset(signal));
        Q_EMIT m_plant->tableChanged();
        Q_EMIT m_plant->storeChanged();
    } else {
        values.interrupt();
    }
    m_plant->tell(PlantEvent::Information, QStringLiteral("connected"));
    setState(messages::MasterState::Off);
    Q_EMIT m_plant->stateChanged();
}

void PlantFeed::disconnected()
{
    if (!m_isConnected)
        return;
    m_isConnected = false;
    m_watch.stop();
    m_plant->m_values.interrupt();
    m_plant->m_status = {};
    m_plant->tell(PlantEvent::Error, QStringLiteral("disconnected"));
    Q_EMIT m_plant->statusChanged();
    Q_EMIT m_plant->stateChanged();
}

void PlantFeed::failed(const QString &sentence)
{
    m_plant->tell(PlantEvent::Error, sentence);
}

/// A master would be asked twice a second; of a node only its values say whether cycles run.
void PlantFeed::tellQuality()
{
    if (m_plant->quality() == m_quality)
        return;
    m_quality = m_plant->quality();
    Q_EMIT m_plant->statusChanged();
}

void PlantFeed::setState(messages::MasterState state)
{
    messages::State &master = m_plant->m_status.master;
    const messages::MasterState before = std::exchange(master.state, state);
    if (state == before)
        return;
    if (m_plant->m_status.isRunning())
        master.stopped.reset();
    if (before != messages::MasterState::Unknown) {
        PlantEvent event{QDateTime::currentDateTime(), PlantEvent::Information, m_plant->name(),
                         QStringLiteral("state %1").arg(stateText(state)), false};
        event.isStateChange = true;
        m_plant->tell(event);
    }
    Q_EMIT m_plant->statusChanged();
    Q_EMIT m_plant->stateChanged();
}

void PlantFeed::initialize(const QPlcSignalList &values)
{
    if (!m_isConnected)
        return;
    setState(messages::MasterState::Ready);
    put(values);
    for (const QPlcSignalList::Entry &entry : values)
        m_plant->m_values.storeValue(entry.index, entry.value);
    m_plant->m_sinceValues.start();
    Q_EMIT m_plant->updated();
}

void PlantFeed::started()
{
    if (!m_isConnected)
        return;
    m_isInStep = false;
    m_plant->m_values.interrupt();
    m_plant->m_sinceRate.start();
    m_plant->m_rowsAtRate = m_plant->m_values.rows();
    m_plant->m_sinceValues.start();  // those of before are not late
    setState(messages::MasterState::RealTime);
}

void PlantFeed::stopped()
{
    if (m_isConnected)
        setState(messages::MasterState::Off);
}

void PlantFeed::put(const QPlcSignalList &values)
{
    const QPlcSignalTable &table = m_plant->table();
    for (const QPlcSignalList::Entry &entry : values) {
        if (entry.index < table.size() && entry.value.type() == table.at(entry.index).type)
            entry.value.toBytes(m_payload.data() + m_plant->values().channels().offset(entry.index));
    }
}

void PlantFeed::begin(int cycles, Time wallTime)
{
    m_plant->m_values.interrupt();
    m_isInStep = true;
    m_lastTime = std::max(m_lastTime, wallTime - Time(cycles * m_period));
}

/// \return time between the rows of a batch [ns]
double PlantFeed::step(int cycles, Time wallTime)
{
    constexpr double farOff = 0.5e9;  // [ns]
    constexpr double shortest = 1e3;
    const double measured = double(wallTime - m_lastWallTime) / cycles;
    const bool isFirst = !m_isInStep;
    if (isFirst)
        begin(cycles, wallTime);
    else if (m_isSecondBatch && !(measured < 2.0 * m_period && measured > 0.5 * m_period))
        m_period = std::max(measured, shortest);
    m_isSecondBatch = isFirst;
    m_lastWallTime = wallTime;
    double ahead = double(m_lastTime - wallTime) + cycles * m_period;
    if (std::fabs(ahead) > farOff) {
        begin(cycles, wallTime);
        m_isSecondBatch = true;
        ahead = 0.0;
    }
    // A loop that holds the rows to the wall clock; both gains together settle without overshoot.
    m_period = std::max(m_period - 0.0025 * ahead / cycles, shortest);
    return std::max(m_period - 0.1 * ahead / cycles, 0.5 * m_period);
}

void PlantFeed::add(const QList<QPlcSignalList> &cycles, Time wallTime)
{
    PlantValues &values = m_plant->m_values;
    if (!m_isConnected || !values.store() || cycles.isEmpty())
        return;
    if (!m_plant->m_status.isRunning())
        setState(messages::MasterState::RealTime);  // cycles say so themselves
    values.beginBatch();
    const Time between = Time(step(cycles.size(), wallTime));
    for (const QPlcSignalList &cycle : cycles) {
        put(cycle);
        m_lastTime += between;
        values.storeRow(m_payload.data(), m_lastTime);
    }
    m_plant->m_sinceValues.start();
    m_plant->measureRate();
    tellQuality();
    Q_EMIT m_plant->updated();
}

}  // namespace qplc
