// SPDX-License-Identifier: Apache-2.0
#include "PlotCurves.h"

#include "ChartLook.h"
#include "PlotCanvas.h"
#include "QPlcPanelContext.h"
#include "gui/models/ValueFormat.h"
#include "gui/plot/PastRows.h"

#include <qwt_plot_marker.h>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr QPlcPast::Time calmTime = 200'000'000;  // [ns] for which the legend says what has been wrong
constexpr double boldness = 1.0;                  // [px] that the selected curve is thicker
constexpr double limitOpacity = 0.6;              // of the colour of the curve
constexpr double laneMargin = 3.0;                // [px] between bands and lines
constexpr int digitsOfLine = 6;
constexpr double opacityOfNextRun = 0.8;  // of the one before
constexpr double leastOpacity = 0.35;
constexpr std::size_t rowsOfDifferences = 4'000'000;  // of all curves together: some 54 MB
constexpr std::size_t fewestRows = 1024;
constexpr int rowsOfTurn = 200'000;  // of differences, of all curves together: some milliseconds
constexpr double limitDepth = 15.0;  // below the curves, above the grid

}  // namespace

PlotCurve::PlotCurve() = default;
PlotCurve::PlotCurve(PlotCurve &&) noexcept = default;
PlotCurve::~PlotCurve() = default;

double PlotCurve::value(std::optional<QPlcPast::Time> time) const
{
    if (isMissing() || source.isEmpty())
        return NAN;
    if (!time && run.shift != 0)
        return NAN;  // what it has now lies elsewhere
    const PastRows rows = PastRows::of(source);
    if (time && !run.contains(*time - run.shift))
        return NAN;
    return time ? CursorStatistics::valueAt(*rows.store, rows.channel, scaling(), *time - run.shift)
                : settings.gain * source.value(source.endRow() - 1) + settings.offset;
}

QString PlotCurve::text() const
{
    const QString text = run.name.isEmpty() ? settings.text() : settings.text() + QStringLiteral(" · ") + run.name;
    return difference ? QStringLiteral("Δ ") + text : text;
}

std::pair<QPlcPast::Time, QPlcPast::Time> PlotCurve::ownTimes(QPlcPast::Time begin, QPlcPast::Time end) const
{
    return {std::max(std::min(begin, end) - run.shift, run.begin),
            std::min(std::max(begin, end) - run.shift, run.isWhole() ? run.end : run.end - 1)};
}

QColor PlotCurve::swatchColor(double value) const
{
    return bands && !std::isnan(value) ? bands->colorOf(value) : color;
}

QPlcQuality::Kind PlotCurve::mark(std::optional<QPlcPast::Time> time) const
{
    if (isMissing() || source.isEmpty())
        return QPlcQuality::Good;
    const QPlcPast::Row end = time ? source.rowAt(*time - run.shift + 1) : source.endRow();
    const QPlcPast::Row newest = std::max(end, source.firstRow() + 1) - 1;
    return source.quality(time ? newest : source.rowAt(source.time(newest) - calmTime), end);
}

PlotCurves::PlotCurves(PlotCanvas *plot)
    : m_plot(plot)
{
}

PlotCurves::~PlotCurves() = default;

void PlotCurves::bind(const PlotSettings &settings, const QPlcPanelContext &context, const std::vector<PlotRun> &runs)
{
    const QPlcTheme theme = context.theme();
    const std::vector<PlotCurve> before = std::move(m_curves);  // derived signals that go on are not made anew
    m_curves.clear();
    m_pasts.clear();
    m_selected = std::min(m_selected, settings.curves.size() - 1);
    m_axes = PlotAxes();
    for (const PlotCurveSettings &wanted : settings.curves) {
        PlotCurve curve;
        curve.settings = wanted;
        curve.source = context.past(wanted.signal);
        curve.color = wanted.color.isValid() ? wanted.color : theme.curve(size());
        curve.penStyle = QPlcTheme::curveStyle(size());
        if (curve.isMissing())
            curve.axis = wanted.axis == PlotCurveSettings::Right ? 1 : 0;
        else if (!curve.isDrawnAsBands())
            curve.axis = m_axes.add(wanted.axis, curve.source.unit);
        if (!runs.empty())
            curve.run = runs.front();
        m_curves.push_back(std::move(curve));
    }
    addFurther(context, runs);
    for (PlotCurve &curve : m_curves) {
        if (runs.size() > 1 && settings.runs.hidden.contains(curve.run.name))
            curve.settings.isVisible = false;
    }
    if (settings.runs.hasDifferences() && runs.size() > 1)
        makeDifferences(std::size_t(settings.curves.size()));
    m_plot->setAxes(m_axes);
    for (PlotCurve &curve : m_curves) {
        if (curve.isSeen())
            show(&curve, settings.showsLimits(), theme);
    }
    placeBands();
    select(m_selected, theme);
    m_lines.clear();
    m_lineValues.assign(std::size_t(m_axes.count()), {});
    for (int axis = 0; axis < m_axes.count(); ++axis)
        showLines(axis, settings.range(axis, m_axes.at(axis).unit).lines, theme);
}

/// Each curve once more for each run, on the axis of the curve. A single curve has a colour for
/// each run; of several ones each keeps its colour, and runs are dashed, dotted, and paler.
void PlotCurves::addFurther(const QPlcPanelContext &context, const std::vector<PlotRun> &runs)
{
    const QPlcTheme theme = context.theme();
    const std::size_t count = m_curves.size();
    for (std::size_t place = 1; place < runs.size(); ++place) {
        for (std::size_t i = 0; i < count; ++i) {
            const PlotCurve &base = m_curves[i];
            if (base.isMissing() || base.isDrawnAsBands())
                continue;
            PlotCurve curve;
            curve.isFurther = true;
            curve.run = runs[place];
            curve.settings = base.settings;
            curve.axis = base.axis;
            curve.source = runs[place].plant.isEmpty()
                ? base.source
                : plantPast(context, base.settings.signal, base.source.plant, runs[place].plant);
            curve.color = base.color;
            if (count == 1) {
                curve.color = theme.curve(int(place));
                curve.penStyle = QPlcTheme::curveStyle(int(place));
            } else {
                curve.penStyle = place % 2 == 1 ? Qt::DashLine : Qt::DotLine;
                curve.color.setAlphaF(std::max(std::pow(opacityOfNextRun, double(place - 1)), leastOpacity));
            }
            m_curves.push_back(std::move(curve));
        }
    }
}

/// Of the curves behind the first \a bases; those are no longer drawn.
void PlotCurves::makeDifferences(std::size_t bases)
{
    const std::size_t count = std::max<std::size_t>(m_curves.size() - bases, 1);
    const int most = int(std::max<std::size_t>(rowsOfDifferences / count, fewestRows));
    for (std::size_t i = bases; i < m_curves.size(); ++i) {
        PlotCurve &curve = m_curves[i];
        const auto base = std::find_if(m_curves.begin(), m_curves.end(), [&](const PlotCurve &each) {
            return !each.isFurther && each.settings.signal == curve.settings.signal;
        });
        if (curve.isMissing())
            continue;
        const PastRows under = PastRows::of(base->source);
        const PastRows over = PastRows::of(curve.source);
        curve.runPasts = {base->source, curve.source};
        curve.difference = std::make_unique<RunDifference>(
            RunDifference::Reference{under.store, under.channel},
            RunDifference::Run{over.store, over.channel, curve.run.shift, curve.run.begin, curve.run.end},
            curve.source.isStepped, most);
        QPlcPast past = PastRows::past(curve.difference->store(), 0);
        past.expression = curve.source.expression;
        past.plant = curve.source.plant;
        past.unit = curve.source.unit;
        past.isStepped = curve.source.isStepped;
        curve.source = past;
        curve.settings.offset = 0.0;
        const QString name = curve.run.name;
        curve.run = PlotRun();  // its rows are those of the reference
        curve.run.name = name;
    }
    for (std::size_t i = 0; i < bases; ++i)
        m_curves[i].isReplaced = !m_curves[i].isDrawnAsBands();
    advanceDifferences();
}

void PlotCurves::advanceDifferences()
{
    for (const PlotCurve &curve : m_curves) {
        if (curve.difference)
            curve.difference->advance(std::max(rowsOfTurn / size(), 1));
    }
}

bool PlotCurves::areDifferencesCut() const
{
    return std::any_of(m_curves.begin(), m_curves.end(),
                       [](const PlotCurve &each) { return each.difference && each.difference->isCut(); });
}

bool PlotCurves::hasRuns() const
{
    return std::any_of(m_curves.begin(), m_curves.end(), [](const PlotCurve &each) { return each.isFurther; });
}

QPlcPast::Row PlotCurves::endOfFurtherRows() const
{
    QPlcPast::Row end = 0;
    for (const PlotCurve &curve : m_curves)
        end += curve.isFurther && curve.isSeen() && curve.run.isWhole() ? curve.source.endRow() : 0;
    return end;
}

void PlotCurves::showLines(int axis, const QVector<double> &lines, const QPlcTheme &theme)
{
    if (!hasAxis(axis))
        return;
    m_lineValues[std::size_t(axis)] = lines;
    for (const double line : lines) {
        auto marker = std::make_unique<QwtPlotMarker>();
        marker->setLineStyle(QwtPlotMarker::HLine);
        marker->setLinePen(theme.text, 1.0, Qt::DashDotLine);
        marker->setYValue(line);
        marker->setZ(limitDepth);
        const SiPrefix prefix = SiPrefix::fitting(m_axes.at(axis).unit, line);
        QwtText text((numberText(prefix.shown(line), digitsOfLine) + QLatin1Char(' ') + prefix.unit()).trimmed());
        text.setColor(theme.text);
        text.setFont(scaleFont(m_plot->font()));
        marker->setLabel(text);
        marker->setLabelAlignment((m_axes.at(axis).side == PlotCurveSettings::Left ? Qt::AlignLeft : Qt::AlignRight)
                                  | Qt::AlignTop);
        marker->setSpacing(1);
        m_plot->attach(marker.get(), axis);
        m_lines.push_back(std::move(marker));
    }
}

void PlotCurves::show(PlotCurve *curve, bool showsLimits, const QPlcTheme &theme)
{
    const QPlcPast &source = curve->source;
    const auto isKnown = [&](const QPlcPast &each) { return each.sharesRows(source); };
    if (!curve->isFurther && std::none_of(m_pasts.begin(), m_pasts.end(), isKnown))
        m_pasts.push_back(source);
    if (curve->isDrawnAsBands()) {
        showBands(curve, theme);
        return;
    }
    const PastRows rows = PastRows::of(source);
    curve->item = std::make_unique<StoreCurve>(rows.store, rows.channel, curve->text());
    curve->item->setLimits(curve->run.begin, curve->run.end);
    curve->item->setColor(curve->color);
    curve->item->setPenStyle(curve->penStyle);
    curve->item->setLineWidth(theme.curveWidth);
    curve->item->setScaling(curve->settings.gain, curve->settings.offset);
    curve->item->setStyle(source.isStepped ? StoreCurve::Steps : StoreCurve::Line);
    curve->item->setOrigin(m_origin - curve->run.shift);
    curve->item->setRenderHint(QwtPlotItem::RenderAntialiased);
    m_plot->attach(curve->item.get(), curve->axis);
    for (const std::optional<double> &limit : {source.minimum, source.maximum}) {
        if (showsLimits && limit && !curve->isFurther)
            showLimit(curve, curve->settings.gain * *limit + curve->settings.offset);
    }
}

void PlotCurves::showBands(PlotCurve *curve, const QPlcTheme &theme)
{
    curve->bands = std::make_unique<StateBands>(PastRows::of(curve->source), curve->source.names, theme);
    curve->bands->setTitle(curve->settings.text());
    curve->bands->setFont(scaleFont(m_plot->font()));
    curve->bands->setOrigin(m_origin);
    curve->bands->setZ(limitDepth - 1.0);
    curve->bands->attach(m_plot);
}

/// Above each other at the bottom, or, where there is nothing else, over all the height.
void PlotCurves::placeBands()
{
    const auto isBands = [](const PlotCurve &each) { return each.bands != nullptr; };
    const int count = int(std::count_if(m_curves.begin(), m_curves.end(), isBands));
    const bool isAlone
        = std::none_of(m_curves.begin(), m_curves.end(), [](const PlotCurve &each) { return each.isLine(); });
    int place = 0;
    for (const PlotCurve &curve : m_curves) {
        if (curve.bands)
            curve.bands->setPlace(place++, count, isAlone ? StateBands::AllHeight : StateBands::AtTheBottom);
    }
}

void PlotCurves::showLimit(PlotCurve *curve, double limit)
{
    QColor color = curve->color;
    color.setAlphaF(limitOpacity);
    auto marker = std::make_unique<QwtPlotMarker>();
    marker->setLineStyle(QwtPlotMarker::HLine);
    marker->setLinePen(color, 1.0, Qt::DashLine);
    marker->setYValue(limit);
    marker->setZ(limitDepth);
    m_plot->attach(marker.get(), curve->axis);
    curve->limits.push_back(std::move(marker));
}

void PlotCurves::select(int place, const QPlcTheme &theme)
{
    m_selected = place;
    for (int i = 0; i < size(); ++i) {
        StoreCurve *item = m_curves[std::size_t(i)].item.get();
        if (!item)
            continue;
        item->setLineWidth(theme.curveWidth + (i == place ? boldness : 0.0));
        item->setZ(i == place ? 30.0 : 20.0);
    }
}

void PlotCurves::setOrigin(QPlcPast::Time origin)
{
    if (origin == m_origin)
        return;
    m_origin = origin;
    for (const PlotCurve &curve : m_curves) {
        if (curve.item)
            curve.item->setOrigin(origin - curve.run.shift);
        if (curve.bands)
            curve.bands->setOrigin(origin);
    }
}

bool PlotCurves::hasAxis(int axis) const
{
    return std::any_of(m_curves.begin(), m_curves.end(), [axis](const PlotCurve &each) {
        return each.axis == axis && each.settings.isVisible && !each.isDrawnAsBands();
    });
}

double PlotCurves::largest(int axis) const
{
    return m_plot->largest(axis);
}

int PlotCurves::seenAxes() const
{
    int seen = 0;
    for (int axis = 0; axis < m_axes.count(); ++axis)
        seen += hasAxis(axis) ? 1 : 0;
    return seen;
}

QVector<QColor> PlotCurves::colors(int axis) const
{
    QVector<QColor> colors;
    for (const PlotCurve &curve : m_curves) {
        if (curve.axis == axis && curve.isLine() && !curve.isFurther && !colors.contains(curve.color))
            colors.append(curve.color);
    }
    return colors;
}

bool PlotCurves::hasBands() const
{
    return std::any_of(m_curves.begin(), m_curves.end(), [](const PlotCurve &each) { return each.bands != nullptr; });
}

double PlotCurves::laneHeight() const
{
    const bool hasLines
        = std::any_of(m_curves.begin(), m_curves.end(), [](const PlotCurve &each) { return each.isLine(); });
    double height = 0.0;
    for (const PlotCurve &curve : m_curves)
        height += hasLines && curve.bands ? curve.bands->lineHeight() : 0.0;
    return height > 0.0 ? height + laneMargin : 0.0;
}

bool PlotCurves::isWhole(int axis) const
{
    const auto isOther = [axis](const PlotCurve &each) {
        const bool isOfAxis = each.axis == axis && each.isLine();
        return isOfAxis && !(each.source.isStepped && !each.settings.isScaled());
    };
    return hasAxis(axis) && std::none_of(m_curves.begin(), m_curves.end(), isOther);
}

QPlcValueNames PlotCurves::names(int axis) const
{
    std::optional<QPlcValueNames> common;
    for (const PlotCurve &curve : m_curves) {
        if (!curve.isLine() || curve.axis != axis)
            continue;
        if (common && *common != curve.names())
            return {};
        common = curve.names();
    }
    return common.value_or(QPlcValueNames());
}

QPlcPast::Range PlotCurves::range(int axis, double begin, double end) const
{
    QPlcPast::Range all = QPlcPast::Range::empty();
    for (const PlotCurve &curve : m_curves) {
        if (!curve.isLine() || curve.axis != axis)
            continue;
        const auto [minimum, maximum] = curve.item->valueRange(begin, end);
        all = all.united({double(minimum), double(maximum)});
    }
    for (const double line : m_lineValues[std::size_t(axis)])
        all = all.united({line, line});
    return all;
}

QPlcPast::Time PlotCurves::newestTime() const
{
    QPlcPast::Time newest = 0;
    for (const PlotCurve &curve : m_curves)
        newest = std::max(newest, curve.isSeen() && !curve.isFurther ? curve.source.newestTime() : 0);
    return newest;
}

bool PlotCurves::timeRange(QPlcPast::Time *begin, QPlcPast::Time *end) const
{
    bool isFound = false;
    for (const PlotCurve &curve : m_curves) {
        const QPlcPast &past = curve.source;
        if (!curve.isSeen() || past.isEmpty())
            continue;
        const QPlcPast::Time shift = curve.run.shift;
        const QPlcPast::Time first = std::max(past.time(past.firstRow()), curve.run.begin) + shift;
        const QPlcPast::Time last = std::min(past.time(past.endRow() - 1), curve.run.end) + shift;
        *begin = isFound ? std::min(*begin, first) : first;
        *end = isFound ? std::max(*end, last) : last;
        isFound = true;
    }
    return isFound;
}

}  // namespace qplc
