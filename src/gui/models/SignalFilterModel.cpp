// SPDX-License-Identifier: Apache-2.0
#include "SignalFilterModel.h"

#include "SignalTreeModel.h"

#include <algorithm>

namespace qplc {

SignalFilterModel::SignalFilterModel(QObject *parent)
    : QSortFilterProxyModel(parent)
{
    setRecursiveFilteringEnabled(true);
}

void SignalFilterModel::setSearch(const QString &text)
{
    const QStringList words = text.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
    if (words == m_words)
        return;
    m_words = words;
    invalidateFilter();
}

bool SignalFilterModel::filterAcceptsRow(int row, const QModelIndex &parent) const
{
    if (m_words.isEmpty())
        return true;
    // Plants and nodes have no such text: they are there because of what is in them.
    const QString text = sourceModel()->index(row, 0, parent).data(SignalTreeModel::SearchRole).toString();
    return !text.isEmpty() && std::all_of(m_words.begin(), m_words.end(), [&](const QString &word) {
        return text.contains(word, Qt::CaseInsensitive);
    });
}

}  // namespace qplc
