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
    , canvas(new PlotCanvas(plot))
    , overlay(new PlotOverlay(canvas->canvas()))
    , interaction(new PlotInteraction(canvas, this))
    , liveButton(new QToolButton(canvas->canvas()))
    , legendArea(new QScrollArea(plot))
    , legend(new PlotLegend)
    , statistics(new StatisticsView(plot))
    , eventFiles(new EventFiles(this))
    , curves(canvas)
{
    legendArea->setWidget(legend);
    legendArea->setWidgetResizable(true);
    legendArea->setFrameShape(QFrame::NoFrame);
    legendArea->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    legendArea->setFocusPolicy(Qt::NoFocus);
    statistics->hide();
    triggerBar->hide();
    triggerBar->setOwnTime(&ownTime);
    auto *column = new QVBoxLayout(plot);
    column->setContentsMargins(2, 4, 2, 2);
    column->setSpacing(0);
    column->addWidget(triggerBar);
    column->addWidget(canvas, 1);
    column->addWidget(legendArea);
    column->addWidget(statistics);
    canvas->setAccessibleName(QPlcTimePlot::tr("Curves over time"));
    setTickPeriod(numberPeriod);
    clock.start();
    connect(&ownTime, &QPlcTimeAxis::viewChanged, this, [this] { schedule(); });
    connect(triggerBar, &TriggerBar::triggered, this, [this] { schedule(); });
    connect(triggerBar, &TriggerBar::settingsEdited, this, [this] {
        takeTrigger();
        Q_EMIT q->settingsEdited();
    });
    connect(canvas, &PlotCanvas::resized, this, [this] {
        ++version;
        schedule();
    });
    makeActions();
    new SignalDropArea(
        QPlcTimePlot::tr("Right axis"), [this] { return rightAxisArea(); },
        [this](const QStringList &references) { return addToRightAxis(references); }, plot);
    connectInteraction();
    connectEventFiles();
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
    QStringList names;
    for (const QString &reference : references)
        names << d->elementsOf(reference);
    return d->addCurves(names);
}

int QPlcTimePlot::drawnPictures() const
{
    return d->drawnPictures;
}

void QPlcTimePlot::Private::takeValues()
{
    ownTime.setNewest(newest());
    schedule();
}

void QPlcTimePlot::Private::takePast()
{
    ++version;
    schedule();
}

void QPlcTimePlot::Private::bind()
{
    curves.bind(settings, *context());
    curves.setOrigin(canvas->origin());
    statistics->reset();
    redraw.assign(std::max<std::size_t>(1, curves.pasts().size()), RedrawRule());
    canvas->setGridVisible(settings.hasGrid && !curves.isEmpty());
    canvas->enableAxis(QwtPlot::xBottom, !curves.isEmpty());
    keepRanges();
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
    ++version;
    arrange();
    schedule();
}

/// An axis that is another one than before has another range.
void QPlcTimePlot::Private::keepRanges()
{
    axes.resize(std::size_t(curves.axes().count()));
    for (Axis axis = 0; axis < curves.axes().count(); ++axis) {
        ValueAxis &values = axes[std::size_t(axis)];
        if (values.of == curves.axes().at(axis))
            continue;
        values = ValueAxis();
        values.of = curves.axes().at(axis);
    }
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
        || wanted.hasTrigger() != settings.hasTrigger())
        ownTime.setSpan(Time(wanted.span * 1e9));
    settings = wanted;
    for (ValueAxis &axis : axes)
        axis.automatic.reset();
    statistics->setUnfolded(settings.hasStatistics);
    showTrigger();
    bind();
}

void QPlcTimePlot::Private::edit(const PlotSettings &wanted)
{
    applySettings(wanted);
    Q_EMIT q->settingsEdited();
}

/// The signal itself; of an array all elements; of what cannot be drawn nothing. What is not there
/// now may be something later.
QStringList QPlcTimePlot::Private::elementsOf(const QString &name) const
{
    const QPlcPanelContext::Signal signal = context()->signal(name);
    const QPlcSignalType type = signal.definition.type;
    if (!signal)
        return {name};
    if (!type.isNumeric())
        return {};
    if (!type.isArray() || signal.element >= 0)
        return {name};
    QStringList elements;
    for (int i = 0; i < std::min(type.count(), mostElements); ++i)
        elements << QStringLiteral("%1[%2]").arg(name).arg(i);
    return elements;
}

bool QPlcTimePlot::Private::addCurves(const QStringList &signalNames)
{
    PlotSettings wanted = settings;
    int last = -1;
    for (const QString &name : signalNames) {
        if (name.trimmed().isEmpty())
            continue;
        last = wanted.indexOf(name);
        if (last >= 0)
            continue;
        PlotCurveSettings curve;
        curve.signal = name;
        wanted.curves.append(curve);
        last = wanted.curves.size() - 1;
    }
    if (wanted.curves.size() > settings.curves.size()) {
        for (ValueAxis &axis : axes)  // what is added is to be seen
            axis.isHeld = false;
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
    ++version;
    showChecks();
    schedule();
    showNumbers();
}
