// SPDX-License-Identifier: Apache-2.0
#include "SpectrumCanvas.h"

#include "ChartLook.h"
#include "ChartSurface.h"
#include "QPlcPanelContext.h"
#include "SpectrumItems.h"

#include <qwt_color_map.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_engine.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

const QString usualNumber = QStringLiteral("-888.8");  // that there is room for beside the y axis
constexpr double decadesOfAxis = 8.0;                  // of an axis that shows all

/// "0.01", and "10⁻⁶" where that is too long.
QString numberOf(double value)
{
    static const QString superscripts = QString::fromUtf8("⁰¹²³⁴⁵⁶⁷⁸⁹");
    const double exponent = value > 0.0 ? std::log10(value) : 0.0;
    const bool isPower = std::fabs(exponent - std::round(exponent)) < 1e-9;
    if (!isPower || std::fabs(exponent) < 3.5)
        return QString::number(value, 'g', 6);
    QString text = QStringLiteral("10");
    const QString digits = QString::number(qRound(exponent));
    for (const QChar digit : digits)
        text += digit == QLatin1Char('-') ? QString::fromUtf8("⁻") : QString(superscripts[digit.digitValue()]);
    return text;
}

/// Numbers times a factor, or powers of ten.
class SpectrumScale : public QwtScaleDraw
{
public:
    explicit SpectrumScale(const QFont &font) { setMinimumExtent(QFontMetricsF(font).horizontalAdvance(usualNumber)); }
    void setFactor(double factor)
    {
        m_factor = factor;
        invalidateCache();
    }
    QwtText label(double value) const override { return numberOf(value * m_factor); }

private:
    double m_factor = 1.0;
};

/// Labels are powers of ten of the numbers of the axis.
class DecadeScale : public QwtScaleDraw
{
public:
    QwtText label(double value) const override { return numberOf(std::pow(10.0, value)); }
};

QwtColorMap *makeColorMap()
{
    const QVector<SpectrogramItem::Stop> &stops = SpectrogramItem::colors();
    auto *map = new QwtLinearColorMap(stops.first().color, stops.last().color);
    for (int i = 1; i + 1 < stops.size(); ++i)
        map->addColorStop(stops[i].place, stops[i].color);
    return map;
}

}  // namespace

SpectrumCanvas::SpectrumCanvas(QWidget *parent)
    : QwtPlot(parent)
    , m_cursorItem(std::make_unique<SpectrumCursor>())
    , m_grid(std::make_unique<QwtPlotGrid>())
{
    new ChartSurface(this);  // becomes the canvas, which the plot owns
    setMinimumSize(60, 40);
    m_grid->attach(this);
    m_cursorItem->attach(this);
    setAxisScaleDraw(xBottom, new SpectrumScale(scaleFont(font())));
    setAxisScaleDraw(yLeft, new SpectrumScale(scaleFont(font())));
    setAxisScaleDraw(yRight, new DecadeScale);
    axisScaleDraw(xBottom)->setMinimumExtent(0.0);
    setEngines();
    plotLayout()->setAlignCanvasToScales(true);
}

SpectrumCanvas::~SpectrumCanvas()
{
    detachItems(QwtPlotItem::Rtti_PlotItem, false);  // they are ours
}

QString SpectrumCanvas::densityUnit(const QString &unit)
{
    if (unit.isEmpty())
        return QStringLiteral("1/Hz");
    const bool isPlain = std::all_of(unit.begin(), unit.end(), [](QChar c) { return c.isLetter() || c == u'%'; });
    // arg() would take the 2 for a part of its place.
    return (isPlain ? unit : QStringLiteral("(%1)").arg(unit)) + QString::fromUtf8("²/Hz");
}

void SpectrumCanvas::setTheme(const QPlcTheme &theme)
{
    m_theme = theme;
    applyLook(this, m_grid.get(), theme);
    showColors();
    showTitles();
    replot();
}

void SpectrumCanvas::setLooks(const Looks &looks)
{
    m_looks = looks;
    m_isHeld = false;
    setEngines();
    showAll();
}

void SpectrumCanvas::setEngines()
{
    const auto engine = [](bool isLog) -> QwtScaleEngine * {
        return isLog ? static_cast<QwtScaleEngine *>(new QwtLogScaleEngine) : new QwtLinearScaleEngine;
    };
    setAxisScaleEngine(xBottom, engine(!isSpectrogram() && m_looks.isLogFrequency));
    setAxisScaleEngine(yLeft, engine(isSpectrogram() ? m_looks.isLogFrequency : m_looks.isLogValue));
    for (const Axis axis : {xBottom, yLeft})
        static_cast<SpectrumScale *>(axisScaleDraw(axis))->setFactor(1.0);
}

void SpectrumCanvas::show(const QVector<Curve> &curves)
{
    const bool wasSpectrogram = isSpectrogram();
    m_spectrogram.reset();
    m_items.clear();
    m_curves = curves;
    for (const Curve &curve : qAsConst(m_curves)) {
        m_items.push_back(std::make_unique<SpectrumCurve>(curve.lines));
        m_items.back()->attach(this);
    }
    enableAxis(yRight, false);
    m_grid->show();
    if (wasSpectrogram) {
        m_isHeld = false;
        setEngines();
    }
    showAll();
}

void SpectrumCanvas::show(const Spectrogram &spectrogram)
{
    const bool wasSpectrogram = isSpectrogram();
    m_items.clear();
    m_curves.clear();
    m_title = spectrogram.title;
    m_unit = spectrogram.unit;
    m_spectrogram = std::make_unique<SpectrogramItem>(spectrogram.picture);
    m_spectrogram->attach(this);
    if (!wasSpectrogram) {
        m_isHeld = false;
        setEngines();
    }
    const QwtInterval range(std::log10(double(std::max(spectrogram.picture.lowest, 1e-37F))),
                            std::log10(double(std::max(spectrogram.picture.highest, 1e-36F))));
    axisWidget(yRight)->setColorBarEnabled(true);
    axisWidget(yRight)->setColorMap(range, makeColorMap());
    setAxisScale(yRight, range.minValue(), range.maxValue());
    enableAxis(yRight, true);
    m_grid->hide();  // the colours are to be seen
    showAll();
}

void SpectrumCanvas::showColors()
{
    for (int i = 0; i < int(m_items.size()); ++i) {
        const QColor own = m_curves.at(i).color;
        m_items[std::size_t(i)]->setLook(own.isValid() ? own : m_theme.curve(i), m_theme.curveWidth);
    }
    m_cursorItem->setLook(m_theme.text);
}

/// Zoomed axes stay; the others show all.
void SpectrumCanvas::showAll()
{
    showColors();
    if (!m_isHeld && isSpectrogram()) {
        const Spectrum::Picture &picture = m_spectrogram->picture();
        setAxisScale(xBottom, picture.begin, picture.begin + double(picture.columns) * picture.duration);
        scaleFrequency(double(std::max<std::size_t>(picture.lines, 2) - 1) * picture.step, picture.step);
    } else if (!m_isHeld) {
        double highest = 0.0;
        double step = INFINITY;
        for (const Curve &curve : qAsConst(m_curves)) {
            if (curve.lines.values.size() < 2)
                continue;
            highest = std::max(highest, double(curve.lines.values.size() - 1) * curve.lines.step);
            step = std::min(step, curve.lines.step);
        }
        if (highest > 0.0) {
            scaleFrequency(highest, step);
            scaleValues();
        }
    }
    showTitles();
    m_cursorItem->place(m_cursor, !isSpectrogram());
    replot();
}

void SpectrumCanvas::scaleFrequency(double highest, double step)
{
    setAxisScale(frequencyAxis(), m_looks.isLogFrequency ? step : 0.0, std::max(highest, 2.0 * step));
}

/// Whole decades, or from 0 on.
void SpectrumCanvas::scaleValues()
{
    constexpr double room = 1.05;
    double highest = 0.0;
    for (const Curve &curve : qAsConst(m_curves))
        highest = std::max(highest, curve.lines.values.empty() ? 0.0 : curve.lines.values[curve.lines.highest()]);
    if (!(highest > 0.0))
        highest = 1.0;
    double lowest = highest;
    for (const Curve &curve : qAsConst(m_curves)) {
        for (std::size_t line = 1; line < curve.lines.values.size(); ++line) {
            if (curve.lines.values[line] > 0.0)
                lowest = std::min(lowest, curve.lines.values[line]);
        }
    }
    const double top = std::ceil(std::log10(highest) + 0.02);
    const double bottom = std::max(std::floor(std::log10(lowest)), top - decadesOfAxis);
    if (m_looks.isLogValue)
        setAxisScale(yLeft, std::pow(10.0, std::min(bottom, top - 1.0)), std::pow(10.0, top));
    else
        setAxisScale(yLeft, 0.0, room * highest);
}

SeenRange SpectrumCanvas::seen(int axis) const
{
    if (!m_isHeld)
        return {};
    const QwtInterval interval = axisInterval(axis);
    return {interval.minValue(), interval.maxValue()};
}

/// Not set: the curves have several.
std::optional<QString> SpectrumCanvas::commonUnit() const
{
    if (m_curves.isEmpty())
        return QString();
    const QString &first = m_curves.first().unit;
    const bool isCommon
        = std::all_of(m_curves.begin(), m_curves.end(), [&first](const Curve &curve) { return curve.unit == first; });
    return isCommon ? std::optional(first) : std::nullopt;
}

void SpectrumCanvas::showTitles()
{
    const QString frequency = tr("frequency [Hz]");
    if (isSpectrogram()) {
        setAxisText(this, xBottom, tr("time [s]"), m_theme);
        setAxisText(this, yLeft, frequency, m_theme);
        setAxisText(this, yRight, tr("power density [%1]").arg(densityUnit(m_unit)), m_theme);
        return;
    }
    setAxisText(this, xBottom, frequency, m_theme);
    const std::optional<QString> unit = commonUnit();
    if (!m_curves.isEmpty() && m_curves.first().isDensity) {
        setAxisText(this, yLeft, unit ? tr("power density [%1]").arg(densityUnit(*unit)) : tr("power density"),
                    m_theme);
        return;
    }
    QPlcPanelContext::Prefix prefix{1.0, unit.value_or(QString())};
    if (!m_looks.isLogValue)
        prefix = QPlcPanelContext::prefix(prefix.unit, axisInterval(yLeft).maxValue());
    static_cast<SpectrumScale *>(axisScaleDraw(yLeft))->setFactor(prefix.factor);
    setAxisText(this, yLeft, withUnit(tr("amplitude"), prefix.unit), m_theme);
}

// ---- the view ----

/// Corners in pixels of the canvas: so logarithmic axes are zoomed as linear ones.
void SpectrumCanvas::hold(QPointF topLeft, QPointF bottomRight)
{
    const QwtScaleMap x = canvasMap(xBottom);
    const QwtScaleMap y = canvasMap(yLeft);
    const double left = x.invTransform(topLeft.x());
    const double right = x.invTransform(bottomRight.x());
    const double bottom = y.invTransform(bottomRight.y());
    const double top = y.invTransform(topLeft.y());
    for (const auto &[low, high] : {std::pair(left, right), std::pair(bottom, top)}) {
        constexpr double least = 1e-6;  // of the numbers
        const double size = std::max(std::fabs(low), std::fabs(high));
        if (!std::isfinite(low) || !std::isfinite(high) || !(high - low > least * size) || size > 1e100)
            return;
    }
    m_isHeld = true;
    setAxisScale(xBottom, left, right);
    setAxisScale(yLeft, bottom, top);
    showTitles();
    replot();
}

void SpectrumCanvas::zoom(double xFactor, double yFactor, QPointF about)
{
    const QRectF all = canvas()->rect();
    const auto zoomed = [&](QPointF corner) {
        return QPointF(about.x() + xFactor * (corner.x() - about.x()), about.y() + yFactor * (corner.y() - about.y()));
    };
    hold(zoomed(all.topLeft()), zoomed(all.bottomRight()));
}

void SpectrumCanvas::pan(QPointF by)
{
    const QRectF all = canvas()->rect();
    hold(all.topLeft() - by, all.bottomRight() - by);
}

void SpectrumCanvas::zoomTo(const QRectF &box)
{
    hold(box.topLeft(), box.bottomRight());
}

void SpectrumCanvas::release()
{
    m_isHeld = false;
    showAll();
}

// ---- the cursor ----

void SpectrumCanvas::placeCursor(std::optional<double> frequency)
{
    m_cursor = frequency;
    m_cursorItem->place(m_cursor, !isSpectrogram());
    replot();
}

double SpectrumCanvas::frequencyAt(QPointF place) const
{
    return canvasMap(frequencyAxis()).invTransform(isSpectrogram() ? place.y() : place.x());
}

double SpectrumCanvas::timeAt(QPointF place) const
{
    return canvasMap(xBottom).invTransform(place.x());
}

std::size_t SpectrumCanvas::lineNear(const Spectrum::Lines &lines, double frequency) const
{
    constexpr double hand = 4.0;  // [px]
    if (lines.values.size() < 2)
        return 0;
    const QwtScaleMap map = canvasMap(xBottom);
    const double place = map.transform(frequency);
    const auto lineAt = [&](double at) {
        const double line = std::round(map.invTransform(at) / lines.step);
        return std::isfinite(line) ? std::size_t(std::clamp(line, 1.0, double(lines.values.size() - 1))) : 1;
    };
    const auto begin = lines.values.begin() + std::ptrdiff_t(lineAt(place - hand));
    const auto end = lines.values.begin() + std::ptrdiff_t(lineAt(place + hand)) + 1;
    return std::size_t(std::max_element(begin, end) - lines.values.begin());
}

std::optional<double> SpectrumCanvas::densityAt(double time, double frequency) const
{
    if (!isSpectrogram())
        return std::nullopt;
    const Spectrum::Picture &picture = m_spectrogram->picture();
    const double column = std::floor(m_spectrogram->columnAt(time));
    const double line = std::floor(m_spectrogram->lineAt(frequency));
    if (column < 0.0 || line < 0.0 || column >= double(picture.columns) || line >= double(picture.lines))
        return std::nullopt;
    return double(picture.at(std::size_t(column), std::size_t(line)));
}

void SpectrumCanvas::resizeEvent(QResizeEvent *event)
{
    QwtPlot::resizeEvent(event);
    fitAxes(this);
    showTitles();
    replot();
}

}  // namespace qplc
