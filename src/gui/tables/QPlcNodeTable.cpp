// SPDX-License-Identifier: Apache-2.0
#include "QPlcNodeTable.h"

#include "EvictionQuestion.h"
#include "PanelTable.h"
#include "QPlcPanelContext.h"
#include "gui/models/NodeTableModel.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/PanelSettings.h"

#include <QtCore/QSortFilterProxyModel>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

TableDelegate::Sign signOfNode(const QModelIndex &index)
{
    if (index.column() != NodeTableModel::Health)
        return TableDelegate::NoSign;
    switch (index.data(NodeTableModel::HealthRole).toInt()) {
    case NodeTableModel::Good:
        return TableDelegate::Good;
    case NodeTableModel::Warning:
        return TableDelegate::Warning;
    case NodeTableModel::Error:
        return TableDelegate::Alarm;
    default:
        return TableDelegate::Unknown;
    }
}

const QVector<PanelTable::Column> nodeColumns = {{"plant", 10, false},
                                                 {"node", 12, true},
                                                 {"health", 11, true},
                                                 {"transport", 10, false},
                                                 {"address", 18, false},
                                                 {"policy", 18, false},
                                                 {"state", 13, true},
                                                 {"latenessP99", 8, true},
                                                 {"executionP50", 8, false},
                                                 {"executionP99", 8, true},
                                                 {"executionMaximum", 8, false},
                                                 {"roundTripP50", 8, false},
                                                 {"roundTripP99", 8, true},
                                                 {"roundTripMaximum", 8, false},
                                                 {"late", 3, true},
                                                 {"lost", 3, true},
                                                 {"duplicated", 10, false},
                                                 {"rejected", 9, false},
                                                 {"forged", 7, false}};

QVector<int> growingColumns()
{
    QVector<int> growing{NodeTableModel::PlantColumn, NodeTableModel::Name, NodeTableModel::Health,
                         NodeTableModel::Address, NodeTableModel::State};
    for (int column = NodeTableModel::LatenessP99; column < NodeTableModel::ColumnCount; ++column)
        growing << column;
    return growing;
}

}  // namespace

struct QPlcNodeTable::Private
{
    NodeEviction eviction() const
    {
        const auto *nodes = qobject_cast<const NodeTableModel *>(sorted->sourceModel());
        return nodes ? nodes->evictionOf(sorted->mapToSource(table->currentIndex())) : NodeEviction();
    }

    void followRow()
    {
        const NodeEviction now = eviction();
        const QString obstacle = now.obstacle();
        const QString dots = QStringLiteral(" ...");
        QAction *const possible = now.isAdmission() ? admit : evict;
        for (QAction *action : {evict, admit}) {
            action->setVisible(action == possible);
            action->setEnabled(action == possible && obstacle.isEmpty());
        }
        evict->setText(NodeEviction::titleOf(now.isAdmission() ? QString() : now.name(), false) + dots);
        admit->setText(NodeEviction::titleOf(now.isAdmission() ? now.name() : QString(), true) + dots);
        possible->setToolTip(obstacle);
        question->follow();
    }

    PanelTable *table = nullptr;
    QSortFilterProxyModel *sorted = nullptr;
    EvictionQuestion *question = nullptr;
    QAction *evict = nullptr;
    QAction *admit = nullptr;
    PanelSettings settings{"columns", "sort", "descending"};
};

QPlcNodeTable::QPlcNodeTable(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    d->table = new PanelTable(signOfNode, PanelTable::Sorting::ByHeader, this);
    d->table->setAccessibleName(tr("Nodes"));
    d->sorted = new QSortFilterProxyModel(this);
    d->sorted->setSortRole(NodeTableModel::SortRole);
    d->table->setModel(d->sorted);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(d->table);
    d->question = new EvictionQuestion(this);
    column->addWidget(d->question);
    setFocusProxy(d->table);
    connect(d->question, &EvictionQuestion::ended, d->table, [this] { d->table->setFocus(Qt::OtherFocusReason); });
    connect(d->table, &PanelTable::settingsEdited, this, [this] {
        d->table->writeSettings(&d->settings);
        Q_EMIT settingsEdited();
    });
    addPanelAction(this, tr("Copy as text"), {QKeySequence::Copy},
                   [this] { QGuiApplication::clipboard()->setText(d->table->toTabSeparated()); });
    const auto ask = [this] { d->question->ask(d->eviction()); };
    d->evict = addPanelAction(this, {}, {tr("Ctrl+E")}, ask, "evict");
    d->admit = addPanelAction(this, {}, {tr("Ctrl+Shift+E")}, ask, "admit");
    connect(d->table->selectionModel(), &QItemSelectionModel::currentChanged, this, [this] { d->followRow(); });
    for (const auto changed : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved})
        connect(d->sorted, changed, this, [this] { d->followRow(); });
    connect(d->sorted, &QAbstractItemModel::dataChanged, this, [this] { d->followRow(); });
    d->followRow();
}

QPlcNodeTable::~QPlcNodeTable() = default;

QJsonObject QPlcNodeTable::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcNodeTable::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    if (d->sorted->sourceModel())
        d->table->applySettings(d->settings);
}

void QPlcNodeTable::contextChanged()
{
    d->sorted->setSourceModel(context()->createNodeModel(this));
    d->table->setContext(context());
    d->table->setColumns(nodeColumns);
    d->table->setNameColumn(NodeTableModel::Name);
    d->table->setStretchedColumn(NodeTableModel::Name, 12);
    d->table->setGrowing(growingColumns());
    d->table->applySettings(d->settings);
    addAction(d->table->createColumnMenu(this)->menuAction());
}

QSize QPlcNodeTable::sizeHint() const
{
    return {560, 160};
}
