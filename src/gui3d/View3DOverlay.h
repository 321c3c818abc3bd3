// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SceneDrawing.h"

#include <QtGui/QPainter>

#include <functional>

namespace qplc {

/// A length in metres with one digit (1, 2 or 5 times a power of ten) that is at most \a longest.
double roundLength(double longest);
/// Where labels are drawn in the picture: none on another one, none of an arrow that points at the viewer. Null: not seen.
/// \param sizeOf  what a text takes [px]
std::vector<QRectF> labelBoxes(const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                               const std::function<QSizeF(const QString &)> &sizeOf);
/// Names of axes and vectors at their places in the picture.
void drawLabels(QPainter *painter, const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                const QPlcTheme &theme);
/// A bar with its length at the distance of what the camera looks at, the name of the camera above.
void drawScale(QPainter *painter, const QRectF &area, const CameraPose &pose, const QString &camera,
               const QPlcTheme &theme);
/// A small rose: north and the wind as seen from above, with what the camera looks at on top.
void drawCompass(QPainter *painter, const QPointF &center, const CameraPose &pose, std::optional<float> downwind,
                 const QPlcTheme &theme);

}  // namespace qplc
