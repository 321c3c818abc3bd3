// SPDX-License-Identifier: Apache-2.0
#include "LayoutIcons.h"

#include <QtCore/QtMath>
#include <QtGui/QGuiApplication>
#include <QtGui/QIconEngine>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtGui/QPalette>
#include <QtGui/QPixmap>

namespace qplc {

namespace {

/// A wheel with eight teeth around the middle of a square of 16.
QPainterPath wheel()
{
    QPainterPath path;
    constexpr int Teeth = 8;
    for (int i = 0; i < 4 * Teeth; ++i) {
        const double angle = (i - 0.5) * 2 * M_PI / (4 * Teeth);
        const double radius = i % 4 < 2 ? 6.5 : 4.8;
        const QPointF point(8 + radius * std::cos(angle), 8 + radius * std::sin(angle));
        i == 0 ? path.moveTo(point) : path.lineTo(point);
    }
    path.closeSubpath();
    path.addEllipse(QPointF(8, 8), 2.0, 2.0);
    return path;
}

void drawIcon(QPainter *painter, LayoutIcon icon)
{
    switch (icon) {
    case LayoutIcon::Settings:
        painter->drawPath(wheel());
        return;
    case LayoutIcon::Float:  // a window leaves a window
        painter->drawPolyline(
            QPolygonF(QVector<QPointF>{{6.5, 5.5}, {2.5, 5.5}, {2.5, 13.5}, {10.5, 13.5}, {10.5, 9.5}}));
        painter->drawRect(QRectF(6.5, 2.5, 7, 7));
        return;
    case LayoutIcon::Dock:  // an arrow into a window
        painter->drawRect(QRectF(2.5, 2.5, 11, 11));
        painter->drawLine(QPointF(11, 5), QPointF(6, 10));
        painter->drawPolyline(QPolygonF(QVector<QPointF>{{5.5, 6.5}, {5.5, 10.5}, {9.5, 10.5}}));
        return;
    case LayoutIcon::Maximize:
        painter->drawRect(QRectF(2.5, 2.5, 11, 11));
        return;
    case LayoutIcon::Restore:
        painter->drawRect(QRectF(2.5, 5.5, 8, 8));
        painter->drawPolyline(
            QPolygonF(QVector<QPointF>{{5.5, 5.5}, {5.5, 2.5}, {13.5, 2.5}, {13.5, 10.5}, {10.5, 10.5}}));
        return;
    case LayoutIcon::Close:
        painter->drawLine(QPointF(3.5, 3.5), QPointF(12.5, 12.5));
        painter->drawLine(QPointF(12.5, 3.5), QPointF(3.5, 12.5));
        return;
    case LayoutIcon::Add:
        painter->drawLine(QPointF(8, 2.5), QPointF(8, 13.5));
        painter->drawLine(QPointF(2.5, 8), QPointF(13.5, 8));
        return;
    }
}

class Engine : public QIconEngine
{
public:
    explicit Engine(LayoutIcon icon)
        : m_icon(icon)
    {
    }

    QIconEngine *clone() const override { return new Engine(m_icon); }

    void paint(QPainter *painter, const QRect &rect, QIcon::Mode mode, QIcon::State /*state*/) override
    {
        const QPalette palette = QGuiApplication::palette();
        const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Active;
        QColor line = palette.color(group, QPalette::WindowText);
        if (mode == QIcon::Normal)  // only that under the mouse has the full colour
            line.setAlphaF(0.8);
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        const double scale = qMin(rect.width(), rect.height()) / 16.0;
        painter->translate(QRectF(rect).center() - QPointF(8, 8) * scale);
        painter->scale(scale, scale);
        painter->setPen(QPen(line, 1.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        drawIcon(painter, m_icon);
        painter->restore();
    }

    QPixmap pixmap(const QSize &size, QIcon::Mode mode, QIcon::State state) override
    {
        QPixmap drawn(size);
        drawn.fill(Qt::transparent);
        QPainter painter(&drawn);
        paint(&painter, QRect(QPoint(0, 0), size), mode, state);
        return drawn;
    }

private:
    LayoutIcon m_icon;
};

}  // namespace

QIcon layoutIcon(LayoutIcon icon)
{
    return QIcon(new Engine(icon));
}

}  // namespace qplc
