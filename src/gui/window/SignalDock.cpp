// SPDX-License-Identifier: Apache-2.0
#include "SignalDock.h"

#include "gui/models/SignalFilterModel.h"
#include "gui/models/SignalTreeModel.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTreeView>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

SignalDock::SignalDock(WindowContext *context, QWidget *parent)
    : QDockWidget(tr("Signals"), parent)
    , m_model(new SignalTreeModel(context->plants(), this))
    , m_filter(new SignalFilterModel(this))
    , m_search(new QLineEdit)
    , m_tree(new QTreeView)
{
    setObjectName(QStringLiteral("SignalDock"));
    m_filter->setSourceModel(m_model);
    m_search->setPlaceholderText(tr("Search signals (Ctrl+F)"));
    m_search->setClearButtonEnabled(true);
    m_search->setAccessibleName(tr("Search signals"));
    makeTree();
    auto *content = new QWidget(this);
    auto *column = new QVBoxLayout(content);
    column->setContentsMargins(4, 4, 0, 4);
    column->setSpacing(4);
    column->addWidget(m_search);
    column->addWidget(m_tree, 1);
    setWidget(content);
    makeActions();
    connect(m_search, &QLineEdit::textChanged, this, [this](const QString &text) {
        m_filter->setSearch(text);
        if (!text.isEmpty())
            m_tree->expandAll();
    });
}

void SignalDock::makeTree()
{
    m_tree->setModel(m_filter);
    m_tree->setUniformRowHeights(true);
    m_tree->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_tree->setDragEnabled(true);
    m_tree->setAllColumnsShowFocus(true);
    m_tree->setFrameShape(QFrame::NoFrame);
    m_tree->setAccessibleName(tr("Signals"));
    m_tree->hideColumn(SignalTreeModel::Age);
    m_tree->hideColumn(SignalTreeModel::Description);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(SignalTreeModel::Name, QHeaderView::Stretch);
    m_tree->header()->resizeSection(SignalTreeModel::Value, 84);
    m_tree->header()->resizeSection(SignalTreeModel::Unit, 52);
    // A plant is open when it comes; its nodes are for people to open.
    connect(m_filter, &QAbstractItemModel::rowsInserted, m_tree,
            [this](const QModelIndex &parent, int first, int last) {
                for (int row = first; row <= last && !parent.isValid(); ++row)
                    m_tree->expand(m_filter->index(row, 0));
            });
}

void SignalDock::makeActions()
{
    const auto add = [this](const QString &text, const QKeySequence &keys, const QString &type) {
        auto *action = new QAction(text, this);
        action->setShortcut(keys);
        action->setShortcutContext(Qt::WidgetShortcut);
        connect(action, &QAction::triggered, this, [this, type] {
            const QStringList references = selectedReferences();
            if (!references.isEmpty())
                Q_EMIT panelRequested(type, references);
        });
        m_tree->addAction(action);
        m_signalActions.append(action);
    };
    add(tr("Plot the selected signals"), Qt::Key_Return, QStringLiteral("Time plot"));
    add(tr("Show the selected signals in gauges"), Qt::Key_G, QStringLiteral("Gauge"));
    add(tr("Watch the selected signals"), Qt::Key_W, QStringLiteral("Value table"));
    m_tree->setContextMenuPolicy(Qt::ActionsContextMenu);
    connect(m_search, &QLineEdit::returnPressed, this, [this] { m_tree->setFocus(Qt::ShortcutFocusReason); });
}

QStringList SignalDock::selectedReferences() const
{
    QStringList references;
    const QModelIndexList rows = m_tree->selectionModel()->selectedRows();
    for (const QModelIndex &row : rows) {
        const QString reference = row.data(SignalTreeModel::ReferenceRole).toString();
        if (!reference.isEmpty())
            references.append(reference);
    }
    return references;
}

void SignalDock::startSearch()
{
    show();
    raise();
    m_search->setFocus(Qt::ShortcutFocusReason);
    m_search->selectAll();
}

}  // namespace qplc
