// SPDX-License-Identifier: Apache-2.0
#include "StartButton.h"

#include "BarButton.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAction>

namespace qplc {

StartButton::StartButton(QAction *action, WindowContext *context, QWidget *parent)
    : QAbstractButton(parent)
    , m_action(action)
    , m_context(context)
{
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);  // it looks different below the mouse
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    connect(action, &QAction::changed, this, &StartButton::follow);
    connect(this, &QAbstractButton::clicked, action, &QAction::trigger);
    connect(action, &QObject::destroyed, this, &QObject::deleteLater);
    follow();
}

void StartButton::setRank(Rank rank)
{
    m_rank = rank;
    update();
}

void StartButton::follow()
{
    setText(m_action->text().remove(QLatin1Char('&')));
    setIcon(m_action->icon());
    setEnabled(m_action->isEnabled());
    m_sentence = m_action->toolTip() == m_action->iconText() ? QString() : m_action->toolTip();
    m_keys = m_action->shortcut().toString(QKeySequence::NativeText);
    setAccessibleName(text());
    setAccessibleDescription(m_sentence);
    update();
}

void StartButton::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        click();
    else
        QAbstractButton::keyPressEvent(event);
}

void StartButton::paintEvent(QPaintEvent * /*event*/)
{
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool isLit = isEnabled() && (underMouse() || hasFocus());
    painter.setPen(QPen(isLit ? theme.accent : theme.line, 1.0));
    painter.setBrush(isDown() ? theme.window : theme.surface);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
    painter.setPen(Qt::NoPen);
    if (m_rank == First) {
        painter.setBrush(theme.accent);
        painter.drawRoundedRect(QRectF(0, 0, 5, height()), 2.5, 2.5);
    }
    int left = 22;
    if (!icon().isNull()) {
        icon().paint(&painter, QRect(left, (height() - 32) / 2, 32, 32));
        left += 32 + 16;
    }
    QFont title = font();
    title.setPointSizeF(title.pointSizeF() * 1.25);
    title.setBold(true);
    painter.setFont(title);
    painter.setPen(isEnabled() ? theme.text : theme.stale);
    const bool isAlone = m_sentence.isEmpty();
    const int right = width() - 16;
    painter.drawText(QRect(left, isAlone ? 0 : 10, right - left, isAlone ? height() : 26),
                     Qt::AlignLeft | Qt::AlignVCenter, text());
    painter.setFont(font());
    painter.setPen(theme.mutedText);
    painter.drawText(QRect(left, isAlone ? 0 : 10, right - left, isAlone ? height() : 26),
                     Qt::AlignRight | Qt::AlignVCenter, m_keys);
    painter.drawText(QRect(left, 36, right - left, 22), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(m_sentence, Qt::ElideRight, right - left));
    if (hasFocus())
        drawFocusRing(&painter, rect(), theme);
}

}  // namespace qplc
