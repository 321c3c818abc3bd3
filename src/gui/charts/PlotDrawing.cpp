// SPDX-License-Identifier: Apache-2.0
// Pictures and numbers of a time plot, and when they are renewed.
#include "QPlcTimePlotPrivate.h"
#include "gui/models/ValueFormat.h"

#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace qplc;

namespace {

constexpr int compactHeight = 160;  // [px] of the panel
constexpr int compactWidth = 300;
constexpr int leastLegendHeight = 100;      // [px] of the panel: below there are curves only
constexpr int leastStatisticsHeight = 220;  // [px] of the panel: below there is one line of statistics
constexpr double legendShare = 0.3;         // of the height of the panel, at most
constexpr double legendShareBesideTable = 0.15;
constexpr double statisticsShare = 0.3;
constexpr int buttonMargin = 4;                 // [px]
constexpr qint64 wholeSeconds = 1'000'000'000;  // [ns]

}  // namespace

void QPlcTimePlot::Private::takeValues()
{
    time.own()->setNewest(time.newest());
    takeRuns();
    schedule();
}

bool QPlcTimePlot::Private::isPictureDue(const TimeColumns &columns)
{
    bool isDue = false;
    for (std::size_t i = 0; i < redraw.size(); ++i) {
        RedrawRule::Picture picture;
        if (i < curves.pasts().size())
            picture = RedrawRule::Picture::of(*PastRows::of(curves.pasts()[i]).store, columns);
        picture.columns = columns;
        picture.settings = version;
        isDue = redraw[i].isDue(picture) || isDue;
    }
    return isDue;
}

void QPlcTimePlot::Private::draw()
{
    const TimeColumns shown = time.columns();
    if (shownEvent() != drawnEvent)
        ++version;
    drawnEvent = shownEvent();
    if (isPictureDue(shown)) {
        if (time.view()->isLive())
            reference = shown.beginOf(shown.end());
        canvas->setTime(shown, settings.labels, reference, drawnEvent);
        curves.setOrigin(canvas->origin());
        ranges.fit();
        ranges.show(settings);
        canvas->replot();
        ++drawnPictures;
        if (!time.view()->isLive())
            pointAtMouse();
    }
    showOverlay();
    showLiveButton();
    // Who moves the playhead wants to read, and does not wait for the next tick.
    constexpr int numbersPause = 33;  // [ms]
    const bool isRested = !sinceMoved.isValid() || sinceMoved.elapsed() >= numbersPause;
    if (isRested && time.shared()->playhead() != numberedPlayhead) {
        sinceMoved.start();
        showNumbers();
    }
}

/// A mouse that rests points at another time when the view moves below it.
void QPlcTimePlot::Private::pointAtMouse()
{
    if (const std::optional<Time> moment = time.atMouse())
        time.shared()->setPointer(moment);
}

void QPlcTimePlot::Private::showOverlay()
{
    PlotOverlay::Picture picture;
    picture.box = box;
    picture.hint = hint();
    const QPlcTimeAxis *shared = time.shared();
    const auto place = [&](std::optional<Time> moment) -> std::optional<int> {
        if (!moment || *moment < canvas->begin() || *moment > canvas->end())
            return std::nullopt;
        return int(std::lround(canvas->xOf(*moment)));
    };
    if (!curves.isEmpty()) {
        picture.cursorA = place(shared->cursor(QPlcTimeAxis::A));
        picture.cursorB = place(shared->cursor(QPlcTimeAxis::B));
        picture.pointer = place(shared->pointer());
        picture.playhead = place(shared->playhead());
    }
    if (picture.pointer && !canvas->isCompact()) {
        const bool isCoarse = (canvas->end() - canvas->begin()) / std::max(canvas->canvas()->width(), 1) >= 1'000'000;
        picture.pointerText = TimeTicks::clockText(*shared->pointer(), isCoarse ? 1'000'000 : 1'000);
    }
    if (const std::optional<int> x = picture.pointer ? picture.pointer : picture.playhead) {
        const Time moment = picture.pointer ? *shared->pointer() : *shared->playhead();
        for (const PlotCurve &curve : curves) {
            const double value = curve.isLine() ? curve.value(moment) : NAN;
            if (!std::isnan(value))
                picture.dots.append({QPointF(*x, canvas->yOf(curve.axis, value)), curve.color});
        }
    }
    picture.notes = shownNotes();
    placeTrigger(&picture);
    interaction->setCursors(picture.cursorA, picture.cursorB);
    overlay->show(picture);
}

/// Of the plants of the curves, not of runs over them.
QVector<PlotOverlay::Note> QPlcTimePlot::Private::shownNotes() const
{
    constexpr int mostNotes = 50;  // in a picture
    QStringList plants;
    for (const PlotCurve &curve : curves) {
        if (curve.source && !curve.isFurther && !plants.contains(curve.source.plant))
            plants << curve.source.plant;
    }
    QVector<PlotOverlay::Note> shown;
    for (const PlotNotes::Note &note : notes.between(canvas->begin(), canvas->end(), plants, mostNotes))
        shown.append({int(std::lround(canvas->xOf(note.time))), note.text});
    return shown;
}

std::optional<QPlcTimePlot::Private::Time> QPlcTimePlot::Private::shownEvent()
{
    if (runs.zero())
        return runs.zero();
    const Trigger &trigger = triggerBar->trigger();
    return settings.hasTrigger() && !time.view()->isLive() && trigger.view() ? trigger.shownEvent() : std::nullopt;
}

void QPlcTimePlot::Private::placeTrigger(PlotOverlay::Picture *picture)
{
    if (!settings.hasTrigger())
        return;
    if (drawnEvent && *drawnEvent >= canvas->begin() && *drawnEvent <= canvas->end())
        picture->event = int(std::lround(canvas->xOf(*drawnEvent)));
    const QString signal = triggerBar->settings().value(QStringLiteral("signal")).toString();
    const auto found = std::find_if(curves.begin(), curves.end(), [&](const PlotCurve &curve) {
        return curve.isLine() && curve.settings.signal == signal;
    });
    if (found == curves.end())
        return;
    for (const double level : triggerBar->trigger().settings().levels()) {
        const double value = found->settings.gain * level + found->settings.offset;
        picture->levels.append({QPointF(0.0, canvas->yOf(found->axis, value)), found->color});
    }
}

/// What to do, or what is missing, where there is nothing to see.
QString QPlcTimePlot::Private::hint() const
{
    if (curves.isEmpty())
        return QPlcTimePlot::tr("Drop signals here or press +");
    QStringList missing;
    for (const PlotCurve &curve : curves) {
        if (!curve.settings.isVisible)
            continue;
        if (!curve.isMissing())
            return hintOfTime();
        missing << curve.settings.signal;
    }
    if (missing.isEmpty())
        return QPlcTimePlot::tr("All curves are hidden: click one in the legend, or press V");
    return QPlcTimePlot::tr("Missing: %1\nDrawn as soon as it is there.").arg(missing.join(QStringLiteral(", ")));
}

/// A frozen view may be beyond all that is kept, or that the clock of the plant has come to.
QString QPlcTimePlot::Private::hintOfTime() const
{
    Time first = 0;
    Time last = 0;
    if (!curves.timeRange(&first, &last) || (canvas->begin() <= last && first <= canvas->end()))
        return {};
    const auto text = [](Time moment) { return TimeTicks::clockText(moment, wholeSeconds); };
    return QPlcTimePlot::tr("No values at this time: they are from %1 to %2.\nA shows them all, L the newest.")
        .arg(text(first), text(last));
}

void QPlcTimePlot::Private::showNumbers()
{
    if (!q->isVisible())
        return;
    const QPlcTimeAxis *shared = time.shared();
    numberedPlayhead = shared->playhead();
    if (time.view()->isLive())
        pointAtMouse();
    std::optional<Time> moment = shared->pointer() ? shared->pointer() : shared->playhead();
    const bool isElsewhere = moment && (*moment < canvas->begin() || *moment > canvas->end());
    if (isElsewhere && time.view()->isLive())
        moment.reset();  // of a plot whose time is another one
    if (!moment && !time.view()->isLive())
        moment = std::clamp(time.newest(), time.view()->begin(),
                            time.view()->end());  // around an event, the rest is still to come
    legend->show(curves, moment);
    arrangeLegend();  // wider values leave room for fewer columns
    const bool hasCursors = (shared->cursor(QPlcTimeAxis::A) || shared->cursor(QPlcTimeAxis::B)) && !curves.isEmpty();
    const bool hasRuns = !runs.all().empty() && !curves.isEmpty();
    if ((hasCursors || hasRuns) != !statistics->isHidden()) {
        statistics->setVisible(hasCursors || hasRuns);
        arrange();
    }
    if (hasCursors)
        statistics->show(curves, shared->cursor(QPlcTimeAxis::A), shared->cursor(QPlcTimeAxis::B));
    else if (hasRuns)
        statistics->showView(curves, canvas->begin(), canvas->end() - 1);
    if (ranges.fit())
        ++version;
    schedule();
}

void QPlcTimePlot::Private::showLiveButton()
{
    const bool isFrozen
        = !time.view()->isLive() && !(settings.hasTrigger() && triggerBar->showsEvent()) && !runs.zero();
    liveButton->setVisible(isFrozen && !curves.isEmpty() && !isFilmed());
    if (!isFrozen)
        return;
    const double behind = std::round(double(time.newest() - time.view()->end()) * 1e-9);
    const QString ago = behind < 120.0 ? QPlcTimePlot::tr("%1 s").arg(behind)
                                       : QPlcTimePlot::tr("%1 min").arg(std::floor(behind / 60.0));
    const QString text = canvas->isCompact() ? QStringLiteral("L")
        : behind < 1.0                       ? QPlcTimePlot::tr("frozen – L")
                                             : QPlcTimePlot::tr("%1 behind – L").arg(ago);
    if (text != liveButton->text())
        liveButton->setText(text);
    liveButton->adjustSize();
    liveButton->move(canvas->canvas()->width() - liveButton->width() - buttonMargin,
                     (canvas->isCompact() ? 0 : overlay->flagHeight()) + buttonMargin);
    liveButton->raise();
}

/// Gives the parts the heights that they need, and leaves the curves the most of it.
void QPlcTimePlot::Private::arrange()
{
    const bool hasLegend = settings.hasLegend && !curves.isEmpty() && q->height() >= leastLegendHeight;
    legendArea->setVisible(hasLegend);
    canvas->setCompact(q->height() < compactHeight || q->width() < compactWidth);
    legendArea->setVerticalScrollBarPolicy(canvas->isCompact() ? Qt::ScrollBarAlwaysOff : Qt::ScrollBarAsNeeded);
    legend->setCompact(canvas->isCompact());
    statistics->setUnfolded(settings.hasStatistics && q->height() >= leastStatisticsHeight);
    statistics->setRoom(int(statisticsShare * q->height()));
    arrangeLegend();
}

void QPlcTimePlot::Private::arrangeLegend()
{
    const bool hasTable = !statistics->isHidden() && statistics->isUnfolded();  // which names the curves, too
    const double share = hasTable ? legendShareBesideTable : legendShare;
    legendArea->setFixedHeight(legend->heightWithin(q->contentsRect().width(), int(share * q->height())));
}

void QPlcTimePlot::Private::showTheme(const QPlcTheme &theme)
{
    canvas->setTheme(theme);
    overlay->setTheme(theme);
    legend->setTheme(theme);
    QPalette button = q->palette();
    button.setColor(QPalette::Button, theme.accent);
    button.setColor(QPalette::ButtonText, theme.surface);
    liveButton->setPalette(button);
    liveButton->setFont(overlay->font());
}
