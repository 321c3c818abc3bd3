// SPDX-License-Identifier: Apache-2.0
#include "ChartLook.h"

#include <QtGui/QPen>

#include <qwt_plot.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_widget.h>

#include <algorithm>

namespace qplc {

namespace {

constexpr double axisFontShare = 0.85;  // of the font of the window
constexpr double smallFontShare = 0.9;
constexpr double smallestFont = 7.0;  // [pt]

void applyToAxis(QwtPlot *plot, int axis)
{
    plot->axisWidget(axis)->setMargin(0);
    plot->axisWidget(axis)->setSpacing(2);
    plot->axisScaleDraw(axis)->enableComponent(QwtAbstractScaleDraw::Backbone, false);
    plot->axisScaleDraw(axis)->setTickLength(QwtScaleDiv::MinorTick, 0.0);
    plot->axisScaleDraw(axis)->setTickLength(QwtScaleDiv::MediumTick, 0.0);
    plot->axisScaleDraw(axis)->setTickLength(QwtScaleDiv::MajorTick, 3.0);
}

}  // namespace

QFont scaleFont(const QFont &font)
{
    QFont small(font);
    small.setBold(false);
    small.setPointSizeF(std::max(smallestFont, axisFontShare * font.pointSizeF()));
    return small;
}

QFont smallFont(const QFont &font)
{
    QFont small(font);
    small.setPointSizeF(smallFontShare * font.pointSizeF());
    return small;
}

void applyLook(QwtPlot *plot, QwtPlotGrid *grid, const QPlcTheme &theme)
{
    QPalette palette = theme.palette();
    palette.setColor(QPalette::Window, theme.surface);
    palette.setColor(QPalette::WindowText, theme.mutedText);
    palette.setColor(QPalette::Text, theme.mutedText);
    plot->setPalette(palette);
    plot->setAutoFillBackground(true);
    plot->setCanvasBackground(theme.surface);
    for (int axis = 0; axis < QwtPlot::axisCnt; ++axis)
        applyToAxis(plot, axis);
    grid->setMajorPen(theme.line, 1.0);
}

void fitAxes(QwtPlot *plot)
{
    constexpr int least = 3;
    constexpr int most = 8;
    const QFontMetrics metrics(plot->axisFont(QwtPlot::xBottom));
    const int wide = plot->width() / std::max(metrics.horizontalAdvance(QStringLiteral("000000")), 1);
    const int high = plot->height() / std::max(2 * metrics.height(), 1);
    plot->setAxisMaxMajor(QwtPlot::xBottom, std::clamp(wide, least, most));
    plot->setAxisMaxMajor(QwtPlot::yLeft, std::clamp(high, least, most));
}

/// A text that is too long for the side of the plot is cut in the middle: its unit stays.
void setAxisText(QwtPlot *plot, int axis, const QString &text, const QPlcTheme &theme)
{
    const QFont font = scaleFont(plot->font());
    const QFontMetrics metrics(font);
    const bool isUpright = axis == QwtPlot::yLeft || axis == QwtPlot::yRight;
    const int room = isUpright ? plot->height() - 3 * metrics.height() : plot->width() - 4 * metrics.height();
    QwtText title(plot->height() < leastHeightOfTexts ? QString()
                                                      : metrics.elidedText(text, Qt::ElideMiddle, std::max(room, 0)));
    title.setColor(theme.mutedText);
    title.setFont(font);
    plot->setAxisTitle(axis, title);
    plot->setAxisFont(axis, font);
}

QString legendText(const QVector<LegendEntry> &entries)
{
    if (entries.size() < 2)
        return {};
    QStringList texts;
    for (const LegendEntry &entry : entries)
        texts << QStringLiteral("<span style='color:%1'>&#9632;</span>&nbsp;%2")
                     .arg(entry.color.name(), entry.title.toHtmlEscaped());
    return texts.join(QStringLiteral(" &nbsp; "));
}

QString withUnit(const QString &name, const QString &unit)
{
    if (unit.isEmpty())
        return name;
    return name.isEmpty() ? QStringLiteral("[%1]").arg(unit) : QStringLiteral("%1 [%2]").arg(name, unit);
}

}  // namespace qplc
