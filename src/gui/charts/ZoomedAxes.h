// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointF>
#include <QtCore/QRectF>

namespace qplc {

/// Two axes that people zoom: those of a chart. Places are in pixels of its canvas.
class ZoomedAxes
{
public:
    /// About a place that stays where it is. \param xFactor, yFactor < 1: shows less
    virtual void zoom(double xFactor, double yFactor, QPointF about) = 0;
    virtual void pan(QPointF by) = 0;
    virtual void zoomTo(const QRectF &box) = 0;
    /// The axes show all again.
    virtual void release() = 0;

protected:
    ~ZoomedAxes() = default;
};

}  // namespace qplc
