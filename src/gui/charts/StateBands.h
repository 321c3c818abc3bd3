// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcTheme.h"
#include "QPlcValueNames.h"
#include "gui/plot/PastRows.h"
#include "gui/plot/StateRuns.h"

#include <QtGui/QFont>

#include <qwt_plot_item.h>

namespace qplc {

/// A channel of states as a strip of a plot: a coloured piece for each time in which a value held,
/// with its name. Behind curves; on no y axis.
///
/// Where values cannot be trusted, the lower edge is paler: the state goes on. The x axis is in
/// seconds after the origin, as that of StoreCurve. Values that held for less than a column of
/// pixels are lines across the strip.
class StateBands : public QwtPlotItem
{
public:
    enum Room {
        AtTheBottom,  // as high as a line of text, above each other
        AllHeight     // of the canvas, shared
    };

    /// \param rows have to live as long as they are drawn \param names of the values; without,
    ///         numbers are shown
    StateBands(const PastRows &rows, const QPlcValueNames &names, const QPlcTheme &theme);

    void setFont(const QFont &font) { m_font = font; }
    /// The time that is 0 on the x axis [ns].
    void setOrigin(QPlcPast::Time origin) { m_origin = origin; }
    /// \param place 0 ... count - 1; at the bottom from below, else from above. Of several, each
    ///         one says its title
    void setPlace(int place, int count, Room room);

    /// The colour of a state, here and in legends. \pre not NaN
    QColor colorOf(double value) const;
    /// Of a strip at the bottom [px]
    double lineHeight() const;

    int rtti() const override { return Rtti_PlotUserItem + 2; }
    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    QRectF strip(const QRectF &canvas) const;
    QColor colorOf(double value, double share) const;
    QString textOf(float value) const;

    PastRows m_rows;
    QPlcValueNames m_names;
    QPlcTheme m_theme;
    QFont m_font;
    QPlcPast::Time m_origin = 0;
    int m_place = 0;
    int m_count = 1;
    Room m_room = AtTheBottom;
    // Kept from picture to picture, so that drawing takes little memory.
    mutable CurveShape m_shape;
    mutable StateRuns m_runs;
};

}  // namespace qplc
