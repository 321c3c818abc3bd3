// SPDX-License-Identifier: Apache-2.0
#include "QPlcTimePlot.h"

#include "PlotPicture.h"
#include "PlotSettingsEditor.h"
#include "QPlcTimePlotPrivate.h"
#include "gui/panel/SignalDropArea.h"

#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

constexpr int mostElements = 16;   // of an array that becomes curves
constexpr int numberPeriod = 100;  // [ms]

}  // namespace

QPlcTimePlot::Private::Private(QPlcTimePlot *plot)
    : ChartPanel(plot, [this] { return std::make_unique<PlotPicture>(canvas, overlay, legend); })
    , q(plot)
    , triggerBar(new TriggerBar(context(), plot))
    , runBar(new RunBar(context(), plot))
    , canvas(new PlotCanvas(plot))
    , overlay(new PlotOverlay(canvas->canvas()))
    , interaction(new PlotInteraction(canvas, this))
    , liveButton(new QToolButton(canvas->canvas()))
    , legendArea(new QScrollArea(plot))
    , legend(new PlotLegend)
    , statistics(new StatisticsView(plot))
    , eventFiles(new EventFiles(this))
    , curves(canvas)
    , ranges(canvas, &curves)
    , time(context(), &settings, triggerBar, canvas, &curves, interaction)
{
    legendArea->setWidget(legend);
    legendArea->setWidgetResizable(true);
    legendArea->setFrameShape(QFrame::NoFrame);
    legendArea->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    legendArea->setFocusPolicy(Qt::NoFocus);
    statistics->hide();
    triggerBar->hide();
    runBar->hide();
    triggerBar->setOwnTime(time.own());
    auto *column = new QVBoxLayout(plot);
    column->setContentsMargins(2, 4, 2, 2);
    column->setSpacing(0);
    column->addWidget(triggerBar);
    column->addWidget(runBar);
    column->addWidget(canvas, 1);
    column->addWidget(legendArea);
    column->addWidget(statistics);
    canvas->setAccessibleName(QPlcTimePlot::tr("Curves over time"));
    setTickPeriod(numberPeriod);
    connect(time.own(), &QPlcTimeAxis::viewChanged, this, [this] { schedule(); });
    connect(canvas, &PlotCanvas::resized, this, &Private::change);
    makeActions();
    new SignalDropArea(
        QPlcTimePlot::tr("Right axis"), [this] { return rightAxisArea(); },
        [this](const QStringList &references) { return addToRightAxis(references); }, plot);
    connectInteraction();
    connectTrigger();
    connectRuns();
}

QPlcTimePlot::QPlcTimePlot(QWidget *parent)
    : QPlcWidget(parent)
    , d(std::make_unique<Private>(this))
{
    setAccessibleName(tr("Time plot"));
    d->showLook();
}

QPlcTimePlot::~QPlcTimePlot() = default;

QJsonObject QPlcTimePlot::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcTimePlot::applySettings(const QJsonObject &settings)
{
    PanelSettings own = PlotSettings::emptyJson();
    QPlcWidget::applySettings(own.take(settings));
    d->applySettings(PlotSettings::fromJson(own.toJson()));
}

QStringList QPlcTimePlot::shownSignals() const
{
    QStringList names;
    for (const PlotCurveSettings &curve : d->settings.curves)
        names << curve.signal;
    return names;
}

QWidget *QPlcTimePlot::createSettingsEditor()
{
    auto *editor = new PlotSettingsEditor(d->settings, d->furtherUnits(), context());
    connect(editor, &PlotSettingsEditor::edited, d.get(), &Private::edit);
    return editor;
}

bool QPlcTimePlot::addSignals(const QStringList &references)
{
    return d->addCurves(d->elementsOf(references));
}

int QPlcTimePlot::drawnPictures() const
{
    return d->drawnPictures;
}

void QPlcTimePlot::Private::bind()
{
    findRuns();
    curves.bind(settings, *context(), runs.all());
    furtherRows = curves.endOfFurtherRows();
    showRunState();
    curves.setOrigin(canvas->origin());
    statistics->reset();
    redraw.assign(std::max<std::size_t>(1, curves.pasts().size()), RedrawRule());
    canvas->setGridVisible(settings.hasGrid && !curves.isEmpty());
    canvas->enableAxis(QwtPlot::xBottom, !curves.isEmpty());
    ranges.bind();
    const int seenAxes = curves.seenAxes();
    for (Axis axis = 0; axis < canvas->axisCount(); ++axis) {
        const bool isDefault = axis == 0 && seenAxes == 0;
        canvas->setAxisVisible(axis, !curves.isEmpty() && (isDefault || curves.hasAxis(axis)));
        canvas->setUnit(axis, curves.axes().at(axis).unit, seenAxes > 1 ? curves.colors(axis) : QVector<QColor>());
        canvas->setNames(axis, curves.names(axis));
        canvas->setNumbersVisible(axis, curves.hasAxis(axis) || !curves.hasBands());
    }
    legend->show(curves, std::nullopt);
    q->setDefaultTitle(settings.contentText());
    removeAction->setEnabled(!curves.isEmpty());
    toggleAction->setEnabled(!curves.isEmpty());
    showChecks();
    arrange();
    change();
}

QStringList QPlcTimePlot::Private::furtherUnits() const
{
    QStringList units;
    for (Axis axis = 2; axis < curves.axes().count(); ++axis)
        units << curves.axes().at(axis).unit;
    units.removeDuplicates();
    return units;
}

void QPlcTimePlot::Private::applySettings(const PlotSettings &wanted)
{
    if (wanted.span != settings.span || wanted.hasOwnTime != settings.hasOwnTime
        || wanted.hasTrigger() != settings.hasTrigger() || wanted.runs != settings.runs)
        time.own()->setSpan(Time(wanted.span * 1e9));
    if (wanted.runs != settings.runs)
        shownZero.reset();
    settings = wanted;
    ranges.reset();
    statistics->setUnfolded(settings.hasStatistics);
    showTrigger();
    showRuns();
    bind();
}

void QPlcTimePlot::Private::edit(const PlotSettings &wanted)
{
    applySettings(wanted);
    Q_EMIT q->settingsEdited();
}

/// The signals themselves; of an array all elements; of what cannot be drawn nothing. What is not
/// there now may be something later.
QStringList QPlcTimePlot::Private::elementsOf(const QStringList &references) const
{
    QStringList elements;
    for (const QString &name : references) {
        const QPlcPanelContext::Signal signal = context()->signal(name);
        const QPlcSignalType type = signal.definition.type;
        const bool isNumber = type.isNumeric() && (!type.isArray() || signal.element >= 0);
        if (!signal || isNumber)
            elements << name;
        for (int i = 0; signal && type.isNumeric() && !isNumber && i < std::min(type.count(), mostElements); ++i)
            elements << QStringLiteral("%1[%2]").arg(name).arg(i);
    }
    return elements;
}

bool QPlcTimePlot::Private::addCurves(const QStringList &signalNames)
{
    PlotSettings wanted = settings;
    int last = -1;
    for (const QString &name : signalNames)
        last = name.trimmed().isEmpty() ? last : wanted.add(name);
    if (wanted.curves.size() > settings.curves.size()) {
        ranges.release();  // what is added is to be seen
        edit(wanted);
    }
    if (last >= 0)
        select(last);
    return last >= 0;
}

void QPlcTimePlot::Private::removeCurve(int place)
{
    if (place < 0 || place >= settings.curves.size())
        return;
    PlotSettings wanted = settings;
    wanted.curves.removeAt(place);
    edit(wanted);
}

void QPlcTimePlot::Private::toggleCurve(int place)
{
    const bool isRun = place >= settings.curves.size() || (settings.curves.size() == 1 && curves.hasRuns());
    if (isRun && place >= 0 && place < curves.size()) {
        toggleRun(curves.at(place).run.name);
        select(place);
        return;
    }
    if (place < 0 || place >= settings.curves.size())
        return;
    PlotSettings wanted = settings;
    wanted.curves[place].isVisible = !wanted.curves[place].isVisible;
    edit(wanted);
    select(place);
}

void QPlcTimePlot::Private::select(int place)
{
    curves.select(place, context()->theme());
    showChecks();
    change();
    showNumbers();
}

void QPlcTimePlot::Private::change()
{
    ++version;
    schedule();
}
