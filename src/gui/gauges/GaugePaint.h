// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GaugePicture.h"
#include "QPlcTheme.h"

#include <QtGui/QPainter>

namespace qplc {

/// Draws a gauge: its name, unless a title says it, and its status in a line below, and its style
/// above it.
void paintGauge(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme);

// Parts of it, one for each style.
void paintDial(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme);
void paintBar(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme);
void paintNumbers(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme);
void paintLed(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme);

/// Of the pointer: the accent, or what is not normal.
QColor levelColor(AlarmState::Level level, const QPlcTheme &theme);
/// Of the scale below the pointer: quiet in every theme.
QColor trackColor(const QPlcTheme &theme);
QColor pointerColor(const GaugePicture &picture, const QPlcTheme &theme);
QColor textColor(const GaugePicture &picture, const QPlcTheme &theme);
/// \a font in the largest size in which \a text fits into \a size.
QFont fittingFont(const QFont &font, const QString &text, const QSizeF &size, double largest = 200.0);
/// A value with its unit, right-aligned in as much space as the widest one takes: digits stay where
/// they are. \param side Qt::AlignHCenter or Qt::AlignRight, of that space
/// \return the left edge of that space
double paintValue(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QString &text,
                  const QColor &color, Qt::AlignmentFlag side = Qt::AlignHCenter);
/// What is not normal, in one line. \param side  for Qt::AlignLeft, ...
void paintStatus(QPainter *painter, const QRectF &place, const GaugePicture &picture, const QPlcTheme &theme, int side);
/// A bar that lies says what is not normal beside its number, where no name takes a line.
bool isLyingBar(const QRectF &place, const GaugePicture &picture);

}  // namespace qplc
