// SPDX-License-Identifier: Apache-2.0
#include "TableDelegate.h"

#include "QPlcPanelContext.h"
#include "gui/panel/FigureFont.h"

#include <QtGui/QPainter>
#include <QtWidgets/QApplication>

namespace qplc {

namespace {

constexpr int signWidth = 16;  // [px]

void paintSign(QPainter *painter, const QRectF &place, TableDelegate::Sign sign, const QPlcTheme &theme)
{
    const QPointF center = place.center();
    const double r = 4.5;
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    switch (sign) {
    case TableDelegate::NoSign:
        break;
    case TableDelegate::Good:
        painter->setBrush(theme.good);
        painter->drawEllipse(center, r, r);
        break;
    case TableDelegate::Warning:
        painter->setBrush(theme.warning);
        painter->drawPolygon(QPolygonF(QVector<QPointF>{center + QPointF(0.0, -r - 0.5), center + QPointF(r + 1.0, r),
                                                        center + QPointF(-r - 1.0, r)}));
        break;
    case TableDelegate::Alarm:
        painter->setBrush(theme.alarm);
        painter->drawRect(QRectF(center.x() - r, center.y() - r, 2 * r, 2 * r));
        break;
    case TableDelegate::Unknown:
        painter->setBrush(Qt::NoBrush);
        painter->setPen(QPen(theme.stale, 1.6));
        painter->drawEllipse(center, r - 0.5, r - 0.5);
        break;
    case TableDelegate::Note:
        painter->setBrush(theme.line);
        painter->drawEllipse(center, r - 1.5, r - 1.5);
        break;
    }
}

}  // namespace

TableDelegate::TableDelegate(SignOf signOf, QObject *parent)
    : QStyledItemDelegate(parent)
    , m_signOf(signOf)
{
}

void TableDelegate::initStyleOption(QStyleOptionViewItem *option, const QModelIndex &index) const
{
    QStyledItemDelegate::initStyleOption(option, index);
    if (option->displayAlignment & Qt::AlignRight)
        option->font = figureFont(option->font);
    option->textElideMode = index.column() == m_nameColumn ? Qt::ElideMiddle : Qt::ElideRight;
}

void TableDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const Sign sign = m_signOf ? m_signOf(index) : NoSign;
    if (sign == NoSign) {
        QStyledItemDelegate::paint(painter, option, index);
        return;
    }
    QStyleOptionViewItem whole = option;
    initStyleOption(&whole, index);
    const QString text = whole.text;
    whole.text.clear();
    const QStyle *style = option.widget ? option.widget->style() : QApplication::style();
    style->drawControl(QStyle::CE_ItemViewItem, &whole, painter, option.widget);
    painter->save();
    const QRect place = option.rect.adjusted(4, 0, 0, 0);
    paintSign(painter, QRectF(place.left(), place.top(), signWidth - 4, place.height()), sign,
              m_context ? m_context->theme() : QPlcTheme());
    const bool isSelected = option.state & QStyle::State_Selected;
    painter->setPen(whole.palette.color(isSelected ? QPalette::HighlightedText : QPalette::Text));
    const QRect room = place.adjusted(signWidth, 0, -4, 0);
    painter->drawText(room, Qt::AlignVCenter | Qt::AlignLeft,
                      whole.fontMetrics.elidedText(text, Qt::ElideRight, room.width()));
    painter->restore();
}

QSize TableDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const QSize hint = QStyledItemDelegate::sizeHint(option, index);
    return {hint.width() + (m_signOf && m_signOf(index) != NoSign ? signWidth : 0), hint.height() + 4};
}

}  // namespace qplc
