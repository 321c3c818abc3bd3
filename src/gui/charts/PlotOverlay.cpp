// SPDX-License-Identifier: Apache-2.0
#include "PlotOverlay.h"

#include "ChartLook.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>

#include <algorithm>

namespace qplc {

namespace {

constexpr double shadeOpacity = 0.07;  // of the accent, between the cursors
constexpr double boxOpacity = 0.15;
constexpr int dotRadius = 3;    // [px]
constexpr int labelMargin = 4;  // [px]
constexpr int hintMargin = 12;  // [px]
constexpr int arrowSize = 6;    // [px] of the marks of a trigger

QColor faint(QColor color, double opacity)
{
    color.setAlphaF(opacity);
    return color;
}

bool isSame(const PlotOverlay::Picture &a, const PlotOverlay::Picture &b)
{
    return a.cursorA == b.cursorA && a.cursorB == b.cursorB && a.pointer == b.pointer && a.pointerText == b.pointerText
        && a.playhead == b.playhead && a.dots == b.dots && a.box == b.box && a.hint == b.hint && a.event == b.event
        && a.levels == b.levels && a.notes == b.notes;
}

}  // namespace

PlotOverlay::PlotOverlay(QWidget *canvas)
    : QWidget(canvas)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
    canvas->installEventFilter(this);
    setFont(smallFont(font()));
    resize(canvas->size());
}

void PlotOverlay::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    update();
}

void PlotOverlay::show(const Picture &picture)
{
    if (isSame(picture, m_picture))
        return;
    m_picture = picture;
    update();
}

bool PlotOverlay::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize)
        resize(parentWidget()->size());
    return QWidget::eventFilter(watched, event);
}

void PlotOverlay::paintEvent(QPaintEvent * /*event*/)
{
    QPainter painter(this);
    paint(&painter);
}

void PlotOverlay::paint(QPainter *painter) const
{
    painter->setFont(font());
    paintBetween(painter);
    paintNotes(painter);
    paintTrigger(painter);
    paintPlayhead(painter);
    paintPointer(painter);
    paintDots(painter);
    if (m_picture.cursorA)
        paintCursor(painter, *m_picture.cursorA, QStringLiteral("A"));
    if (m_picture.cursorB)
        paintCursor(painter, *m_picture.cursorB, QStringLiteral("B"));
    if (!m_picture.box.isNull()) {
        painter->setPen(m_theme.accent);
        painter->setBrush(faint(m_theme.accent, boxOpacity));
        painter->drawRect(m_picture.box);
    }
    if (!m_picture.hint.isEmpty()) {
        const int margin = std::min(hintMargin, width() / 10);
        painter->setPen(m_theme.mutedText);
        painter->drawText(rect().adjusted(margin, 0, -margin, 0), Qt::AlignCenter | Qt::TextWordWrap, m_picture.hint);
    }
}

void PlotOverlay::paintBetween(QPainter *painter) const
{
    if (!m_picture.cursorA || !m_picture.cursorB)
        return;
    const auto [left, right] = std::minmax({*m_picture.cursorA, *m_picture.cursorB});
    painter->fillRect(QRect(left, 0, right - left, height()), faint(m_theme.accent, shadeOpacity));
}

/// A line at the event with an arrow at its top, and one at each level with an arrow at the left
/// edge, which stays at the nearer end when the level is not seen.
void PlotOverlay::paintTrigger(QPainter *painter) const
{
    const auto paintArrow = [painter](QPoint tip, QPoint along, QPoint across, const QColor &color) {
        painter->setPen(Qt::NoPen);
        painter->setBrush(color);
        painter->drawPolygon(QPolygon({tip, tip - along + across, tip - along - across}));
    };
    for (const Dot &level : m_picture.levels) {
        const int y = int(std::clamp(level.position.y(), 0.0, height() - 1.0));
        painter->setPen(QPen(level.color, 0.0, Qt::DashLine));
        if (level.position.y() >= 0.0 && level.position.y() < height())
            painter->drawLine(0, y, width(), y);
        paintArrow({arrowSize, y}, {arrowSize, 0}, {0, arrowSize - 2}, level.color);
    }
    if (!m_picture.event)
        return;
    painter->setPen(QPen(m_theme.text, 0.0, Qt::DashLine));
    painter->drawLine(*m_picture.event, 0, *m_picture.event, height());
    paintArrow({*m_picture.event, arrowSize}, {0, arrowSize}, {arrowSize - 2, 0}, m_theme.text);
}

/// A line and the text beside it, as far as there is room before the next one. Below the flags of
/// the cursors.
void PlotOverlay::paintNotes(QPainter *painter) const
{
    const int top = flagHeight() + 2;
    for (int i = 0; i < m_picture.notes.size(); ++i) {
        const Note &note = m_picture.notes[i];
        const int behind = i + 1 < m_picture.notes.size() ? m_picture.notes[i + 1].place : width();
        painter->setPen(QPen(m_theme.warning, 0.0, Qt::DashLine));
        painter->drawLine(note.place, 0, note.place, height());
        const int room = behind - note.place - 3 * labelMargin;
        const QString text = fontMetrics().elidedText(note.text, Qt::ElideRight, room);
        if (room < fontMetrics().horizontalAdvance(QStringLiteral("mmm")))
            continue;
        const QRect label(note.place + 2, top, fontMetrics().horizontalAdvance(text) + labelMargin, flagHeight());
        painter->fillRect(label, faint(m_theme.surface, 0.85));
        painter->setPen(m_theme.text);
        painter->drawText(label, Qt::AlignCenter, text);
    }
}

/// A line with a triangle at its foot.
void PlotOverlay::paintPlayhead(QPainter *painter) const
{
    if (!m_picture.playhead)
        return;
    const int x = *m_picture.playhead;
    painter->setPen(QPen(m_theme.accent, 0.0));
    painter->drawLine(x, 0, x, height());
    painter->setPen(Qt::NoPen);
    painter->setBrush(m_theme.accent);
    painter->drawPolygon(
        QPolygon({{x, height() - arrowSize}, {x - arrowSize + 1, height()}, {x + arrowSize - 1, height()}}));
}

void PlotOverlay::paintDots(QPainter *painter) const
{
    painter->setRenderHint(QPainter::Antialiasing);
    for (const Dot &dot : m_picture.dots) {
        painter->setPen(QPen(m_theme.surface, 1.0));
        painter->setBrush(dot.color);
        painter->drawEllipse(dot.position, dotRadius, dotRadius);
    }
    painter->setRenderHint(QPainter::Antialiasing, false);
}

void PlotOverlay::paintPointer(QPainter *painter) const
{
    if (!m_picture.pointer)
        return;
    const int x = *m_picture.pointer;
    painter->setPen(QPen(m_theme.mutedText, 0.0, Qt::DotLine));
    painter->drawLine(x, 0, x, height());
    if (m_picture.pointerText.isEmpty())
        return;
    const QSize size = fontMetrics().size(Qt::TextSingleLine, m_picture.pointerText) + QSize(2 * labelMargin, 2);
    const bool isLeft = x + size.width() + labelMargin > width();
    const QRect label(QPoint(isLeft ? x - size.width() - labelMargin : x + labelMargin, height() - size.height() - 1),
                      size);
    painter->fillRect(label, faint(m_theme.surface, 0.85));
    painter->setPen(m_theme.mutedText);
    painter->drawText(label, Qt::AlignCenter, m_picture.pointerText);
}

void PlotOverlay::paintCursor(QPainter *painter, int x, const QString &name) const
{
    painter->setPen(QPen(m_theme.accent, 0.0));
    painter->drawLine(x, 0, x, height());
    QRect flag(0, 0, fontMetrics().horizontalAdvance(name) + 2 * labelMargin, flagHeight());
    const bool isFirst = name == QLatin1String("A");  // flags lie outside of what is between them
    flag.moveTopLeft({isFirst ? x - flag.width() + 1 : x, 0});
    flag.moveLeft(std::clamp(flag.left(), std::min(0, x), std::max(width() - flag.width(), x - flag.width())));
    painter->fillRect(flag, m_theme.accent);
    painter->setPen(m_theme.surface);
    painter->drawText(flag, Qt::AlignCenter, name);
}

}  // namespace qplc
