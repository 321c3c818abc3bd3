// SPDX-License-Identifier: Apache-2.0
#include "BarButton.h"

#include <QtGui/QPainter>
#include <QtWidgets/QStyle>

#include <algorithm>

namespace qplc {

namespace {

constexpr double radius = 5.0;

QColor mixed(const QColor &a, const QColor &b, double share)
{
    return QColor::fromRgbF(a.redF() + share * (b.redF() - a.redF()), a.greenF() + share * (b.greenF() - a.greenF()),
                            a.blueF() + share * (b.blueF() - a.blueF()));
}

}  // namespace

void drawFocusRing(QPainter *painter, const QRectF &rect, const Theme &theme)
{
    painter->setPen(QPen(theme.accent, 2.0));
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(rect.adjusted(1.0, 1.0, -1.0, -1.0), radius, radius);
}

BarButton::BarButton(Kind kind, WindowContext *context, QWidget *parent)
    : QAbstractButton(parent)
    , m_kind(kind)
    , m_context(context)
{
    setFocusPolicy(Qt::TabFocus);
    setCursor(Qt::PointingHandCursor);
    setAttribute(Qt::WA_Hover);  // it looks different below the mouse
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
}

void BarButton::setDetail(const QString &detail)
{
    if (detail == m_detail)
        return;
    m_detail = detail;
    updateGeometry();
    update();
}

void BarButton::setTextColor(const QColor &color)
{
    m_textColor = color;
    update();
}

QFont BarButton::textFont() const
{
    QFont result = font();
    if (m_kind == Primary || m_kind == Stop)
        result.setBold(true);
    if (m_kind == Stop)
        result.setPointSizeF(result.pointSizeF() * 1.35);
    return result;
}

QFont BarButton::detailFont() const
{
    QFont result = font();
    result.setPointSizeF(result.pointSizeF() * 0.88);
    return result;
}

QSize BarButton::sizeHint() const
{
    const QFontMetrics text(textFont());
    const QFontMetrics detail(detailFont());
    const int between = m_detail.isEmpty() ? 0 : 8;
    if (m_kind == Stop) {
        const int width = std::max(text.horizontalAdvance(this->text()), detail.horizontalAdvance(m_detail));
        return {std::clamp(width + 40, 120, 220), 44};
    }
    const int width = text.horizontalAdvance(this->text()) + between + detail.horizontalAdvance(m_detail);
    const int target = style()->pixelMetric(QStyle::PM_TitleBarHeight, nullptr, this) - 4;  // larger for fingers
    return {width + (m_kind == Primary ? 32 : 16), m_kind == Primary ? 40 : std::max({24, text.height() + 6, target})};
}

QColor BarButton::background() const
{
    const Theme &theme = m_context->theme();
    const bool isFlat = m_kind == Quiet || m_kind == Outlined || m_kind == Link;
    const QColor base = m_kind == Stop ? QColor(0xc3261f) : m_kind == Primary ? theme.accent : theme.window;
    if (isDown())
        return mixed(base, Qt::black, 0.25);
    if (underMouse() && isEnabled())
        return isFlat ? mixed(base, theme.text, 0.10) : mixed(base, Qt::white, 0.12);
    return isFlat ? QColor(Qt::transparent) : base;
}

QColor BarButton::foreground() const
{
    const Theme &theme = m_context->theme();
    if (m_kind == Stop)
        return Qt::white;
    if (m_kind == Primary)
        return theme.isDark ? theme.window : QColor(Qt::white);
    if (m_kind == Link)
        return theme.accent;
    return m_textColor.isValid() ? m_textColor : theme.text;
}

void BarButton::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(m_kind == Outlined ? QPen(m_context->theme().mutedText, 1.0) : QPen(Qt::NoPen));
    painter.setBrush(background());
    const double inset = m_kind == Outlined ? 0.5 : 0.0;
    painter.drawRoundedRect(QRectF(rect()).adjusted(inset, inset, -inset, -inset), radius, radius);
    const QColor color = isEnabled() ? foreground() : m_context->theme().stale;
    const QFontMetrics textSize(textFont());
    painter.setPen(color);
    painter.setFont(textFont());
    if (m_kind == Stop && !m_detail.isEmpty()) {
        painter.drawText(rect().adjusted(8, 3, -8, -16), Qt::AlignCenter, text());
        painter.setFont(detailFont());
        const QString shown = QFontMetrics(detailFont()).elidedText(m_detail, Qt::ElideMiddle, width() - 16);
        painter.drawText(rect().adjusted(8, 24, -8, -3), Qt::AlignCenter, shown);
    } else if (m_detail.isEmpty()) {
        painter.drawText(rect().adjusted(8, 0, -8, 0), m_alignment,
                         textSize.elidedText(text(), Qt::ElideRight, width() - 12));
    } else {
        const int margin = m_kind == Primary ? 16 : 8;
        // Where both do not fit, the detail has what the text leaves, at least the half.
        const QFontMetrics detailSize(detailFont());
        const int room = width() - 2 * margin - 8;
        const int textWidth = textSize.horizontalAdvance(text());
        const int detailWidth = std::min(detailSize.horizontalAdvance(m_detail), std::max(room / 2, room - textWidth));
        painter.drawText(
            rect().adjusted(margin, 0, -margin, 0), Qt::AlignLeft | Qt::AlignVCenter,
            textWidth + detailWidth > room ? textSize.elidedText(text(), Qt::ElideRight, room - detailWidth) : text());
        painter.setFont(detailFont());
        painter.setPen(m_kind == Primary ? mixed(color, background(), 0.25) : m_context->theme().mutedText);
        painter.drawText(rect().adjusted(margin, 0, -margin, 0), Qt::AlignRight | Qt::AlignVCenter,
                         detailSize.elidedText(m_detail, Qt::ElideRight, detailWidth + 1));
    }
    if (hasFocus())
        drawFocusRing(&painter, rect(), m_context->theme());
}

}  // namespace qplc
