// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QSortFilterProxyModel>
#include <QtCore/QStringList>

namespace qplc {

/// Of a SignalTreeModel or a ValueTableModel what fits a search: all words have to occur, in any
/// order and case, in name, unit, description, node or plant of a signal.
class SignalFilterModel : public QSortFilterProxyModel
{
    Q_OBJECT
public:
    explicit SignalFilterModel(QObject *parent = nullptr);

    QString search() const { return m_words.join(QLatin1Char(' ')); }
    /// Empty: everything.
    void setSearch(const QString &text);
    /// Searches again in texts that may have changed.
    void searchAgain() { invalidateFilter(); }

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;

private:
    QStringList m_words;
};

}  // namespace qplc
