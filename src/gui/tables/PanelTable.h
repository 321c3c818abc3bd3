// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "TableDelegate.h"

#include <QtCore/QHash>
#include <QtCore/QJsonArray>
#include <QtCore/QSet>
#include <QtWidgets/QTreeView>

class QAction;
class QMenu;

namespace qplc {

class PanelSettings;

/// The table or tree of a panel: rows of one height, columns that do not jump and are chosen in the
/// menu of the header, sorting by a click, and all that kept as settings `columns`, `sort` and
/// `descending`.
class PanelTable : public QTreeView
{
    Q_OBJECT
public:
    struct Column
    {
        const char *key;  // in settings
        int characters;   // width
        bool isShown;     // unless the settings say something else
    };
    /// What order the rows have before anybody chooses one.
    enum class Sorting { None, ByHeader };

    PanelTable(TableDelegate::SignOf signOf, Sorting sorting, QWidget *parent);

    void setContext(QPlcPanelContext *context);
    /// \param columns  one for each column of the model, which is set before
    void setColumns(const QVector<Column> &columns);
    /// This column takes the space that the others leave, and is always there. \param characters at
    /// least so much
    void setStretchedColumn(int column, int characters);
    /// A panel that is too narrow for all chosen columns leaves these out, the first one first. A
    /// column that a person has added stays. The stretched column has what is left.
    void setDispensable(const QVector<int> &columns) { m_dispensable = columns; }
    /// Names that are too long lose their middle: many differ at their ends.
    void setNameColumn(int column);
    /// These columns get wider when a text or the title is wider than all before; for tables of few
    /// rows.
    void setGrowing(const QVector<int> &columns);
    /// Shows and sorts as settings say.
    void applySettings(const PanelSettings &settings);
    /// Writes what is shown and sorted; defaults are left out.
    void writeSettings(PanelSettings *settings) const;
    /// Shows and hides a column each; the stretched one stays.
    QMenu *createColumnMenu(QWidget *parent);
    /// Selected rows, or all when there are none, with the shown columns and their titles,
    /// separated by tabs.
    QString toTabSeparated() const;

protected:
    void resizeEvent(QResizeEvent *event) override;

Q_SIGNALS:
    /// A person has chosen columns or an order.
    void settingsEdited();

private:
    void openColumnMenu(const QPoint &place);
    void showColumn(int column, bool isShown);
    void choose(int column, bool isShown);
    void placeColumns(const QJsonArray &keys);
    void stretch();
    void grow();
    int wantedWidth(int column) const;
    void sortBy(int column);
    QVector<int> shownColumns() const;
    int columnOf(const QString &key) const;

    TableDelegate *m_delegate;
    Sorting m_sorting;
    QVector<Column> m_columns;
    QSet<int> m_chosen;  // columns that are shown if there is room
    QSet<int> m_kept;    // those of them that a person has added: shown in any case
    QVector<int> m_dispensable;
    QHash<int, int> m_widest;  // [px], of all texts so far, of each column that grows
    int m_stretched = -1;
    int m_leastWidth = 0;  // [px], of the stretched column
    bool m_isPlacing = false;
    int m_sortColumn = -1;
    Qt::SortOrder m_order = Qt::AscendingOrder;
};

}  // namespace qplc
