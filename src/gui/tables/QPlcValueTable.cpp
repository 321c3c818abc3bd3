// SPDX-License-Identifier: Apache-2.0
#include "QPlcValueTable.h"

#include "PanelTable.h"
#include "QPlcPanelContext.h"
#include "TimeStrip.h"
#include "ValueTableModel.h"
#include "gui/models/SignalFilterModel.h"
#include "gui/panel/PanelAction.h"
#include "gui/panel/PanelSettings.h"
#include "gui/panel/SignalEdit.h"

#include <QtCore/QTimer>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

using namespace qplc;

namespace {

const QVector<PanelTable::Column> valueColumns
    = {{"signal", 20, true},  {"value", 13, true},  {"unit", 7, true}, {"minimum", 12, true},
       {"maximum", 12, true}, {"quality", 9, true}, {"age", 8, false}, {"rate", 9, false}};

QVector<SignalReference> referencesOf(const QStringList &texts)
{
    QVector<SignalReference> references;
    for (const QString &text : texts) {
        const SignalReference reference = SignalReference::fromString(text);
        if (reference.isValid())
            references << reference;
    }
    return references;
}

}  // namespace

struct QPlcValueTable::Private
{
    PanelTable *table = nullptr;
    SignalFilterModel *sorted = nullptr;
    ValueTableModel *model = nullptr;  // from contextChanged() on
    TimeStrip *strip = nullptr;
    QLabel *hint = nullptr;
    QLineEdit *search = nullptr;  // null: nobody searches
    QVBoxLayout *column = nullptr;
    PanelSettings settings{"signals", "columns", "sort", "descending", "search"};
    bool isApplying = false;

    QStringList wanted() const { return settings.value("signals").toVariant().toStringList(); }

    void showSignals()
    {
        isApplying = true;
        model->setReferences(referencesOf(wanted()));
        isApplying = false;
        showHint();
    }

    /// Why there are no rows.
    void showHint()
    {
        const bool isEmpty = !model || model->rowCount() == 0;
        hint->setText(isEmpty ? tr("No signals yet. Drop some here, or press Insert.")
                              : tr("No signal of this table fits the search."));
        hint->setVisible(sorted->rowCount() == 0);
    }

    void removeSelected()
    {
        QList<int> rows;
        const QModelIndexList selected = table->selectionModel()->selectedRows();
        for (const QModelIndex &index : selected)
            rows << sorted->mapToSource(index).row();
        std::sort(rows.begin(), rows.end(), std::greater<>());
        for (const int row : qAsConst(rows))
            model->removeRows(row, 1);
    }
};

QPlcValueTable::QPlcValueTable(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>())
{
    d->table = new PanelTable(nullptr, PanelTable::Sorting::ByHeader, this);
    d->table->setAccessibleName(tr("Values"));
    d->table->setDragDropMode(QAbstractItemView::DragOnly);  // drops are for the frame of the panel and its zones
    d->sorted = new SignalFilterModel(this);
    d->sorted->setSortRole(ValueTableModel::SortRole);
    d->sorted->setDynamicSortFilter(false);  // rows do not jump while their values change
    d->table->setModel(d->sorted);
    d->strip = new TimeStrip(this);
    d->hint = new QLabel(this);
    d->hint->setAlignment(Qt::AlignCenter);
    d->hint->setWordWrap(true);
    d->hint->setMargin(8);
    d->hint->setEnabled(false);
    d->column = new QVBoxLayout(this);
    d->column->setContentsMargins(0, 0, 0, 0);
    d->column->setSpacing(0);
    for (QWidget *part :
         {static_cast<QWidget *>(d->strip), static_cast<QWidget *>(d->hint), static_cast<QWidget *>(d->table)})
        d->column->addWidget(part);
    setFocusProxy(d->table);
    connect(d->table, &PanelTable::settingsEdited, this, [this] {
        d->table->writeSettings(&d->settings);
        Q_EMIT settingsEdited();
    });
    d->showHint();
    makeActions();
}

QPlcValueTable::~QPlcValueTable() = default;

void QPlcValueTable::makeActions()
{
    addPanelAction(this, tr("Add a signal"), {Qt::Key_Insert}, [this] { openAdding(); });
    addPanelAction(this, tr("Remove the selected signals"), {Qt::Key_Delete}, [this] {
        if (d->model)
            d->removeSelected();
    });
    addPanelAction(this, tr("Reset smallest and largest values"), {int(Qt::CTRL) | int(Qt::Key_R)}, [this] {
        if (d->model)
            d->model->reset();
    });
    addPanelAction(this, tr("Search in the table"), {QKeySequence::Find}, [this] { openSearch(); });
    addPanelAction(this, tr("Copy as text"), {QKeySequence::Copy},
                   [this] { QGuiApplication::clipboard()->setText(d->table->toTabSeparated()); });
}

/// A line above the rows, until Escape.
void QPlcValueTable::openSearch()
{
    makeSearch();
    d->search->setFocus(Qt::ShortcutFocusReason);
    d->search->selectAll();
}

void QPlcValueTable::makeSearch()
{
    if (d->search)
        return;
    d->search = new QLineEdit(this);
    d->search->setPlaceholderText(tr("Search in the table"));
    d->search->setAccessibleName(tr("Search in the table"));
    d->search->setClearButtonEnabled(true);
    d->column->insertWidget(0, d->search);
    d->search->show();  // at once, so that it can have the focus
    connect(d->search, &QLineEdit::textChanged, this, &QPlcValueTable::search);
    addPanelAction(
        d->search, {}, {Qt::Key_Escape}, [this] { closeSearch(); }, "", Qt::WidgetShortcut);
    const auto toRows = [this] {  // from the line into the rows
        d->table->setFocus(Qt::TabFocusReason);
        if (!d->table->currentIndex().isValid())
            d->table->setCurrentIndex(d->sorted->index(0, 0));
    };
    addPanelAction(d->search, {}, {Qt::Key_Down, Qt::Key_Return, Qt::Key_Enter}, toRows, "", Qt::WidgetShortcut);
}

/// And shows all rows.
void QPlcValueTable::closeSearch()
{
    if (!d->search)
        return;
    d->search->clear();
    const bool hadFocus = d->search->hasFocus();
    d->search->hide();
    d->search->deleteLater();
    d->search = nullptr;
    if (hadFocus)
        d->table->setFocus();
}

void QPlcValueTable::search(const QString &text)
{
    d->sorted->setSearch(text);
    d->showHint();
    if (d->settings.set("search", text, QString()))
        Q_EMIT settingsEdited();
}

/// A line above the rows, until Escape.
void QPlcValueTable::openAdding()
{
    if (!d->model)
        return;
    if (auto *open = findChild<SignalEdit *>()) {
        open->setFocus();
        return;
    }
    QWidget *edit = createSettingsEditor();
    d->column->insertWidget(0, edit);
    edit->setFocus();
    addPanelAction(edit, {}, {Qt::Key_Escape}, [this, edit] {
        edit->deleteLater();
        d->table->setFocus();
    });
}

QWidget *QPlcValueTable::createSettingsEditor()
{
    if (!d->model)
        return nullptr;
    auto *edit = new SignalEdit(context(), SignalEdit::AllSignals);
    edit->setPlaceholderText(tr("Name of a signal to add"));
    edit->setMinimumWidth(180);
    connect(edit, &SignalEdit::chosen, this, [this, edit](const QString &reference) {
        if (addSignals({reference}))
            edit->clear();
    });
    return edit;
}

QJsonObject QPlcValueTable::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcValueTable::applySettings(const QJsonObject &settings)
{
    const QStringList before = d->wanted();
    QPlcWidget::applySettings(d->settings.take(settings));
    const QString searched = d->settings.value("search").toString();
    if (searched.isEmpty() && d->search && !d->search->text().isEmpty())
        closeSearch();
    if (!searched.isEmpty()) {
        makeSearch();
        d->search->setText(searched);
    }
    if (!d->model)
        return;
    if (d->wanted() != before)
        d->showSignals();
    d->table->applySettings(d->settings);
}

bool QPlcValueTable::addSignals(const QStringList &references)
{
    const QVector<SignalReference> known = referencesOf(references);
    if (known.isEmpty() || !d->model)
        return false;
    closeSearch();  // what is added is seen
    d->model->add(known);
    return true;
}

QStringList QPlcValueTable::shownSignals() const
{
    QStringList names;
    const QJsonArray chosen = d->settings.value("signals").toArray();
    for (const QJsonValue &name : chosen)
        names << name.toString();
    return names;
}

/// Rows came or went: by hand, unless settings are applied.
void QPlcValueTable::takeSignals()
{
    if (d->isApplying)
        return;
    QJsonArray names;
    const QVector<SignalReference> references = d->model->references();
    for (const SignalReference &reference : references)
        names.append(reference.toString());
    d->showHint();
    if (d->settings.set("signals", names, QJsonArray()))
        Q_EMIT settingsEdited();
}

void QPlcValueTable::contextChanged()
{
    d->model = new ValueTableModel(context(), this);
    d->sorted->setSourceModel(d->model);
    d->table->setContext(context());
    d->table->setColumns(valueColumns);
    d->table->setNameColumn(ValueTableModel::Name);
    d->table->setStretchedColumn(ValueTableModel::Name, 16);
    d->table->setDispensable({ValueTableModel::Rate, ValueTableModel::Age, ValueTableModel::Minimum,
                              ValueTableModel::Maximum, ValueTableModel::QualityColumn, ValueTableModel::Unit});
    d->showSignals();
    d->table->applySettings(d->settings);
    connect(d->model, &QAbstractItemModel::rowsInserted, this, &QPlcValueTable::takeSignals);
    connect(d->model, &QAbstractItemModel::rowsRemoved, this, &QPlcValueTable::takeSignals);
    // After the model has found its signals again.
    connect(
        context(), &QPlcPanelContext::signalsChanged, this,
        [this] {
            d->sorted->searchAgain();
            d->showHint();
        },
        Qt::QueuedConnection);
    d->strip->setContext(context());
    addAction(d->table->createColumnMenu(this)->menuAction());
}

QSize QPlcValueTable::sizeHint() const
{
    return {480, 200};
}
