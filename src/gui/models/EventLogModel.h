// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantEvent.h"

#include <QtCore/QAbstractTableModel>
#include <QtCore/QSortFilterProxyModel>

#include <deque>

namespace qplc {

/// What happened, newest last, at most 10 000 events: the oldest ones go. What is not information asks to be acknowledged.
class EventLogModel : public QAbstractTableModel
{
    Q_OBJECT
public:
    enum Column { Time, Severity, Source, Text, ColumnCount };
    enum Role { SeverityRole = Qt::UserRole, AcknowledgedRole };

    static constexpr int MostEvents = 10'000;

    using QAbstractTableModel::QAbstractTableModel;

    /// The way in for all events.
    void append(const qplc::PlantEvent &event);
    void acknowledge(const QModelIndex &index);
    void acknowledgeAll();
    /// Warnings and errors that nobody has acknowledged; of those that are still there.
    int unacknowledged() const { return m_unacknowledged; }
    const PlantEvent &at(int row) const { return m_events[std::size_t(row)]; }

    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

    static QString severityText(PlantEvent::Severity severity);

Q_SIGNALS:
    void unacknowledgedChanged(int count);

private:
    static bool asks(const PlantEvent &event);
    void count(int change);

    std::deque<PlantEvent> m_events;
    int m_unacknowledged = 0;
};

/// Of an EventLogModel what is severe enough, not acknowledged if wanted, and has all words of a search in source or text.
class EventFilterModel : public QSortFilterProxyModel
{
    Q_OBJECT
public:
    using QSortFilterProxyModel::QSortFilterProxyModel;

    void setLeastSeverity(qplc::PlantEvent::Severity severity);
    void setOnlyUnacknowledged(bool only);
    void setSearch(const QString &text);

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;

private:
    PlantEvent::Severity m_leastSeverity = PlantEvent::Information;
    bool m_onlyUnacknowledged = false;
    QStringList m_words;
};

}  // namespace qplc
