// SPDX-License-Identifier: Apache-2.0
#include "EventLogModel.h"

#include "ValueFormat.h"

#include <algorithm>

namespace qplc {

bool EventLogModel::asks(const PlantEvent &event)
{
    return event.severity != PlantEvent::Information && !event.isAcknowledged;
}

void EventLogModel::count(int change)
{
    if (change == 0)
        return;
    m_unacknowledged += change;
    Q_EMIT unacknowledgedChanged(m_unacknowledged);
}

QString EventLogModel::keyOf(const PlantEvent &event)
{
    return event.source + QLatin1Char('\n') + event.alarm;
}

void EventLogModel::append(const PlantEvent &event)
{
    int change = asks(event) ? 1 : 0;
    if (rowCount() == MostEvents) {
        const Entry &oldest = m_events.front();
        change -= asks(oldest.event) ? 1 : 0;
        if (m_active.value(keyOf(oldest.event), m_gone + 1) == m_gone)
            m_active.remove(keyOf(oldest.event));
        beginRemoveRows({}, 0, 0);
        m_events.pop_front();
        ++m_gone;
        endRemoveRows();
    }
    if (event.stage != PlantEvent::Once)
        endAlarm(event);
    if (event.stage == PlantEvent::Begins) {
        joinBurst(event);
        m_active.insert(keyOf(event), m_gone + m_events.size());
    }
    beginInsertRows({}, rowCount(), rowCount());
    m_events.push_back({event});
    endInsertRows();
    count(change);
}

/// An alarm that begins again ends what lasted before, too.
void EventLogModel::endAlarm(const PlantEvent &event)
{
    const auto found = m_active.find(keyOf(event));
    if (found == m_active.end())
        return;
    const int row = int(*found - m_gone);
    m_active.erase(found);
    m_events[std::size_t(row)].end = event.time;
    Q_EMIT dataChanged(index(row, 0), index(row, ColumnCount - 1));
}

/// The event is about to be the newest one.
void EventLogModel::joinBurst(const PlantEvent &event)
{
    const QString plant = event.source.section(QLatin1Char('/'), 0, 0);
    const auto burst = m_bursts.find(plant);
    if (burst == m_bursts.end() || burst->last.msecsTo(event.time) > BurstPause) {
        m_bursts.insert(plant, {m_gone + m_events.size(), event.time});
        return;
    }
    burst->last = std::max(burst->last, event.time);
    if (burst->first < m_gone)
        return;
    const int row = int(burst->first - m_gone);
    if (keyOf(at(row)) == keyOf(event))
        return;  // it has begun again
    ++m_events[std::size_t(row)].followers;
    Q_EMIT dataChanged(index(row, State), index(row, State));
}

QString EventLogModel::stateText(const Entry &entry) const
{
    const QString state = entry.end.isValid() ? tr("Cleared")
        : entry.event.isAcknowledged          ? tr("Acknowledged")
        : isActive(entry)                     ? tr("Active")
                                              : QString();
    return entry.followers > 0 ? tr("1st · %1").arg(state) : state;
}

QString EventLogModel::stateHint(const Entry &entry) const
{
    const QString burst = entry.followers > 0
        ? tr("\nThe first of a burst: alarms that came after it, and may come from it: %1").arg(entry.followers)
        : QString();
    return lifeText(entry) + burst;
}

QString EventLogModel::lifeText(const Entry &entry) const
{
    if (entry.end.isValid())
        return tr("Cleared at %1, after %2")
            .arg(entry.end.toString(QStringLiteral("HH:mm:ss.zzz")),
                 ageText(double(entry.event.time.msecsTo(entry.end)) * 1e-3));
    return isActive(entry) ? tr("It lasts since %1").arg(entry.event.time.toString(Qt::ISODateWithMs))
                           : stateText(entry);
}

void EventLogModel::acknowledge(const QModelIndex &index)
{
    if (!index.isValid() || !asks(at(index.row())))
        return;
    m_events[std::size_t(index.row())].event.isAcknowledged = true;
    Q_EMIT dataChanged(index.sibling(index.row(), 0), index.sibling(index.row(), ColumnCount - 1));
    count(-1);
}

bool EventLogModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    if (!index.isValid() || role != AcknowledgedRole || !value.toBool())
        return false;
    acknowledge(index);
    return true;
}

void EventLogModel::acknowledgeAll()
{
    if (m_unacknowledged == 0)
        return;
    for (Entry &entry : m_events)
        entry.event.isAcknowledged = entry.event.isAcknowledged || asks(entry.event);
    Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, ColumnCount - 1));
    count(-m_unacknowledged);
}

QString EventLogModel::severityText(PlantEvent::Severity severity)
{
    switch (severity) {
    case PlantEvent::Information:
        return tr("Information");
    case PlantEvent::Warning:
        return tr("Warning");
    case PlantEvent::Error:
        return tr("Error");
    }
    return {};
}

int EventLogModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(m_events.size());
}

int EventLogModel::columnCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : int(ColumnCount);
}

QVariant EventLogModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    static const char *const titles[ColumnCount]
        = {QT_TR_NOOP("Time"), QT_TR_NOOP("Severity"), QT_TR_NOOP("State"), QT_TR_NOOP("Source"), QT_TR_NOOP("Event")};
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole || section < 0 || section >= ColumnCount)
        return {};
    return tr(titles[section]);
}

QVariant EventLogModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Entry &entry = m_events[std::size_t(index.row())];
    const PlantEvent &event = entry.event;
    switch (role) {
    case SeverityRole:
        return int(event.severity);
    case AcknowledgedRole:
        return event.isAcknowledged;
    case ActiveRole:
        return isActive(entry);
    case FollowersRole:
        return entry.followers;
    case NoteRole:
        return event.isNote;
    case TimeRole:
        return event.time.toMSecsSinceEpoch();
    case Qt::ForegroundRole:
        return foregroundOf(!event.isAcknowledged);
    case Qt::ToolTipRole:
        return index.column() == State ? stateHint(entry)
            : index.column() == Time   ? event.time.toString(Qt::ISODateWithMs)
                                       : event.text;
    case Qt::DisplayRole:
        break;
    default:
        return {};
    }
    switch (index.column()) {
    case Time:
        return event.time.toString(QStringLiteral("HH:mm:ss.zzz"));
    case Severity:
        return severityText(event.severity);
    case State:
        return stateText(entry);
    case Source:
        return event.source;
    default:
        return event.text;
    }
}

// ---- the filter ----

EventFilterModel::EventFilterModel(QObject *parent)
    : QSortFilterProxyModel(parent)
{
    sort(EventLogModel::Time);
}

bool EventFilterModel::lessThan(const QModelIndex &left, const QModelIndex &right) const
{
    return left.data(EventLogModel::TimeRole).toLongLong() < right.data(EventLogModel::TimeRole).toLongLong();
}

void EventFilterModel::setLeastSeverity(PlantEvent::Severity severity)
{
    m_leastSeverity = severity;
    invalidateFilter();
}

void EventFilterModel::setOnlyOpen(bool only)
{
    m_onlyOpen = only;
    invalidateFilter();
}

void EventFilterModel::setSearch(const QString &text)
{
    m_words = text.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
}

bool EventFilterModel::filterAcceptsRow(int row, const QModelIndex &parent) const
{
    const QModelIndex index = sourceModel()->index(row, EventLogModel::Text, parent);
    const int severity = index.data(EventLogModel::SeverityRole).toInt();
    if (severity < m_leastSeverity)
        return false;
    const bool asks = severity != PlantEvent::Information && !index.data(EventLogModel::AcknowledgedRole).toBool();
    if (m_onlyOpen && !asks && !index.data(EventLogModel::ActiveRole).toBool())
        return false;
    const QString text
        = index.data().toString() + QLatin1Char('\n') + index.siblingAtColumn(EventLogModel::Source).data().toString();
    return std::all_of(m_words.begin(), m_words.end(),
                       [&](const QString &word) { return text.contains(word, Qt::CaseInsensitive); });
}

}  // namespace qplc
