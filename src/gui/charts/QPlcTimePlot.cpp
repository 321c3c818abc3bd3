// SPDX-License-Identifier: Apache-2.0
#include "QPlcTimePlot.h"

#include "PlotPicture.h"
#include "PlotSettingsEditor.h"
#include "QPlcTimePlotPrivate.h"
#include "gui/panel/SignalDropArea.h"

#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

namespace {

constexpr int mostElements = 16;   // of an array that becomes curves
constexpr int numberPeriod = 100;  // [ms]

}  // namespace

QPlcTimePlot::Private::Private(QPlcTimePlot *plot)
    : q(plot)
    , triggerBar(new TriggerBar(plot))
    , canvas(new PlotCanvas(plot))
    , overlay(new PlotOverlay(canvas->canvas()))
    , interaction(new PlotInteraction(canvas, this))
    , liveButton(new QToolButton(canvas->canvas()))
    , legendArea(new QScrollArea(plot))
    , legend(new PlotLegend)
    , statistics(new StatisticsView(plot))
    , exporter(new ChartExport(plot, [this] { return std::make_unique<PlotPicture>(canvas, overlay, legend); }))
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
    drawTimer.setSingleShot(true);
    drawTimer.setTimerType(Qt::PreciseTimer);  // others come up to 5 % early
    numberTimer.setInterval(numberPeriod);
    clock.start();
    connect(&drawTimer, &QTimer::timeout, this, &Private::draw);
    connect(&numberTimer, &QTimer::timeout, this, &Private::showNumbers);
    connect(&ownTime, &TimeView::viewChanged, this, &Private::schedule);
    connect(triggerBar, &TriggerBar::triggered, this, &Private::schedule);
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
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Time plot"));
    connect(this, &QPlcWidget::pinnedPlantChanged, this, [this] {
        d->triggerBar->setPin(pinnedPlant());
        d->bind();
    });
    d->showTheme();
}

QPlcTimePlot::~QPlcTimePlot() = default;

QJsonObject QPlcTimePlot::settings() const
{
    return settingsWith(d->settings.toJson());
}

void QPlcTimePlot::applySettings(const QJsonObject &settings)
{
    QJsonObject others;
    for (auto entry = settings.begin(); entry != settings.end(); ++entry) {
        if (!PlotSettings::isKnown(entry.key()))
            others.insert(entry.key(), entry.value());
    }
    QPlcWidget::applySettings(others);
    d->applySettings(PlotSettings::fromJson(settings));
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
    const Theme theme = windowContext() ? windowContext()->theme() : Theme::byName(Theme::System);
    auto *editor = new PlotSettingsEditor(d->settings, d->furtherUnits(),
                                          windowContext() ? windowContext()->plants() : nullptr, theme);
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

void QPlcTimePlot::contextChanged()
{
    d->followContext();
}

void QPlcTimePlot::showEvent(QShowEvent *event)
{
    QPlcWidget::showEvent(event);
    d->numberTimer.start();
    d->arrange();
    d->showNumbers();
    d->schedule();
}

void QPlcTimePlot::hideEvent(QHideEvent *event)
{
    QPlcWidget::hideEvent(event);
    d->numberTimer.stop();
    d->drawTimer.stop();
}

void QPlcTimePlot::resizeEvent(QResizeEvent *event)
{
    QPlcWidget::resizeEvent(event);
    d->arrange();
}

void QPlcTimePlot::contextMenuEvent(QContextMenuEvent *event)
{
    QMenu *menu = d->createMenu(d->curves.selected(), std::nullopt);
    menu->popup(event->globalPos());
    event->accept();
}

void QPlcTimePlot::keyPressEvent(QKeyEvent *event)
{
    if (event->key() != Qt::Key_Escape || !d->exporter->dismiss())
        QPlcWidget::keyPressEvent(event);
}

void QPlcTimePlot::changeEvent(QEvent *event)
{
    QPlcWidget::changeEvent(event);
    const bool isOther = event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange;
    if (isOther && d && !windowContext())
        d->showTheme();
}

void QPlcTimePlot::Private::followContext()
{
    WindowContext *context = q->windowContext();
    if (!context)
        return;
    TimeView *time = context->timeView();
    connect(context, &WindowContext::valuesChanged, this, [this] {
        ownTime.setNewest(newest());
        schedule();
    });
    for (const auto changed : {&TimeView::viewChanged, &TimeView::cursorsChanged, &TimeView::pointerChanged})
        connect(time, changed, this, &Private::schedule);
    connect(context->curveSources(), &CurveSources::changed, this, [this] {
        exporter->cancel(QPlcTimePlot::tr("The signals have changed while they were exported. Export them again."));
        eventFiles->cancel(QPlcTimePlot::tr("The signals have changed while an event was saved."));
        bind();
    });
    connect(context->curveSources(), &CurveSources::filled, this, [this] {
        ++version;
        schedule();
    });
    connect(context, &WindowContext::themeChanged, this, &Private::showTheme);
    ownTime.setNewest(newest());
    triggerBar->setContext(context);
    showTheme();
}

void QPlcTimePlot::Private::bind()
{
    WindowContext *context = q->windowContext();
    curves.bind(settings, context ? context->curveSources() : nullptr, q->pinnedPlant(),
                context ? context->theme() : Theme::byName(Theme::System));
    curves.setOrigin(canvas->origin());
    statistics->reset();
    redraw.assign(std::max<std::size_t>(1, curves.stores().size()), RedrawRule());
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

/// The signal itself; of an array all elements; of what cannot be drawn nothing. What is not there now may be something later.
QStringList QPlcTimePlot::Private::elementsOf(const QString &name) const
{
    const SignalReference parsed = SignalReference::fromString(name);
    const bool isKnown = q->windowContext() && parsed.isValid();
    const PlantList::Signal signal
        = isKnown ? q->windowContext()->plants()->resolve(parsed, q->pinnedPlant()) : PlantList::Signal();
    if (!signal)
        return {name};
    const QPlcSignalType type = signal.definition().type;
    if (!type.isNumeric())
        return {};
    if (!type.isArray() || parsed.element != SignalReference::Whole)
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
    curves.select(place, q->windowContext() ? q->windowContext()->theme() : Theme::byName(Theme::System));
    ++version;
    showChecks();
    schedule();
    showNumbers();
}
