// SPDX-License-Identifier: Apache-2.0
#include "KeysWindow.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QTreeWidget>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

namespace {

/// Between several keys of one action.
const QString gap = QStringLiteral("   ");

QString keysOf(const QAction *action)
{
    QStringList texts;
    for (const QKeySequence &keys : action->shortcuts())
        texts.append(keys.toString(QKeySequence::NativeText));
    return texts.join(gap);
}

}  // namespace

KeysWindow::KeysWindow(QWidget *parent)
    : QDialog(parent)
    , m_list(new QTreeWidget)
{
    setObjectName(QStringLiteral("KeysWindow"));
    setWindowTitle(tr("Keys"));
    setModal(false);
    m_list->setColumnCount(2);
    m_list->setHeaderHidden(true);
    m_list->setRootIsDecorated(false);
    m_list->setIndentation(14);
    m_list->setSelectionMode(QAbstractItemView::NoSelection);
    m_list->setFrameShape(QFrame::NoFrame);
    m_list->setAccessibleName(tr("Keys"));
    auto *column = new QVBoxLayout(this);
    column->setContentsMargins(8, 8, 8, 8);
    column->addWidget(m_list);
    resize(560, 620);
}

void KeysWindow::showKeys(const QVector<Group> &groups)
{
    m_list->clear();
    for (const Group &group : groups) {
        auto *head = new QTreeWidgetItem(m_list, {group.name});
        QFont bold = font();
        bold.setBold(true);
        head->setFont(0, bold);
        for (const QAction *action : group.actions) {
            if (!action->shortcuts().isEmpty())
                new QTreeWidgetItem(head, {action->text().remove(QLatin1Char('&')), keysOf(action)});
        }
        if (head->childCount() == 0)
            delete head;
    }
    m_list->expandAll();
    m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    show();
    raise();
    activateWindow();
}

QStringList KeysWindow::keys() const
{
    QStringList all;
    for (int group = 0; group < m_list->topLevelItemCount(); ++group) {
        const QTreeWidgetItem *head = m_list->topLevelItem(group);
        for (int row = 0; row < head->childCount(); ++row)
            all += head->child(row)->text(1).split(gap);
    }
    return all;
}

}  // namespace qplc
