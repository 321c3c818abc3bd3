// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ValueFormat.h"

#include <QtCore/QAbstractTableModel>
#include <QtCore/QTimer>

#include <optional>

namespace qplc {

/// Chosen signals with value, smallest and largest value, quality, age and rate. What is not there
/// now stays as a placeholder and comes to life with its signal.
///
/// Smallest and largest values are those of every cycle since reset(), of numbers with one element;
/// the cells are renewed 10 times a second.
class ValueTableModel : public QAbstractTableModel
{
    Q_OBJECT
public:
    enum Column { Name, Value, Unit, Minimum, Maximum, QualityColumn, Age, Rate, ColumnCount };
    enum Role {
        SortRole = Qt::UserRole,  // numbers as numbers
        SearchRole                // QString, as that of SignalTreeModel
    };

    explicit ValueTableModel(PlantList *plants, QObject *parent = nullptr);

    QVector<SignalReference> references() const;
    void setReferences(const QVector<SignalReference> &references);
    /// The plant that references without a plant mean; empty: the selected one.
    void setPin(const QString &plant);
    /// Inserts those that are not there yet before \a row; -1: behind all.
    void add(const QVector<SignalReference> &references, int row = -1);
    /// Forgets smallest and largest values.
    void reset();
    /// Shows values of the past; empty: those of now.
    void setDisplayTime(std::optional<SignalStore::Time> time);

    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
    bool removeRows(int row, int count, const QModelIndex &parent = QModelIndex()) override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    QStringList mimeTypes() const override;
    QMimeData *mimeData(const QModelIndexList &indexes) const override;
    bool dropMimeData(const QMimeData *data, Qt::DropAction action, int row, int column,
                      const QModelIndex &parent) override;

    static constexpr int RefreshPause = 100;  // [ms]

private:
    struct Row
    {
        SignalReference reference;
        PlantList::Signal signal;
        float minimum;
        float maximum;
        SignalStore::Row seen;  // rows of the store before it are in minimum and maximum
        QStringList texts;      // what was shown last
        bool isTrusted = false;
    };

    Row makeRow(const SignalReference &reference) const;
    void resolve();
    void forgetRange(Row *row) const;
    void refresh();
    static void extendRange(Row *row);
    QStringList textsOf(const Row &row) const;
    QPlcValue shownValue(const Row &row) const;
    bool isTrusted(const Row &row) const;
    static QString searchText(const Row &row);
    QVariant sortValue(const Row &row, int column) const;

    PlantList *m_plants;
    QString m_pin;
    QVector<Row> m_rows;
    std::optional<SignalStore::Time> m_displayTime;
    QTimer m_timer;
};

}  // namespace qplc
