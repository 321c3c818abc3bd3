// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointer>
#include <QtCore/QSet>
#include <QtWidgets/QTreeView>

namespace qplc {

class PanelSettings;

/// Remembers what is unfolded in a tree by the names on the way to it
/// ("kite/Model/bodyPosition_earth"), so that it is so again when rows come back, and in another
/// session. The two upper levels are unfolded unless somebody folds them. Settings `collapsed` and
/// `expanded`.
class ExpansionMemory : public QObject
{
    Q_OBJECT
public:
    /// \param view  has its model already
    explicit ExpansionMemory(QTreeView *view);

    /// While it is suspended the upper levels are unfolded, and nothing is remembered.
    void setSuspended(bool isSuspended);
    void applySettings(const PanelSettings &settings);
    void writeSettings(PanelSettings *settings) const;

Q_SIGNALS:
    /// A person has folded or unfolded something.
    void edited();

private:
    void take(const QModelIndex &index, bool isExpanded);
    void restore(const QModelIndex &parent, int first, int last);
    void restoreAll();
    static QString pathOf(const QModelIndex &index);
    static bool isExpandedByDefault(const QModelIndex &index) { return !index.parent().parent().isValid(); }

    QTreeView *m_view;
    QSet<QString> m_collapsed;  // of the upper levels
    QSet<QString> m_expanded;   // of the others
    bool m_isSuspended = false;
    bool m_isRestoring = false;
};

}  // namespace qplc
