// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTree.h"

#include "ExpansionMemory.h"
#include "PanelTable.h"
#include "TableTime.h"
#include "TimeStrip.h"
#include "gui/models/SignalFilterModel.h"
#include "gui/models/SignalTreeModel.h"
#include "gui/panel/PanelSettings.h"
#include "gui/panel/WindowContext.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

const QVector<PanelTable::Column> columns
    = {{"name", 22, true}, {"value", 9, true}, {"unit", 4, true}, {"age", 8, false}, {"description", 40, false}};

}  // namespace

struct QPlcSignalTree::Private
{
    QLineEdit *search = nullptr;
    PanelTable *table = nullptr;
    TimeStrip *strip = nullptr;
    SignalFilterModel *filter = nullptr;
    SignalTreeModel *model = nullptr;      // from contextChanged() on
    ExpansionMemory *expansion = nullptr;  // too
    PanelSettings settings{"search", "columns", "collapsed", "expanded"};
};

QPlcSignalTree::QPlcSignalTree(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    d->search = new QLineEdit(this);
    d->search->setPlaceholderText(tr("Search signals"));
    d->search->setAccessibleName(tr("Search signals"));
    d->search->setClearButtonEnabled(true);
    d->table = new PanelTable(nullptr, PanelTable::Sorting::None, this);
    d->table->setAccessibleName(tr("Signals"));
    d->table->setRootIsDecorated(true);
    d->table->setIndentation(12);
    d->table->setDragDropMode(QAbstractItemView::DragOnly);
    d->filter = new SignalFilterModel(this);
    d->table->setModel(d->filter);
    d->strip = new TimeStrip(this);
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto *searchRow = new QVBoxLayout;
    searchRow->setContentsMargins(4, 4, 4, 4);
    searchRow->addWidget(d->search);
    column->addLayout(searchRow);
    column->addWidget(d->strip);
    column->addWidget(d->table);
    setFocusProxy(d->search);
    connect(d->search, &QLineEdit::textChanged, this, &QPlcSignalTree::search);
    connect(d->table, &QAbstractItemView::doubleClicked, this, [this](const QModelIndex &index) {
        if (!index.siblingAtColumn(0).data(SignalTreeModel::ReferenceRole).toString().isEmpty())
            request(QStringLiteral("Time plot"));
    });
    makeActions();
}

QPlcSignalTree::~QPlcSignalTree() = default;

void QPlcSignalTree::makeActions()
{
    const auto make = [this](const QString &text, const QList<QKeySequence> &keys, const auto &act) {
        auto *action = new QAction(text, this);
        action->setShortcuts(keys);
        action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
        connect(action, &QAction::triggered, this, act);
        addAction(action);
    };
    make(tr("Show in a plot"), {Qt::Key_Return, Qt::Key_Enter}, [this] { request(QStringLiteral("Time plot")); });
    make(tr("Show as a gauge"), {Qt::Key_G}, [this] { request(QStringLiteral("Gauge")); });
    make(tr("Watch in a value table"), {Qt::Key_W}, [this] { request(QStringLiteral("Value table")); });
    make(tr("Search signals"), {QKeySequence::Find}, [this] { startSearch(); });
    auto *toTree = new QAction(d->search);  // from the line into the rows
    toTree->setShortcut(QKeySequence(Qt::Key_Down));
    toTree->setShortcutContext(Qt::WidgetShortcut);
    d->search->addAction(toTree);
    connect(toTree, &QAction::triggered, d->table, [this] {
        d->table->setFocus(Qt::TabFocusReason);
        if (!d->table->currentIndex().isValid())
            d->table->setCurrentIndex(d->filter->index(0, 0));
    });
}

void QPlcSignalTree::startSearch()
{
    d->search->setFocus(Qt::ShortcutFocusReason);
    d->search->selectAll();
}

void QPlcSignalTree::request(const QString &typeName)
{
    const QStringList references = selectedReferences();
    if (!references.isEmpty())
        Q_EMIT showRequested(references, typeName);
}

QStringList QPlcSignalTree::selectedReferences() const
{
    if (!d->model)
        return {};
    QModelIndexList chosen = d->table->selectionModel()->selectedRows();
    if (chosen.isEmpty() && !d->filter->search().isEmpty()) {
        QModelIndex first = d->filter->index(0, 0);
        while (first.isValid() && first.data(SignalTreeModel::ReferenceRole).toString().isEmpty())
            first = d->filter->index(0, 0, first);
        chosen << first;
    }
    QStringList references;
    for (const QModelIndex &index : qAsConst(chosen)) {
        const QVector<SignalReference> below = d->model->references(d->filter->mapToSource(index));
        for (const SignalReference &reference : below) {
            if (!references.contains(reference.toString()))
                references << reference.toString();
        }
    }
    return references;
}

void QPlcSignalTree::search(const QString &text)
{
    d->filter->setSearch(text);
    if (d->expansion)
        d->expansion->setSuspended(!text.isEmpty());
    if (d->settings.set("search", text, QString()))
        Q_EMIT settingsEdited();
}

QJsonObject QPlcSignalTree::settings() const
{
    return d->settings.addedTo(QPlcWidget::settings());
}

void QPlcSignalTree::applySettings(const QJsonObject &settings)
{
    QPlcWidget::applySettings(d->settings.take(settings));
    const QString wanted = d->settings.value("search").toString();
    if (d->search->text() != wanted)
        d->search->setText(wanted);
    if (!d->model)
        return;
    d->expansion->applySettings(d->settings);
    d->table->applySettings(d->settings);
}

void QPlcSignalTree::contextChanged()
{
    d->model = new SignalTreeModel(context()->plants(), this);
    d->filter->setSourceModel(d->model);
    d->table->setContext(context());
    d->table->setColumns(columns);
    d->table->setNameColumn(SignalTreeModel::Name);
    d->table->setStretchedColumn(SignalTreeModel::Name, 18);
    d->table->applySettings(d->settings);
    d->expansion = new ExpansionMemory(d->table);
    d->expansion->applySettings(d->settings);
    d->expansion->setSuspended(!d->search->text().isEmpty());
    const auto take = [this] {
        d->table->writeSettings(&d->settings);
        d->expansion->writeSettings(&d->settings);
        Q_EMIT settingsEdited();
    };
    connect(d->table, &PanelTable::settingsEdited, this, take);
    connect(d->expansion, &ExpansionMemory::edited, this, take);
    d->strip->setContext(context());
    followDisplayTime(d->model, context());
    addAction(d->table->createColumnMenu(this)->menuAction());
}

QSize QPlcSignalTree::sizeHint() const
{
    return {320, 420};
}
