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

void EventLogModel::append(const PlantEvent &event)
{
    int change = asks(event) ? 1 : 0;
    if (rowCount() == MostEvents) {
        change -= asks(m_events.front()) ? 1 : 0;
        beginRemoveRows({}, 0, 0);
        m_events.pop_front();
        endRemoveRows();
    }
    beginInsertRows({}, rowCount(), rowCount());
    m_events.push_back(event);
    endInsertRows();
    count(change);
}

void EventLogModel::acknowledge(const QModelIndex &index)
{
    if (!index.isValid() || !asks(at(index.row())))
        return;
    m_events[std::size_t(index.row())].isAcknowledged = true;
    Q_EMIT dataChanged(index.sibling(index.row(), 0), index.sibling(index.row(), ColumnCount - 1));
    count(-1);
}

void EventLogModel::acknowledgeAll()
{
    if (m_unacknowledged == 0)
        return;
    for (PlantEvent &event : m_events)
        event.isAcknowledged = event.isAcknowledged || asks(event);
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
        = {QT_TR_NOOP("Time"), QT_TR_NOOP("Severity"), QT_TR_NOOP("Source"), QT_TR_NOOP("Event")};
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole || section < 0 || section >= ColumnCount)
        return {};
    return tr(titles[section]);
}

QVariant EventLogModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const PlantEvent &event = at(index.row());
    switch (role) {
    case SeverityRole:
        return int(event.severity);
    case AcknowledgedRole:
        return event.isAcknowledged;
    case Qt::ForegroundRole:
        return foregroundOf(!event.isAcknowledged);
    case Qt::ToolTipRole:
        return index.column() == Time ? event.time.toString(Qt::ISODateWithMs) : event.text;
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
    case Source:
        return event.source;
    default:
        return event.text;
    }
}

// ---- the filter ----

void EventFilterModel::setLeastSeverity(PlantEvent::Severity severity)
{
    m_leastSeverity = severity;
    invalidateFilter();
}

void EventFilterModel::setOnlyUnacknowledged(bool only)
{
    m_onlyUnacknowledged = only;
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
    if (m_onlyUnacknowledged && !asks)
        return false;
    const QString text
        = index.data().toString() + QLatin1Char('\n') + index.siblingAtColumn(EventLogModel::Source).data().toString();
    return std::all_of(m_words.begin(), m_words.end(),
                       [&](const QString &word) { return text.contains(word, Qt::CaseInsensitive); });
}

}  // namespace qplc
