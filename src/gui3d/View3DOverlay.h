// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "OrbitCamera.h"
#include "QPlcTheme.h"
#include "SceneContent.h"

#include <QtGui/QPainter>

#include <functional>
#include <optional>
#include <vector>

namespace qplc {

/// A length in metres with one digit (1, 2 or 5 times a power of ten) that is at most \a longest.
double roundLength(double longest);
/// Where labels are drawn in the picture: none on another one, none of an arrow that points at the
/// viewer. Null: not seen.
/// \param sizeOf  what a text takes [px]
std::vector<QRectF> labelBoxes(const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                               const std::function<QSizeF(const QString &)> &sizeOf);
/// Names of axes and vectors at their places in the picture.
void drawLabels(QPainter *painter, const std::vector<SceneLabel> &labels, const CameraPose &pose, const QSizeF &size,
                const QPlcTheme &theme);
/// A bar with its length at the distance of what the camera looks at, the name of the camera above.
void drawScale(QPainter *painter, const QRectF &area, const CameraPose &pose, const QString &camera,
               const QPlcTheme &theme);
/// A small rose: north and an arrow as seen from above, with what the camera looks at on top.
/// \param arrow  azimuth [deg]; none: no arrow
void drawCompass(QPainter *painter, const QPointF &center, const CameraPose &pose, std::optional<float> arrow,
                 const QPlcTheme &theme);

/// A calm sentence in the middle.
void drawHint(QPainter *painter, const QRectF &area, const QString &text, const QPlcTheme &theme);

}  // namespace qplc
