// SPDX-License-Identifier: Apache-2.0
#include "PanelTitleBar.h"

#include "InlineEdit.h"
#include "TitleButton.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QStyleOption>
#include <QtWidgets/QToolTip>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr int badgeMargin = 6;  // [px]
constexpr int pinWidth = 10;
constexpr int leastBadge = 70;

}  // namespace

PanelTitleBar::PanelTitleBar(QWidget *parent)
    : QWidget(parent)
    , m_buttons(new QHBoxLayout)
{
    auto *line = new QHBoxLayout(this);
    line->setContentsMargins(6, 1, 2, 2);
    line->addStretch();
    line->addLayout(m_buttons);
    m_buttons->setSpacing(0);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void PanelTitleBar::setTitle(const QString &title)
{
    m_title = title;
    setAccessibleName(tr("Title of %1").arg(title));
    setToolTip(title);
    update();
}

void PanelTitleBar::setBadge(const Badge &badge)
{
    if (badge == m_badge)
        return;
    m_badge = badge;
    setAccessibleDescription(badge.toolTip);
    update();
}

QToolButton *PanelTitleBar::addButton(QAction *action, Presence presence)
{
    auto *button = new TitleButton(this);
    button->setDefaultAction(action);
    button->setFocusPolicy(Qt::TabFocus);
    m_buttons->addWidget(button);
    if (presence == WhereThereIsRoom)
        m_optional.append(button);
    return button;
}

void PanelTitleBar::fitButtons()
{
    const bool isThereRoom = width() >= 10 * TitleButton::sizeIn(this);
    for (int i = 0; i < m_buttons->count(); ++i) {
        auto *button = qobject_cast<QToolButton *>(m_buttons->itemAt(i)->widget());
        button->setVisible(m_areButtonsShown && (isThereRoom || !m_optional.contains(button)));
    }
}

void PanelTitleBar::setButtonsShown(bool areShown)
{
    m_areButtonsShown = areShown;
    fitButtons();
    update();
}

void PanelTitleBar::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    fitButtons();
}

void PanelTitleBar::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange)
        return;
    fitButtons();
    updateGeometry();
}

void PanelTitleBar::setActive(bool isActive)
{
    if (isActive == m_isActive)
        return;
    m_isActive = isActive;
    update();
}

QSize PanelTitleBar::sizeHint() const
{
    return {m_buttons->sizeHint().width() + 120,
            std::max({24, fontMetrics().height() + 6, TitleButton::sizeIn(this) + 4})};
}

QSize PanelTitleBar::minimumSizeHint() const
{
    return {m_buttons->sizeHint().width() + 24, sizeHint().height()};
}

QRect PanelTitleBar::lineRect() const
{
    return rect().adjusted(8, 0, -(m_buttons->sizeHint().width() + 8), -1);
}

/// Of a narrow panel the badge has the larger part: a title can be guessed, a plant cannot.
QRect PanelTitleBar::badgeRect() const
{
    if (m_badge.text.isEmpty())
        return {};
    const QRect line = lineRect();
    const int text = int(std::ceil(QFontMetricsF(font(), this).horizontalAdvance(m_badge.text)));  // or it is elided
    const int wanted = text + 2 * badgeMargin + (m_badge.isPinned ? pinWidth : 0);
    const int width = std::min({wanted, std::max(line.width() * 6 / 10, leastBadge), line.width()});
    const int height = fontMetrics().height() + 2;
    return {line.right() - width, line.center().y() - height / 2, width, height};
}

QRect PanelTitleBar::titleRect() const
{
    QRect line = lineRect();
    if (!m_badge.text.isEmpty())
        line.setRight(badgeRect().left() - badgeMargin);
    return line;
}

void PanelTitleBar::drawBadge(QPainter *painter) const
{
    if (m_badge.text.isEmpty())
        return;
    const QRect place = badgeRect();
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(m_badge.color);
    painter->drawRoundedRect(place, 3, 3);
    painter->setPen(m_badge.textColor);
    QRect inner = place.adjusted(badgeMargin, 0, -badgeMargin, 0);
    if (m_badge.isPinned) {
        const QPointF head(inner.left() + 2.5, place.center().y() - 1.5);
        painter->setBrush(m_badge.textColor);
        painter->drawEllipse(head, 2.5, 2.5);
        painter->drawLine(head, head + QPointF(0, 7));
        inner.setLeft(inner.left() + pinWidth);
    }
    painter->drawText(inner, Qt::AlignCenter | Qt::TextSingleLine,
                      fontMetrics().elidedText(m_badge.text, Qt::ElideRight, inner.width()));
    painter->restore();
}

void PanelTitleBar::startRename()
{
    auto *edit = new InlineEdit(m_title, titleRect().adjusted(-5, 1, 0, -1), this);
    connect(edit, &InlineEdit::accepted, this, &PanelTitleBar::renamed);
}

void PanelTitleBar::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    const QColor window = palette().color(QPalette::Window);
    const bool isDark = window.lightness() < 128;
    painter.fillRect(rect(), isDark ? window.lighter(125) : window.darker(106));
    const QColor line = m_isActive ? palette().color(QPalette::Highlight)
        : isDark                   ? window.lighter(150)
                                   : window.darker(118);
    painter.fillRect(QRect(0, height() - 1, width(), 1), line);
    QColor text = palette().color(QPalette::WindowText);
    if (!m_isActive)
        text.setAlphaF(0.8);
    painter.setPen(text);
    painter.drawText(titleRect(), Qt::AlignVCenter | Qt::AlignLeft | Qt::TextSingleLine,
                     fontMetrics().elidedText(m_title, Qt::ElideRight, titleRect().width()));
    drawBadge(&painter);
    if (!hasFocus())
        return;
    QStyleOptionFocusRect option;
    option.initFrom(this);
    option.rect = rect().adjusted(2, 2, -(m_buttons->sizeHint().width() + 4), -3);
    style()->drawPrimitive(QStyle::PE_FrameFocusRect, &option, &painter, this);
}

bool PanelTitleBar::event(QEvent *event)
{
    const auto *help = event->type() == QEvent::ToolTip ? static_cast<QHelpEvent *>(event) : nullptr;
    if (!help || !badgeRect().contains(help->pos()))
        return QWidget::event(event);
    QToolTip::showText(help->globalPos(), m_badge.toolTip, this, badgeRect());
    return true;
}

void PanelTitleBar::mousePressEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton)
        return QWidget::mousePressEvent(event);
    m_drag = Pressed;
    m_pressed = event->pos();
}

void PanelTitleBar::mouseMoveEvent(QMouseEvent *event)
{
    if (m_drag == Pressed && (event->pos() - m_pressed).manhattanLength() >= QApplication::startDragDistance()) {
        m_drag = Dragging;
        setCursor(Qt::ClosedHandCursor);
        qApp->installEventFilter(this);
    }
    if (m_drag == Dragging)
        Q_EMIT dragMoved(event->globalPos());
}

void PanelTitleBar::mouseReleaseEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton)
        return QWidget::mouseReleaseEvent(event);
    const bool isDragged = m_drag == Dragging;
    endDrag();
    if (isDragged)
        Q_EMIT dragFinished(event->globalPos());
    else if (badgeRect().contains(event->pos()) && badgeRect().contains(m_pressed))
        Q_EMIT badgeClicked();
}

void PanelTitleBar::mouseDoubleClickEvent(QMouseEvent *event)
{
    if (event->button() == Qt::LeftButton)
        Q_EMIT doubleClicked();
}

bool PanelTitleBar::eventFilter(QObject *watched, QEvent *event)
{
    // While a panel is dragged, Escape ends that, wherever the keyboard is.
    const bool isKey = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (!isKey || static_cast<QKeyEvent *>(event)->key() != Qt::Key_Escape)
        return QWidget::eventFilter(watched, event);
    event->accept();
    if (event->type() == QEvent::ShortcutOverride)
        return false;  // others hear that there was a press
    endDrag();
    Q_EMIT dragCancelled();
    return true;
}

void PanelTitleBar::hideEvent(QHideEvent *event)
{
    QWidget::hideEvent(event);
    const bool isDragged = m_drag == Dragging;
    endDrag();
    if (isDragged)
        Q_EMIT dragCancelled();
}

void PanelTitleBar::endDrag()
{
    if (m_drag == Dragging) {
        qApp->removeEventFilter(this);
        unsetCursor();
    }
    m_drag = NotPressed;
}

}  // namespace qplc
