// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcPanelContext.h"
#include "gui/models/SignalTreeModel.h"

namespace qplc {

/// Chosen signals with value, smallest and largest value, quality, age and rate. A row whose signal
/// is missing stays, and shows the signal as soon as it exists. If the window shows a time of the
/// past, values are those of that time.
///
/// Smallest and largest values are those of every cycle since reset(), of numbers with one element;
/// the cells are renewed 10 times a second.
class ValueTableModel : public QAbstractTableModel
{
    Q_OBJECT
public:
    enum Column { Name, Value, Unit, Minimum, Maximum, QualityColumn, Age, Rate, ColumnCount };
    enum Role {
        SortRole = Qt::UserRole,                  // numbers as numbers
        SearchRole = SignalTreeModel::SearchRole  // QString: one search for both
    };

    /// \param context  of the panel; outlives the model
    explicit ValueTableModel(QPlcPanelContext *context, QObject *parent = nullptr);

    QVector<SignalReference> references() const;
    void setReferences(const QVector<SignalReference> &references);
    /// Inserts those that are not there yet before \a row; -1: behind all.
    void add(const QVector<SignalReference> &references, int row = -1);
    /// Forgets smallest and largest values.
    void reset();

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
        QPlcPanelContext::Signal signal;  // with the value that the window shows
        QPlcPast past;                    // none: not a number with one element
        QPlcPast::Range range;
        QPlcPast::Row seen = 0;  // rows of the past before it are in the range
        QStringList texts;       // what was shown last
        bool isTrusted = false;
    };

    Row makeRow(const SignalReference &reference) const;
    void resolve();
    static void forgetRange(Row *row);
    void refresh();
    static void extendRange(Row *row);
    QStringList textsOf(const Row &row) const;
    bool isTrusted(const Row &row) const;
    QString qualityText(const QPlcPanelContext::Signal &signal) const;
    static QString searchText(const Row &row);
    QVariant sortValue(const Row &row, int column) const;

    QPlcPanelContext *m_context;
    QVector<Row> m_rows;
    QTimer m_timer;
};

}  // namespace qplc
