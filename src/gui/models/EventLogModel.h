// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plant/PlantEvent.h"

#include <QtCore/QAbstractTableModel>
#include <QtCore/QHash>
#include <QtCore/QSortFilterProxyModel>

#include <deque>

namespace qplc {

/// What happened, newest last, at most 10 000 events: the oldest ones go. What is not information
/// asks to be acknowledged; what lasts (PlantEvent::Begins) is active until it ends, acknowledged
/// or not.
///
/// Alarms of one plant that follow each other within BurstPause are a burst: the first of them,
/// which the others may come from, says so.
class EventLogModel : public QAbstractTableModel
{
    Q_OBJECT
public:
    enum Column { Time, Severity, State, Source, Text, ColumnCount };
    enum Role { SeverityRole = Qt::UserRole, AcknowledgedRole, ActiveRole, FollowersRole, TimeRole, NoteRole };

    static constexpr int MostEvents = 10'000;
    static constexpr int BurstPause = 5000;  // [ms]

    using QAbstractTableModel::QAbstractTableModel;

    /// The way in for all events.
    void append(const qplc::PlantEvent &event);
    void acknowledge(const QModelIndex &index);
    void acknowledgeAll();
    /// Alarms that last.
    int active() const { return m_active.size(); }
    /// Warnings and errors that nobody has acknowledged; of those that are still there.
    int unacknowledged() const { return m_unacknowledged; }
    const PlantEvent &at(int row) const { return m_events[std::size_t(row)].event; }

    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
    /// Takes AcknowledgedRole alone, which does not become false again.
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;

    static QString severityText(PlantEvent::Severity severity);

Q_SIGNALS:
    void unacknowledgedChanged(int count);

private:
    struct Burst
    {
        quint64 first;  // its alarm, counted from the first event ever
        QDateTime last;
    };
    struct Entry
    {
        PlantEvent event;
        QDateTime end{};    // of what lasted
        int followers = 0;  // alarms of the burst that it began
    };

    static bool asks(const PlantEvent &event);
    static QString keyOf(const PlantEvent &event);
    QString stateText(const Entry &entry) const;
    QString stateHint(const Entry &entry) const;
    QString lifeText(const Entry &entry) const;
    bool isActive(const Entry &entry) const { return entry.event.stage == PlantEvent::Begins && !entry.end.isValid(); }
    void endAlarm(const PlantEvent &event);
    void joinBurst(const PlantEvent &event);
    void count(int change);

    std::deque<Entry> m_events;
    quint64 m_gone = 0;                // events that were the oldest ones
    QHash<QString, quint64> m_active;  // alarms that last, and where they began, counted from the first event ever
    QHash<QString, Burst> m_bursts;    // of each plant, the last one
    int m_unacknowledged = 0;
};

/// Of an EventLogModel what is severe enough, active or not acknowledged if wanted, and has all
/// words of a search in source or text; in the order of time, whenever it was told.
class EventFilterModel : public QSortFilterProxyModel
{
    Q_OBJECT
public:
    explicit EventFilterModel(QObject *parent = nullptr);

    void setLeastSeverity(qplc::PlantEvent::Severity severity);
    void setOnlyOpen(bool only);
    void setSearch(const QString &text);

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;
    bool lessThan(const QModelIndex &left, const QModelIndex &right) const override;

private:
    PlantEvent::Severity m_leastSeverity = PlantEvent::Information;
    bool m_onlyOpen = false;
    QStringList m_words;
};

}  // namespace qplc
