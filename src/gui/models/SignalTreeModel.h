// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ValueFormat.h"

#include <QtCore/QAbstractItemModel>
#include <QtCore/QSet>
#include <QtCore/QTimer>

#include <memory>
#include <optional>
#include <vector>

namespace qplc {

/// All signals of all plants: plant, node that writes it, signal, elements.
///
/// Values are renewed at most 10 times a second, and only those that somebody has looked at since
/// the last time: a view asks for what it paints. So hidden rows and hidden views cost nothing,
/// whatever stands between view and model.
class SignalTreeModel : public QAbstractItemModel
{
    Q_OBJECT
public:
    enum Column { Name, Value, Unit, Age, Description, ColumnCount };
    enum Role {
        ReferenceRole = Qt::UserRole,  // QString; empty for plants and nodes
        SearchRole,                    // QString: name, unit, description, node
        QualityRole                    // Plant::Quality
    };

    explicit SignalTreeModel(PlantList *plants, QObject *parent = nullptr);
    ~SignalTreeModel() override;

    QModelIndex index(int row, int column, const QModelIndex &parent = QModelIndex()) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = QModelIndex()) const override;
    int columnCount(const QModelIndex &parent = QModelIndex()) const override;
    QVariant data(const QModelIndex &index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    QStringList mimeTypes() const override;
    QMimeData *mimeData(const QModelIndexList &indexes) const override;

    /// Everything draggable under an index: the signal itself, or all of a node or plant.
    QVector<SignalReference> references(const QModelIndex &index) const;
    /// Where a reference stands; invalid when there is no such signal now.
    QModelIndex find(const SignalReference &reference) const;

    /// Shows values of the past; empty: those of now.
    void setDisplayTime(std::optional<SignalStore::Time> time);

    static constexpr int RefreshPause = 100;  // [ms]

private:
    struct Item;
    using ItemPtr = std::unique_ptr<Item>;

    void add(Plant *plant);
    void remove(Plant *plant);
    void forget(const Plant *plant);
    void rebuild(Plant *plant);
    void regroup(Plant *plant);
    ItemPtr takeSignal(Item *signal);
    void insertSignal(Item *plantItem, ItemPtr signal, const QString &writer);
    Item *groupFor(Item *plantItem, const QString &writer);
    ItemPtr makeSignal(Plant *plant, QPlcSignalIndex index) const;
    void refresh();
    QPlcValue shownValue(const Item *item) const;
    bool renew(Item *item) const;
    void announce(const std::vector<Item *> &changed);

    Item *itemOf(const QModelIndex &index) const;
    Item *itemOf(const Plant *plant) const;
    QModelIndex indexOf(const Item *item, int column = 0) const;
    QVariant text(const Item *item, int column) const;
    static const QPlcSignalDefinition &definitionOf(const Item *item);
    QString signalText(const Item *item, int column) const;
    QVariant toolTip(const Item *item) const;
    PlantList::Signal signalOf(const Item *item) const;

    PlantList *m_plants;
    ItemPtr m_root;
    QTimer m_timer;
    std::optional<SignalStore::Time> m_displayTime;
    mutable QSet<Item *> m_lookedAt;
};

}  // namespace qplc
