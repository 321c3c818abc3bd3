// SPDX-License-Identifier: Apache-2.0
#include "PanelTable.h"

#include "QPlcPanelContext.h"
#include "gui/panel/FigureFont.h"
#include "gui/panel/PanelSettings.h"

#include <QtWidgets/QHeaderView>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <functional>

namespace qplc {

PanelTable::PanelTable(TableDelegate::SignOf signOf, Sorting sorting, QWidget *parent)
    : QTreeView(parent)
    , m_delegate(new TableDelegate(signOf, this))
    , m_sorting(sorting)
{
    setItemDelegate(m_delegate);
    setUniformRowHeights(true);
    setRootIsDecorated(false);
    setAllColumnsShowFocus(true);
    setSelectionMode(QAbstractItemView::ExtendedSelection);
    setEditTriggers(QAbstractItemView::NoEditTriggers);
    setFrameShape(QFrame::NoFrame);
    setAlternatingRowColors(true);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    header()->setStretchLastSection(false);
    header()->setContextMenuPolicy(Qt::CustomContextMenu);
    header()->setHighlightSections(false);
    connect(header(), &QWidget::customContextMenuRequested, this, &PanelTable::openColumnMenu);
    connect(header(), &QHeaderView::sectionMoved, this, [this] {
        if (!m_isPlacing)
            Q_EMIT settingsEdited();
    });
    header()->setSectionsClickable(sorting == Sorting::ByHeader);
    if (sorting == Sorting::ByHeader)
        connect(header(), &QHeaderView::sectionClicked, this, &PanelTable::sortBy);
}

void PanelTable::setContext(QPlcPanelContext *context)
{
    m_delegate->setContext(context);
    connect(context, &QPlcPanelContext::themeChanged, viewport(), QOverload<>::of(&QWidget::update));
}

void PanelTable::setColumns(const QVector<Column> &columns)
{
    m_columns = columns;
    const QFontMetrics metrics(figureFont(font()));
    for (int column = 0; column < columns.size(); ++column) {
        setColumnWidth(column, metrics.horizontalAdvance(QLatin1Char('0')) * columns.at(column).characters + 12);
        choose(column, columns.at(column).isShown);
    }
}

// ---- settings ----

int PanelTable::columnOf(const QString &key) const
{
    const auto found = std::find_if(m_columns.begin(), m_columns.end(),
                                    [&](const Column &column) { return key == QLatin1String(column.key); });
    return found == m_columns.end() ? -1 : int(found - m_columns.begin());
}

QVector<int> PanelTable::shownColumns() const
{
    QVector<int> shown;
    for (int visual = 0; visual < m_columns.size(); ++visual) {
        const int column = header()->logicalIndex(visual);
        if (m_chosen.contains(column))
            shown << column;
    }
    return shown;
}

void PanelTable::applySettings(const PanelSettings &settings)
{
    const QJsonValue wanted = settings.value("columns");
    for (int column = 0; column < m_columns.size(); ++column) {
        const bool isShown = wanted.isArray() ? wanted.toArray().contains(QLatin1String(m_columns.at(column).key))
                                              : m_columns.at(column).isShown;
        choose(column, isShown || column == m_stretched);
    }
    placeColumns(wanted.toArray());
    grow();
    stretch();
    m_sortColumn = m_sorting == Sorting::ByHeader ? columnOf(settings.value("sort").toString()) : -1;
    m_order = settings.value("descending").toBool() ? Qt::DescendingOrder : Qt::AscendingOrder;
    header()->setSortIndicatorShown(m_sortColumn >= 0);
    header()->setSortIndicator(m_sortColumn, m_order);
    if (m_sorting == Sorting::ByHeader)
        model()->sort(m_sortColumn, m_order);
}

void PanelTable::choose(int column, bool isShown)
{
    if (isShown)
        m_chosen.insert(column);
    else
        m_chosen.remove(column);
    if (isShown && !m_columns.at(column).isShown)
        m_kept.insert(column);
    else
        m_kept.remove(column);
    setColumnHidden(column, !isShown);
}

/// The named ones first, in this order.
void PanelTable::placeColumns(const QJsonArray &keys)
{
    m_isPlacing = true;
    for (int column = 0; column < m_columns.size(); ++column)
        header()->moveSection(header()->visualIndex(column), column);
    int place = 0;
    for (const QJsonValue &key : keys) {
        const int column = columnOf(key.toString());
        if (column >= 0)
            header()->moveSection(header()->visualIndex(column), place++);
    }
    m_isPlacing = false;
}

void PanelTable::setStretchedColumn(int column, int characters)
{
    m_stretched = column;
    m_leastWidth = QFontMetrics(font()).averageCharWidth() * characters;
    stretch();
}

void PanelTable::setNameColumn(int column)
{
    m_delegate->setNameColumn(column);
}

void PanelTable::setGrowing(const QVector<int> &columns)
{
    for (const int column : columns)
        m_widest.insert(column, 0);
    // Not in the middle of a change of the model.
    const auto growLater = [this] { QMetaObject::invokeMethod(this, &PanelTable::grow, Qt::QueuedConnection); };
    connect(model(), &QAbstractItemModel::rowsInserted, this, growLater);
    connect(model(), &QAbstractItemModel::dataChanged, this, growLater);
    connect(model(), &QAbstractItemModel::modelReset, this, growLater);
    grow();
}

/// Of texts and title; endless ones are cut.
int PanelTable::wantedWidth(int column) const
{
    constexpr int mostCharacters = 36;
    const QString title = model()->headerData(column, Qt::Horizontal).toString();
    // The hint of a header keeps space for an arrow in each column.
    const int titleWidth = header()->fontMetrics().horizontalAdvance(title) + 8;
    const int wanted = std::max(sizeHintForColumn(column), titleWidth);
    return std::min(wanted, QFontMetrics(font()).averageCharWidth() * mostCharacters);
}

/// What a person has made narrow stays so, until there is something wider.
void PanelTable::grow()
{
    for (auto widest = m_widest.begin(); widest != m_widest.end(); ++widest) {
        const int column = widest.key();
        const int wanted = m_chosen.contains(column) ? wantedWidth(column) : 0;
        if (wanted <= *widest)
            continue;
        *widest = wanted;
        if (column == m_stretched)
            m_leastWidth = std::max(m_leastWidth, wanted);
        else if (wanted > columnWidth(column))
            setColumnWidth(column, wanted);
    }
    stretch();
}

void PanelTable::stretch()
{
    if (m_stretched < 0)
        return;
    for (const int column : qAsConst(m_dispensable))
        setColumnHidden(column, !m_chosen.contains(column));
    int others = 0;
    for (int column = 0; column < m_columns.size(); ++column)
        others += column == m_stretched ? 0 : columnWidth(column);  // 0 when hidden
    for (const int column : qAsConst(m_dispensable)) {
        if (others + m_leastWidth <= viewport()->width())
            break;
        if (m_kept.contains(column))
            continue;
        others -= columnWidth(column);
        setColumnHidden(column, true);
    }
    const int least = m_dispensable.isEmpty() ? m_leastWidth : header()->minimumSectionSize();
    setColumnWidth(m_stretched, std::max(least, viewport()->width() - others));
}

void PanelTable::resizeEvent(QResizeEvent *event)
{
    QTreeView::resizeEvent(event);
    stretch();
}

void PanelTable::writeSettings(PanelSettings *settings) const
{
    QJsonArray shown;
    for (const int column : shownColumns())
        shown.append(QLatin1String(m_columns.at(column).key));
    QJsonArray byDefault;
    for (const Column &column : m_columns) {
        if (column.isShown)
            byDefault.append(QLatin1String(column.key));
    }
    settings->set("columns", shown, byDefault);
    settings->set("sort", m_sortColumn < 0 ? QString() : QString::fromLatin1(m_columns.at(m_sortColumn).key),
                  QString());
    settings->set("descending", m_sortColumn >= 0 && m_order == Qt::DescendingOrder, false);
}

// ---- columns and order ----

void PanelTable::showColumn(int column, bool isShown)
{
    choose(column, isShown);
    if (isShown)
        m_kept.insert(column);
    grow();
    stretch();
    Q_EMIT settingsEdited();
}

/// Up, down, and back to the order of the model.
void PanelTable::sortBy(int column)
{
    if (column != m_sortColumn) {
        m_sortColumn = column;
        m_order = Qt::AscendingOrder;
    } else if (m_order == Qt::AscendingOrder) {
        m_order = Qt::DescendingOrder;
    } else {
        m_sortColumn = -1;
        m_order = Qt::AscendingOrder;
    }
    header()->setSortIndicatorShown(m_sortColumn >= 0);
    header()->setSortIndicator(m_sortColumn, m_order);
    model()->sort(m_sortColumn, m_order);
    Q_EMIT settingsEdited();
}

QMenu *PanelTable::createColumnMenu(QWidget *parent)
{
    auto *menu = new QMenu(tr("Columns"), parent);
    for (int column = 0; column < m_columns.size(); ++column) {
        if (column == m_stretched)
            continue;
        QAction *action = menu->addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setCheckable(true);
        connect(menu, &QMenu::aboutToShow, action,
                [this, action, column] { action->setChecked(!isColumnHidden(column)); });
        action->setChecked(!isColumnHidden(column));
        connect(action, &QAction::triggered, this, [this, column] { showColumn(column, isColumnHidden(column)); });
    }
    return menu;
}

void PanelTable::openColumnMenu(const QPoint &place)
{
    QMenu *menu = createColumnMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(header()->viewport()->mapToGlobal(place));
}

QString PanelTable::toTabSeparated() const
{
    const QVector<int> columns = shownColumns();
    const auto line = [&](const std::function<QString(int)> &cell) {
        QStringList cells;
        for (const int column : columns)
            cells << cell(column)
                         .replace(QLatin1Char('\t'), QLatin1Char(' '))
                         .replace(QLatin1Char('\n'), QLatin1Char(' '));
        return cells.join(QLatin1Char('\t'));
    };
    QStringList lines{line([this](int column) { return model()->headerData(column, Qt::Horizontal).toString(); })};
    const bool isPart = selectionModel() && selectionModel()->hasSelection();
    for (int row = 0; row < model()->rowCount(); ++row) {
        if (isPart && !selectionModel()->isRowSelected(row, QModelIndex()))
            continue;
        lines << line([this, row](int column) { return model()->index(row, column).data().toString(); });
    }
    return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace qplc
