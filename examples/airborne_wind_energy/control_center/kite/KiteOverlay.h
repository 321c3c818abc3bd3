// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "KiteSignals.h"

#include <QtGui/QPainter>

namespace awe {

// What stands beside the picture of a kite: small, in the corners.

/// A bar of colours with its ends below and what it shows above. \param topLeft where it begins
/// [px]
void drawColorBar(QPainter *painter, const QPointF &topLeft, const ColorScale &scale, const QString &title,
                  const QPlcTheme &theme);
/// Lines at the right edge, below each other: azimuth, elevation, distance.
void drawReadout(QPainter *painter, const QRectF &area, const KiteState &state, const QPlcTheme &theme);
/// "stale, 3 s", "at 12:03:04.5"; empty for what is true now.
QString stateText(const KiteState &state);
/// A calm sentence in the middle.
void drawHint(QPainter *painter, const QRectF &area, const QString &text, const QPlcTheme &theme);
QColor mixedColor(const QColor &a, const QColor &b, double share);

}  // namespace awe
