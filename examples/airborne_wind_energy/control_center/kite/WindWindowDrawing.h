// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteOverlay.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

namespace awe {

/// Where the half circle of the wind window lies in a rectangle, and how degrees become pixels. A
/// value type.
class WindWindowFrame
{
public:
    /// \param labelHeight  room for a line of labels below [px]
    WindWindowFrame(const QSizeF &size, double labelHeight);

    /// \param degrees  as from windWindowPoint()
    QPointF toPixels(const QPointF &degrees) const;
    QPointF toPixels(const QVector3D &position, float downwind) const;
    double scale() const { return m_scale; }  // [px/deg]
    QPointF origin() const { return m_origin; }
    /// Degrees between lines of the grid: 30 or 15.
    int gridStep() const { return m_scale < 1.6 ? 30 : 15; }

private:
    double m_scale;
    QPointF m_origin;  // the downwind direction at the horizon
};

/// Draws a wind window: sky, grid, path, kite, and labels.
class WindWindowDrawing
{
public:
    WindWindowDrawing(QPainter *painter, const QSizeF &size, const QPlcTheme &theme);

    void drawSky();
    void drawWind(const KiteState &state);
    void drawTrail(const FlightTrail &trail, const ColorScale &scale, float downwind);
    void drawKite(const KiteState &state);
    void drawCorners(const KiteState &state, const ColorScale &scale, const QString &colorTitle);

private:
    QPainterPath meridian(int azimuth) const;
    QPainterPath parallel(int elevation) const;
    void drawLabels();

    QPainter *m_painter;
    QSizeF m_size;
    QPlcTheme m_theme;
    WindWindowFrame m_frame;
};

/// The whole picture: the kite, or why there is none.
void drawWindWindow(QPainter *painter, const QSizeF &size, const KiteSignals &kite, const QPlcTheme &theme);

/// The outline of a kite seen from below, 2 wide, its nose upwards (y < 0), about (0, 0).
QPainterPath kiteSymbol();

}  // namespace awe
