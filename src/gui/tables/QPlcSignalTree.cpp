// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalTree.h"

#include "ExpansionMemory.h"
#include "PanelTable.h"
#include "QPlcPanelContext.h"
#include "SearchLine.h"
#include "TimeStrip.h"
#include "gui/models/SignalFilterModel.h"
#include "gui/models/SignalTreeModel.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/PanelSettings.h"

#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

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
    QAbstractItemModel *model = nullptr;   // from contextChanged() on
    ExpansionMemory *expansion = nullptr;  // too
    QList<QAction *> shows;                // in another panel
    QAction *showSetter = nullptr;
    QList<QAction *> others;  // search and columns; those of the window come between
    QAction *openMenu = nullptr;
    QTimer changed;  // the selection may be another one
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
    d->changed.setSingleShot(true);
    connect(&d->changed, &QTimer::timeout, this, &QPlcSignalTree::updateActions);
    connect(d->filter, &QAbstractItemModel::modelReset, &d->changed, QOverload<>::of(&QTimer::start));
    connect(d->filter, &QAbstractItemModel::rowsInserted, &d->changed, QOverload<>::of(&QTimer::start));
    connect(d->filter, &QAbstractItemModel::rowsRemoved, &d->changed, QOverload<>::of(&QTimer::start));
    connect(d->table->selectionModel(), &QItemSelectionModel::selectionChanged, this, &QPlcSignalTree::updateActions);
    updateActions();
}

QPlcSignalTree::~QPlcSignalTree() = default;

void QPlcSignalTree::makeActions()
{
    const auto makeShow = [&](const QString &text, const QList<QKeySequence> &keys, const QString &typeName) {
        d->shows << addPanelAction(this, text, keys, [this, typeName] { request(typeName); });
    };
    makeShow(tr("Show in a plot"), {Qt::Key_Return, Qt::Key_Enter}, QStringLiteral("Time plot"));
    makeShow(tr("Show in an XY plot"), {Qt::Key_X}, QStringLiteral("XY plot"));
    makeShow(tr("Show the spectrum"), {Qt::Key_Q}, QStringLiteral("Spectrum"));
    makeShow(tr("Show as a gauge"), {Qt::Key_G}, QStringLiteral("Gauge"));
    makeShow(tr("Watch in a value table"), {Qt::Key_W}, QStringLiteral("Value table"));
    makeShow(tr("Set by a setter"), {Qt::Key_S}, QStringLiteral("Setter"));
    d->showSetter = d->shows.last();
    d->others << addPanelAction(this, tr("Search signals"), {QKeySequence::Find}, [this] { startSearch(); });
    d->openMenu = addPanelAction(this, tr("Menu of the signals"), {tr("Shift+F10")}, [this] { openMenuAtRow(); });
    leaveByEscape(d->search, d->table);
    const auto toTree = [this] {  // from the line into the rows
        d->table->setFocus(Qt::TabFocusReason);
        if (!d->table->currentIndex().isValid())
            d->table->setCurrentIndex(d->filter->index(0, 0));
    };
    addPanelAction(d->search, {}, {Qt::Key_Down}, toTree, "", Qt::WidgetShortcut);
}

void QPlcSignalTree::updateActions()
{
    const QStringList references = selectedReferences();
    for (QAction *action : qAsConst(d->shows))
        action->setEnabled(!references.isEmpty());
    if (!d->model)
        return;
    // What the master measures is nobody else's to set.
    const auto maySet = [this](const QString &text) {
        const QPlcPanelContext::Signal signal = context()->signal(text);
        return signal && signal.writer != QLatin1String("Master");
    };
    d->showSetter->setEnabled(!references.isEmpty() && std::all_of(references.begin(), references.end(), maySet));
    Q_EMIT selectionChanged();
}

/// All that is done with signals: as other panels, where the window puts them, and with the tree
/// itself.
void QPlcSignalTree::openMenu(const QPoint &place)
{
    updateActions();
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addActions(d->shows);
    menu->addSeparator();
    for (QAction *action : actions()) {
        if (!d->shows.contains(action) && !d->others.contains(action) && action != d->openMenu)
            menu->addAction(action);
    }
    menu->addSeparator();
    for (QAction *action : qAsConst(d->others))
        menu->addAction(action);
    if (auto *panelMenu = findChild<QAction *>(QStringLiteral("panelMenu")))  // of the frame around
        menu->addAction(panelMenu);
    for (QAction *action : menu->actions())
        action->setShortcutVisibleInContextMenu(true);
    menu->popup(place);
}

/// Below the row with the keyboard, where people look.
void QPlcSignalTree::openMenuAtRow()
{
    const QRect row = d->table->visualRect(d->table->currentIndex());
    const QRect seen = row & d->table->viewport()->rect();
    openMenu(d->table->viewport()->mapToGlobal(seen.isEmpty() ? QPoint(0, 0) : seen.bottomLeft()));
}

void QPlcSignalTree::contextMenuEvent(QContextMenuEvent *event)
{
    if (event->reason() == QContextMenuEvent::Keyboard)
        openMenuAtRow();
    else
        openMenu(event->globalPos());
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

namespace {

/// The signal of a row, or all signals of a plant or a node.
void addReferences(const QModelIndex &row, QStringList *references)
{
    const QString reference = row.siblingAtColumn(0).data(QPlcPanelContext::ReferenceRole).toString();
    if (!reference.isEmpty())
        *references << reference;
    const int below = reference.isEmpty() && row.isValid() ? row.model()->rowCount(row) : 0;
    for (int i = 0; i < below; ++i)
        addReferences(row.model()->index(i, 0, row), references);
}

}  // namespace

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
    for (const QModelIndex &index : qAsConst(chosen))
        addReferences(d->filter->mapToSource(index), &references);
    references.removeDuplicates();
    return references;
}

void QPlcSignalTree::search(const QString &text)
{
    d->filter->setSearch(text);
    updateActions();
    if (d->expansion)
        d->expansion->setSuspended(!text.isEmpty());
    if (d->settings.set("search", text, QString()))
        Q_EMIT settingsEdited();
}

QJsonObject QPlcSignalTree::settings() const
{
    return settingsWith(d->settings.toJson());
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
    d->model = context()->createSignalModel(this);
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
    d->others << d->table->createColumnMenu(this)->menuAction();
    addAction(d->others.last());
}

QSize QPlcSignalTree::sizeHint() const
{
    return {320, 420};
}
