// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"

#include <QtGui/QColor>
#include <QtGui/QFont>
#include <QtGui/QPalette>

/// Colours and fonts of a window, for what panels draw: QPlcPanelContext::theme().
///
/// \code
/// class Swatch : public QPlcWidget
/// {
/// protected:
///     void paintEvent(QPaintEvent *) override
///     {
///         const QPlcTheme theme = context()->theme();
///         QPainter painter(this);
///         painter.fillRect(rect(), theme.surface);
///         painter.setPen(QPen(theme.curve(0), theme.curveWidth));
///         painter.drawLine(0, height(), width(), 0);
///     }
/// };
/// \endcode
///
/// Normal values are grey. Colour is for curves and for what is not normal, and it is never the
/// only sign.
///
/// \threadsafe a value type: use it in the thread of the window
///
/// \ingroup panels
struct QTPLC_GUI_EXPORT QPlcTheme
{
    /// Returns the colour of a curve. People with any colour vision can tell the first eight apart;
    /// then the colours repeat.
    /// \param index  number of the curve, 0 or more
    QColor curve(int index) const;
    /// Returns the line style of a curve: solid for the first eight, then dashes, then dots, then
    /// solid again, so that 24 curves look different.
    /// \param index  number of the curve, 0 or more
    static Qt::PenStyle curveStyle(int index);
    /// Returns the colours of widgets such as buttons and fields, for QWidget::setPalette().
    QPalette palette() const;

    bool isDark = false;      ///< texts are light on a dark background
    QColor window;            ///< background behind panels
    QColor surface;           ///< background of a panel, plot or table
    QColor text;              ///< texts and values on window or surface
    QColor mutedText;         ///< units, labels, hints
    QColor line;              ///< grids, frames, separators
    QColor accent;            ///< focus, selection, and what people can click
    QColor good;              ///< in order, where that has to be shown
    QColor warning;           ///< needs attention
    QColor alarm;             ///< needs action
    QColor stale;             ///< stale values
    QColor held;              ///< frame of signals that a person holds by a lease
    double curveWidth = 1.5;  ///< width of a curve [px]: larger in the theme for sunlight
    QFont font;               ///< font of the panel, for its texts
    QFont labelFont;          ///< font for labels of axes and corners: a little smaller
    QFont figureFont;         ///< font for values that change: all digits have the same width
};
