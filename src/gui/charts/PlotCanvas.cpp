// SPDX-License-Identifier: Apache-2.0
#include "PlotCanvas.h"

#include "ChartLook.h"
#include "ChartSurface.h"
#include "PlotScales.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>

#include <qwt_plot_item.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_widget.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double widthsOfLabel = 1.35;  // widths of a label from one to the next on the time axis
constexpr int fewestTicks = 2;
constexpr int usualCharacters = 8;  // of labels of a y axis: -88888.8
constexpr int fewCharacters = 5;
constexpr double shareOfFurtherAxes = 0.4;  // of the width, at most

}  // namespace

PlotCanvas::PlotCanvas(QWidget *parent)
    : QwtPlot(parent)
{
    setAutoDelete(false);
    new ChartSurface(this);  // becomes the canvas, which the plot owns
    setAutoFillBackground(true);
    setMinimumSize(1, 1);
    plotLayout()->setAlignCanvasToScales(true);
    plotLayout()->setCanvasMargin(0);
    plotLayout()->setSpacing(2);
    m_grid.enableXMin(false);
    m_grid.attach(this);
    m_axes.resize(2);
    connect(this, &QwtPlot::itemAttached, this, [this](QwtPlotItem *item, bool isAttached) {
        if (!isAttached)
            m_axisOfItem.remove(item);
    });
    renewScales();
}

PlotCanvas::~PlotCanvas()
{
    disconnect(this, &QwtPlot::itemAttached, this, nullptr);
}

void PlotCanvas::renewScales()
{
    const QFont font = scaleFont(this->font());
    m_timeScale = new TimeScaleDraw(font, m_isCompact);
    setAxisScaleDraw(xBottom, m_timeScale);
    axisWidget(xBottom)->setMinBorderDist(m_timeScale->sideRoom(), m_timeScale->sideRoom());
    setAxisFont(xBottom, font);
    axisWidget(xBottom)->setMargin(0);
    for (Axis axis = 0; axis < axisCount(); ++axis)
        renewScale(axis);
}

void PlotCanvas::renewScale(Axis axis)
{
    const QFont font = scaleFont(this->font());
    scaleWidget(axis)->setScaleDraw(
        new ValueScaleDraw(font, m_isCompact || axis > 1 ? fewCharacters : usualCharacters));
    scaleWidget(axis)->setSpacing(1);
    scaleWidget(axis)->setMargin(0);
    scaleWidget(axis)->setFont(font);
    applyNames(axis);
}

QwtScaleWidget *PlotCanvas::scaleWidget(Axis axis) const
{
    const ValueAxis &values = m_axes[std::size_t(axis)];
    QwtScaleWidget *further = values.further.get();
    return further ? further : const_cast<QwtScaleWidget *>(axisWidget(axis == 0 ? yLeft : yRight));
}

ValueScaleDraw *PlotCanvas::scaleDraw(Axis axis) const
{
    return static_cast<ValueScaleDraw *>(scaleWidget(axis)->scaleDraw());
}

PlotCanvas::Axis PlotCanvas::axisOf(const QWidget *scale) const
{
    for (Axis axis = 0; axis < axisCount(); ++axis) {
        if (scaleWidget(axis) == scale)
            return axis;
    }
    return -1;
}

void PlotCanvas::setAxes(const PlotAxes &axes)
{
    for (Axis axis = 2; axis < std::max(axisCount(), axes.count()); ++axis) {
        const bool isThere = axis < axisCount();
        if (isThere && axis < axes.count() && m_axes[std::size_t(axis)].further->side() == axes.at(axis).side)
            continue;
        if (axis >= axes.count()) {
            m_axes.resize(std::size_t(axes.count()));
            break;
        }
        if (!isThere)
            m_axes.emplace_back();
        m_axes[std::size_t(axis)].further = std::make_unique<FurtherAxis>(axes.at(axis).side, this);
        renewScale(axis);
        Q_EMIT scaleAdded(scaleWidget(axis));
    }
}

void PlotCanvas::attach(QwtPlotItem *item, Axis axis)
{
    item->setYAxis(axis == 1 ? yRight : yLeft);
    item->attach(this);
    if (axis > 1)
        m_axisOfItem.insert(item, axis);
}

void PlotCanvas::setAxisVisible(Axis axis, bool isVisible)
{
    m_axes[std::size_t(axis)].isVisible = isVisible;
    if (axis < 2)
        enableAxis(axis == 0 ? yLeft : yRight, isVisible);
    else
        updateLayout();
}

bool PlotCanvas::isAxisVisible(Axis axis) const
{
    return !scaleWidget(axis)->isHidden();
}

void PlotCanvas::setTheme(const QPlcTheme &theme)
{
    QPalette palette = theme.palette();
    palette.setColor(QPalette::Window, theme.surface);
    palette.setColor(QPalette::WindowText, theme.mutedText);
    palette.setColor(QPalette::Text, theme.mutedText);
    setPalette(palette);
    setCanvasBackground(theme.surface);
    m_grid.setMajorPen(theme.line, 0.0);
    m_mutedText = theme.mutedText;
    axisWidget(xBottom)->setPalette(palette);
    for (Axis axis = 0; axis < axisCount(); ++axis)
        showColor(axis);
}

void PlotCanvas::setUnit(Axis axis, const QString &unit, const QVector<QColor> &colors)
{
    ValueAxis &values = m_axes[std::size_t(axis)];
    if (values.prefix.tableUnit() != unit)
        values.prefix = SiPrefix::fitting(unit, largest(axis));
    values.colors = colors;
    showPrefix(axis);
    showUnit(axis);
    showColor(axis);
}

void PlotCanvas::setNames(Axis axis, const QPlcValueNames &names)
{
    m_axes[std::size_t(axis)].names = names;
    applyNames(axis);
}

void PlotCanvas::setNumbersVisible(Axis axis, bool areVisible)
{
    m_axes[std::size_t(axis)].hasNumbers = areVisible;
    applyNames(axis);
}

void PlotCanvas::applyNames(Axis axis)
{
    const ValueAxis &values = m_axes[std::size_t(axis)];
    scaleDraw(axis)->setNames(values.names);
    showPrefix(axis);
    scaleDraw(axis)->enableComponent(QwtAbstractScaleDraw::Labels, values.hasNumbers);
    scaleDraw(axis)->enableComponent(QwtAbstractScaleDraw::Ticks, values.hasNumbers);
}

/// With a square for each of several curves, in its colour.
void PlotCanvas::showUnit(Axis axis)
{
    const ValueAxis &values = m_axes[std::size_t(axis)];
    QString squares;
    for (const QColor &color : values.colors)
        squares += QStringLiteral("<span style='color:%1'>&#9632;</span>").arg(color.name());
    const QString unit = values.prefix.unit();
    QwtText title(unit);
    if (values.colors.size() > 1)
        title.setText(squares + QStringLiteral("&nbsp;") + unit.toHtmlEscaped(), QwtText::RichText);
    if (m_isCompact)
        title = QwtText(QString());
    title.setFont(scaleFont(font()));
    title.setRenderFlags(Qt::AlignCenter);
    scaleWidget(axis)->setTitle(title);
}

/// Numbers in the colour of the curve, where all curves of the axis have one.
void PlotCanvas::showColor(Axis axis)
{
    const ValueAxis &values = m_axes[std::size_t(axis)];
    const QColor color = values.colors.size() == 1 ? values.colors.first() : m_mutedText;
    QPalette palette = this->palette();
    palette.setColor(QPalette::WindowText, color);
    palette.setColor(QPalette::Text, color);
    scaleWidget(axis)->setPalette(palette);
}

void PlotCanvas::setCompact(bool isCompact)
{
    if (isCompact == m_isCompact)
        return;
    m_isCompact = isCompact;
    renewScales();
    for (Axis axis = 0; axis < axisCount(); ++axis)
        showUnit(axis);
    updateLayout();
}

int PlotCanvas::deviceWidth() const
{
    return std::max(1, qRound(canvasMap(xBottom).pDist() * devicePixelRatioF()));
}

void PlotCanvas::setTime(const TimeColumns &columns, PlotSettings::Labels labels, Time reference,
                         std::optional<Time> event)
{
    m_begin = columns.beginOf(columns.first());
    m_end = std::max(columns.beginOf(columns.end()), m_begin + 1);
    m_origin = beginOfDay(m_begin);
    const int widest = std::max(fewestTicks, int(canvas()->width() / (widthsOfLabel * m_timeScale->usualWidth())));
    const bool isClock = labels == PlotSettings::Labels::Clock;
    const TimeTicks ticks = event ? TimeTicks::aroundEvent(m_begin, m_end, widest, *event)
        : isClock                 ? TimeTicks(m_begin, m_end, widest)
                                  : TimeTicks(m_begin, m_end, widest, reference);
    const auto seconds = [this](const QVector<Time> &times) {
        QList<double> values;
        for (const Time time : times)
            values.append(double(time - m_origin) * 1e-9);
        return values;
    };
    m_timeScale->setTicks(ticks, m_origin);
    setAxisScaleDiv(xBottom,
                    QwtScaleDiv(double(m_begin - m_origin) * 1e-9, double(m_end - m_origin) * 1e-9,
                                seconds(ticks.minor()), {}, seconds(ticks.major())));
}

void PlotCanvas::setRange(Axis axis, double minimum, double maximum, Ticks ticks, double lane)
{
    const double line = QFontMetricsF(scaleWidget(axis)->font()).height();
    const double height = canvas()->height() - lane;
    QwtScaleDiv scale = valueScale(minimum, maximum, height, line, ticks == WholeTicks ? 1.0 : 0.0);
    if (lane > 0.0 && height > lane)
        scale.setLowerBound(minimum - (maximum - minimum) * lane / height);
    ValueAxis &values = m_axes[std::size_t(axis)];
    values.scale = scale;
    const QString shownUnit = values.prefix.unit();
    values.prefix = values.prefix.kept(largest(axis));
    showPrefix(axis);
    if (values.prefix.unit() != shownUnit)
        showUnit(axis);
    if (axis < 2)
        setAxisScaleDiv(axis == 0 ? yLeft : yRight, scale);
    else
        scaleWidget(axis)->setScaleDiv(scale);
}

double PlotCanvas::largest(Axis axis) const
{
    const QwtScaleDiv &scale = m_axes[std::size_t(axis)].scale;
    return std::max(std::abs(scale.lowerBound()), std::abs(scale.upperBound()));
}

/// Names are those of the values as they are.
void PlotCanvas::showPrefix(Axis axis)
{
    scaleDraw(axis)->setFactor(m_axes[std::size_t(axis)].prefix.factor());
}

QwtScaleMap PlotCanvas::mapOf(Axis axis) const
{
    return axis < 2 ? canvasMap(axis == 0 ? yLeft : yRight) : mapOf(axis, canvasMap(yLeft));
}

/// The places of the left axis with the values of another one.
QwtScaleMap PlotCanvas::mapOf(Axis axis, QwtScaleMap ofLeft) const
{
    const QwtScaleDiv &scale = m_axes[std::size_t(axis)].scale;
    ofLeft.setScaleInterval(scale.lowerBound(), scale.upperBound());
    return ofLeft;
}

void PlotCanvas::drawItems(QPainter *painter, const QRectF &canvasRect, const QwtScaleMap maps[axisCnt]) const
{
    if (m_axisOfItem.isEmpty()) {
        QwtPlot::drawItems(painter, canvasRect, maps);
        return;
    }
    for (const QwtPlotItem *item : itemList()) {
        if (!item->isVisible())
            continue;
        const Axis axis = m_axisOfItem.value(item, -1);
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing, item->testRenderHint(QwtPlotItem::RenderAntialiased));
        item->draw(painter, maps[item->xAxis()], axis < 0 ? maps[item->yAxis()] : mapOf(axis, maps[yLeft]), canvasRect);
        painter->restore();
    }
}

/// Further axes are seen while the curves keep most of the width.
void PlotCanvas::makeRoom()
{
    int room = int(shareOfFurtherAxes * width());
    int left = 0;
    int right = 0;
    for (Axis axis = 2; axis < axisCount(); ++axis) {
        const ValueAxis &values = m_axes[std::size_t(axis)];
        const int wanted = values.further->widthFor(std::max(1, canvas()->height()));
        const bool isSeen = values.isVisible && wanted <= room;
        values.further->setVisible(isSeen);
        if (!isSeen)
            continue;
        room -= wanted;
        (values.further->side() == PlotCurveSettings::Left ? left : right) += wanted;
    }
    if (contentsMargins() != QMargins(left, 0, right, 0))
        setContentsMargins(left, 0, right, 0);
}

void PlotCanvas::placeFurtherAxes()
{
    const QwtScaleMap map = canvasMap(yLeft);
    const double top = canvas()->y() + std::min(map.p1(), map.p2());
    const double bottom = canvas()->y() + std::max(map.p1(), map.p2());
    int left = contentsRect().left();
    int right = contentsRect().right() + 1;
    for (Axis axis = 2; axis < axisCount(); ++axis) {
        FurtherAxis *further = m_axes[std::size_t(axis)].further.get();
        if (further->isHidden())
            continue;
        const int wanted = further->widthFor(canvas()->height());
        const bool isLeft = further->side() == PlotCurveSettings::Left;
        left -= isLeft ? wanted : 0;
        further->place(isLeft ? left : right, top, bottom);
        right += isLeft ? 0 : wanted;
    }
}

void PlotCanvas::updateLayout()
{
    makeRoom();
    QwtPlot::updateLayout();
    placeFurtherAxes();
}

void PlotCanvas::paintFurtherAxes(QPainter *painter) const
{
    for (Axis axis = 2; axis < axisCount(); ++axis) {
        const FurtherAxis *further = m_axes[std::size_t(axis)].further.get();
        if (further->isHidden())
            continue;
        painter->save();
        painter->translate(further->pos());
        painter->setFont(further->font());
        further->draw(painter);
        painter->restore();
    }
}

PlotCanvas::Time PlotCanvas::timeAt(double x) const
{
    const QwtScaleMap map = canvasMap(xBottom);
    const double share = (x - map.p1()) / std::max(map.pDist(), 1.0);
    return m_begin + std::llround(share * double(m_end - m_begin));
}

double PlotCanvas::xOf(Time time) const
{
    const QwtScaleMap map = canvasMap(xBottom);
    return map.p1() + double(time - m_begin) / double(m_end - m_begin) * map.pDist();
}

void PlotCanvas::resizeEvent(QResizeEvent *event)
{
    QwtPlot::resizeEvent(event);
    Q_EMIT resized();
}

void PlotCanvas::changeEvent(QEvent *event)
{
    QwtPlot::changeEvent(event);
    if (event->type() == QEvent::FontChange && m_timeScale)
        renewScales();
}

}  // namespace qplc
