// SPDX-License-Identifier: Apache-2.0
#include "View3DOverlay.h"

#include "QPlcView3D.h"

#include <QtCore/QLineF>
#include <QtCore/QtMath>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double roseRadius = 15.0;  // [px]

/// Azimuth of the line of sight; of what is up in the picture when the camera looks straight down
/// [deg].
float lookAzimuth(const CameraPose &pose)
{
    QVector3D look = (pose.target - pose.eye).normalized();
    if (std::hypot(look.x(), look.y()) < 0.05f)
        look = pose.up;
    return qRadiansToDegrees(std::atan2(look.y(), look.x()));
}

/// Where an azimuth points to on a rose whose top is another azimuth.
QPointF onRose(float azimuth, float top)
{
    const double angle = qDegreesToRadians(double(azimuth - top));
    return {-std::sin(angle), -std::cos(angle)};
}

}  // namespace

double roundLength(double longest)
{
    if (!(longest > 0.0) || !std::isfinite(longest))
        return 0.0;
    const double power = std::pow(10.0, std::floor(std::log10(longest)));
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= longest)
            return factor * power;
    }
    return power;
}

namespace {

/// Whether the arrow of a label is seen end on, so that its name would lie on what is there.
bool pointsAtViewer(const SceneLabel &label, const QPointF &place, const CameraPose &pose, const QSizeF &size)
{
    constexpr double leastArrow = 14.0;  // [px]
    const std::optional<QPointF> begin = label.begin ? projected(pose, *label.begin, size) : std::nullopt;
    return begin && QLineF(*begin, place).length() < leastArrow;
}

/// The nearest place below where it lies on none of the others.
QRectF freeBelow(QRectF box, const std::vector<QRectF> &others)
{
    const auto next = [&] {
        return std::find_if(others.begin(), others.end(), [&](const QRectF &other) { return other.intersects(box); });
    };
    for (auto other = next(); other != others.end(); other = next())
        box.moveTop(other->bottom());
    return box;
}

}  // namespace

std::vector<QRectF> labelBoxes(const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                               const std::function<QSizeF(const QString &)> &sizeOf)
{
    std::vector<QRectF> boxes;
    for (const SceneLabel &label : labels) {
        QRectF box;
        const std::optional<QPointF> place = projected(pose, label.place, size);
        if (place && QRectF(QPointF(), size).adjusted(-20, -10, 20, 10).contains(*place)
            && !pointsAtViewer(label, *place, pose, size)) {
            box.setSize(sizeOf(label.text));
            box.moveCenter(*place);
            box = freeBelow(box, boxes);
        }
        boxes.push_back(box);
    }
    return boxes;
}

void drawLabels(QPainter *painter, const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                const QPlcTheme &theme)
{
    const QFontMetricsF metrics(painter->font());
    const std::vector<QRectF> boxes = labelBoxes(labels, pose, size, [&metrics](const QString &text) {
        return QSizeF(metrics.horizontalAdvance(text) + 4, metrics.height());
    });
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (boxes[i].isNull())
            continue;
        QColor back = theme.surface;
        back.setAlpha(150);
        painter->fillRect(boxes[i], back);
        painter->setPen(labels[i].color);
        painter->drawText(boxes[i], Qt::AlignCenter, labels[i].text);
    }
}

void drawScale(QPainter *painter, const QRectF &area, const CameraPose &pose, const QString &camera,
               const QPlcTheme &theme)
{
    const double perPixel = double(pose.heightAtTarget()) / std::max(1.0, area.height());
    const double length = roundLength(0.22 * area.width() * perPixel);
    const double pixels = length / perPixel;
    const double line = QFontMetricsF(painter->font()).height();
    const QPointF left(area.left(), area.bottom() - 4);
    painter->setPen(QPen(theme.mutedText, 1.2));
    painter->drawLine(left, left + QPointF(pixels, 0));
    painter->drawLine(left + QPointF(0, -3), left + QPointF(0, 3));
    painter->drawLine(left + QPointF(pixels, -3), left + QPointF(pixels, 3));
    painter->drawText(QRectF(left.x(), left.y() - line - 3, area.width(), line),
                      QPlcView3D::tr("%1 m · %2").arg(length).arg(camera));
}

void drawCompass(QPainter *painter, const QPointF &center, const CameraPose &pose, std::optional<float> arrow,
                 const QPlcTheme &theme)
{
    const float top = lookAzimuth(pose);
    painter->setBrush(Qt::NoBrush);
    painter->setPen(QPen(theme.line, 1.2));
    painter->drawEllipse(center, roseRadius, roseRadius);
    const QPointF north = onRose(90, top);
    painter->setPen(QPen(theme.mutedText, 1.4));
    painter->drawLine(center + 0.55 * roseRadius * north, center + roseRadius * north);
    QRectF letter(0, 0, 14, 14);
    letter.moveCenter(center + (roseRadius + 7) * north);
    painter->drawText(letter, Qt::AlignCenter, QPlcView3D::tr("N"));
    if (!arrow)
        return;
    const QPointF along = onRose(*arrow, top);
    const QPointF across(-along.y(), along.x());
    const QPointF tip = center + 0.8 * roseRadius * along;
    painter->setPen(QPen(theme.accent, 1.6));
    painter->drawLine(center - 0.8 * roseRadius * along, tip);
    painter->drawLine(tip, tip - 4 * along + 3 * across);
    painter->drawLine(tip, tip - 4 * along - 3 * across);
}

void drawHint(QPainter *painter, const QRectF &area, const QString &text, const QPlcTheme &theme)
{
    painter->setPen(theme.mutedText);
    painter->drawText(area.adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap, text);
}

}  // namespace qplc
