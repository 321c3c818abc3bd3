// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "NodeEviction.h"
#include "gui/plant/PlantList.h"

#include <QtCore/QAbstractTableModel>

namespace qplc {

/// Masters and nodes of all plants with their durations and counters. Durations are those of the
/// last 10 s, the largest ones those since the start of the phase.
class NodeTableModel : public QAbstractTableModel
{
    Q_OBJECT
public:
    enum Column {
        PlantColumn,
        Name,
        Health,
        Transport,
        Address,
        Policy,
        State,
        LatenessP99,  // of a master: how late its cycles begin
        ExecutionP50,
        ExecutionP99,
        ExecutionMaximum,
        RoundTripP50,
        RoundTripP99,
        RoundTripMaximum,
        Late,
        Lost,
        Duplicated,
        Rejected,
        Forged,
        ColumnCount
    };
    enum Role {
        SortRole = Qt::UserRole,  // numbers as numbers: durations in ns
        HealthRole                // HealthLevel
    };
    /// The stop-light of a row: how it is now, not how it was.
    enum HealthLevel { Good, Warning, Error, Unavailable };

    explicit NodeTableModel(PlantList *plants, QObject *parent = nullptr);

    /// What a person can do about the row of \a index; nothing if it is not valid.
    NodeEviction evictionOf(const QModelIndex &index) const;
    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

private:
    struct Row
    {
        Plant *plant;
        bool isMaster;
        NodeStatus node;
        QString state;
        QPlcDurationStatistics lateness;
        bool isThere;  // its master tells of it
    };

    void add(Plant *plant);
    void remove(Plant *plant);
    void update(Plant *plant);
    int firstRowOf(const Plant *plant) const;
    QVector<Row> rowsOf(Plant *plant) const;
    void appendLost(Plant *plant, QVector<Row> *rows) const;
    void tellNames();
    QString nameOf(const Row &row) const;
    QString text(const Row &row, int column) const;
    static HealthLevel healthOf(const Row &row);
    static QVariant number(const Row &row, int column);

    PlantList *m_plants;
    QVector<Row> m_rows;
};

}  // namespace qplc
