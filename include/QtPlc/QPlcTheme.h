// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtGui/QColor>
#include <QtGui/QFont>
#include <QtGui/QPalette>

/// Colours and fonts of a window, for what panels draw: QPlcPanelContext::theme().
///
/// ```cpp
/// painter.fillRect(rect(), theme.surface);
/// painter.setPen(QPen(theme.curve(0), theme.curveWidth));
/// ```
/// What is normal is grey. Colour is for curves and for what is not normal, and it is never the only sign.
/// A value type.
struct QTPLC_GUI_EXPORT QPlcTheme
{
    /// Returns the colour of curve \a index, 0 or above. People with any colour vision tell the first
    /// eight apart; then they begin again.
    QColor curve(int index) const;
    /// Returns the line of curve \a index: solid for the first eight, then dashes, then dots, then solid
    /// again, so that 24 curves look different.
    static Qt::PenStyle curveStyle(int index);
    /// Returns the colours of widgets, such as buttons and fields, for QWidget::setPalette().
    QPalette palette() const;

    bool isDark = false;      ///< texts are light on dark
    QColor window;            ///< behind panels
    QColor surface;           ///< background of a panel, plot or table
    QColor text;              ///< texts and values
    QColor mutedText;         ///< units, labels, hints
    QColor line;              ///< grids, frames, separators
    QColor accent;            ///< what people can act upon, focus, selection
    QColor good;              ///< in order, where that has to be said
    QColor warning;           ///< needs attention
    QColor alarm;             ///< needs action
    QColor stale;             ///< values that are no longer true
    QColor held;              ///< signals that a person has taken over
    double curveWidth = 1.5;  ///< width of a curve [px]
    QFont font;               ///< texts
    QFont labelFont;          ///< labels of axes and corners: a little smaller
    QFont figureFont;         ///< values that change: all digits have one width
};
