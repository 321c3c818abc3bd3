// SPDX-License-Identifier: Apache-2.0
#include "ExpansionMemory.h"

#include "gui/panel/PanelSettings.h"

#include <QtCore/QJsonArray>

#include <algorithm>

namespace qplc {

namespace {

QSet<QString> setOf(const QJsonValue &list)
{
    QSet<QString> set;
    const QJsonArray texts = list.toArray();
    for (const QJsonValue &text : texts)
        set.insert(text.toString());
    return set;
}

QJsonArray sortedList(const QSet<QString> &set)
{
    QStringList texts(set.begin(), set.end());
    std::sort(texts.begin(), texts.end());
    return QJsonArray::fromStringList(texts);
}

}  // namespace

ExpansionMemory::ExpansionMemory(QTreeView *view)
    : QObject(view)
    , m_view(view)
{
    connect(view, &QTreeView::expanded, this, [this](const QModelIndex &index) { take(index, true); });
    connect(view, &QTreeView::collapsed, this, [this](const QModelIndex &index) { take(index, false); });
    // Queued: the view has to know the rows first, and a row may have moved on until then.
    connect(view->model(), &QAbstractItemModel::rowsInserted, this, &ExpansionMemory::restoreAll, Qt::QueuedConnection);
    connect(view->model(), &QAbstractItemModel::modelReset, this, &ExpansionMemory::restoreAll, Qt::QueuedConnection);
    restoreAll();
}

QString ExpansionMemory::pathOf(const QModelIndex &index)
{
    QStringList names;
    for (QModelIndex each = index; each.isValid(); each = each.parent())
        names.prepend(each.siblingAtColumn(0).data().toString());
    return names.join(QLatin1Char('/'));
}

void ExpansionMemory::take(const QModelIndex &index, bool isExpanded)
{
    if (m_isSuspended || m_isRestoring)
        return;
    const bool isUpper = isExpandedByDefault(index);
    QSet<QString> &exceptions = isUpper ? m_collapsed : m_expanded;
    if (isExpanded != isUpper)
        exceptions.insert(pathOf(index));
    else
        exceptions.remove(pathOf(index));
    Q_EMIT edited();
}

void ExpansionMemory::restore(const QModelIndex &parent, int first, int last)
{
    for (int row = first; row <= last; ++row) {
        const QModelIndex index = m_view->model()->index(row, 0, parent);
        const int children = m_view->model()->rowCount(index);
        if (children == 0)
            continue;
        const QString path = pathOf(index);
        const bool isUpper = isExpandedByDefault(index);
        m_view->setExpanded(index, isUpper ? m_isSuspended || !m_collapsed.contains(path) : m_expanded.contains(path));
        restore(index, 0, children - 1);
    }
}

void ExpansionMemory::restoreAll()
{
    m_isRestoring = true;
    restore({}, 0, m_view->model()->rowCount() - 1);
    m_isRestoring = false;
}

void ExpansionMemory::setSuspended(bool isSuspended)
{
    m_isSuspended = isSuspended;
    restoreAll();
}

void ExpansionMemory::applySettings(const PanelSettings &settings)
{
    m_collapsed = setOf(settings.value("collapsed"));
    m_expanded = setOf(settings.value("expanded"));
    restoreAll();
}

void ExpansionMemory::writeSettings(PanelSettings *settings) const
{
    settings->set("collapsed", sortedList(m_collapsed), QJsonArray());
    settings->set("expanded", sortedList(m_expanded), QJsonArray());
}

}  // namespace qplc
