// SPDX-License-Identifier: Apache-2.0
// What a person can do with a time plot, by mouse, keys and menu.
#include "ChartAction.h"
#include "QPlcTimePlotPrivate.h"
#include "gui/panel/SignalEdit.h"

#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

using namespace qplc;

namespace {

constexpr double zoomOfKey = 0.7;     // what a key leaves
constexpr double panOfKey = 0.15;     // of the view
constexpr double reachOfRow = 4.0;    // [px]: so far a cursor goes to a row
constexpr double firstCursor = 0.35;  // places of cursors without a mouse, of the view
constexpr double secondCursor = 0.65;

}  // namespace

void QPlcTimePlot::Private::makeActions()
{
    const auto key = [](int code) { return QKeySequence(code); };
    const auto make = [this](const QString &text, const QList<QKeySequence> &keys, const char *name,
                             std::function<void()> act) { return addChartAction(q, text, keys, name, std::move(act)); };
    const auto pan = [this](double share) {
        return [this, share] { panTime(Time(std::llround(share * double(view()->span())))); };
    };
    const auto panUp = [this](double share) {
        return [this, share] {
            for (Axis axis = 0; axis < curves.axes().count(); ++axis)
                panValues(axis, share * canvas->canvas()->height());
        };
    };
    const auto zoomUp = [this](double factor) {
        return [this, factor] {
            for (Axis axis = 0; axis < curves.axes().count(); ++axis)
                zoomValues(axis, factor, 0.5 * canvas->canvas()->height());
        };
    };
    addAction = make(QPlcTimePlot::tr("Add signal..."), {key(Qt::Key_Insert)}, "add", [this] { openAddBar(); });
    removeAction = make(QPlcTimePlot::tr("Remove curve"), {key(Qt::Key_Delete)}, "remove",
                        [this] { removeCurve(curves.selected()); });
    toggleAction = make(QPlcTimePlot::tr("Hide or show curve"), {key(Qt::Key_V)}, "toggle",
                        [this] { toggleCurve(curves.selected()); });
    const auto choose = [this](int step) {
        return [this, step] {
            const int count = curves.size();
            if (count > 0)
                select(curves.selected() < 0 ? (step > 0 ? 0 : count - 1) : (curves.selected() + step + count) % count);
        };
    };
    make(QPlcTimePlot::tr("Next curve"), {key(Qt::Key_N)}, "next", choose(1));
    make(QPlcTimePlot::tr("Previous curve"), {key(int(Qt::SHIFT) | Qt::Key_N)}, "previous", choose(-1));
    make(QPlcTimePlot::tr("Show all"), {key(Qt::Key_A)}, "all", [this] { showAll(); });
    make(QPlcTimePlot::tr("Live"), {key(Qt::Key_L)}, "live", [this] { view()->goLive(); });
    make(QPlcTimePlot::tr("Freeze or go live"), {key(Qt::Key_Space)}, "freeze", [this] { toggleLive(); });
    make(QPlcTimePlot::tr("Zoom in"), {key(Qt::Key_Plus), key(Qt::Key_Equal)}, "zoomIn",
         [this] { curves.isEmpty() ? openAddBar() : zoomTime(zoomOfKey); });
    make(QPlcTimePlot::tr("Zoom out"), {key(Qt::Key_Minus)}, "zoomOut", [this] { zoomTime(1.0 / zoomOfKey); });
    make(QPlcTimePlot::tr("Zoom values in"), {key(int(Qt::CTRL) | Qt::Key_Plus), key(int(Qt::CTRL) | Qt::Key_Equal)},
         "zoomValuesIn", zoomUp(zoomOfKey));
    make(QPlcTimePlot::tr("Zoom values out"), {key(int(Qt::CTRL) | Qt::Key_Minus)}, "zoomValuesOut",
         zoomUp(1.0 / zoomOfKey));
    make(QPlcTimePlot::tr("Earlier"), {key(Qt::Key_Left)}, "earlier", pan(-panOfKey));
    make(QPlcTimePlot::tr("Later"), {key(Qt::Key_Right)}, "later", pan(panOfKey));
    make(QPlcTimePlot::tr("Larger values"), {key(Qt::Key_Up)}, "larger", panUp(panOfKey));
    make(QPlcTimePlot::tr("Smaller values"), {key(Qt::Key_Down)}, "smaller", panUp(-panOfKey));
    make(QPlcTimePlot::tr("Cursor A"), {key(Qt::Key_1)}, "cursorA", [this] { placeCursor(QPlcTimeAxis::A); });
    make(QPlcTimePlot::tr("Cursor B"), {key(Qt::Key_2)}, "cursorB", [this] { placeCursor(QPlcTimeAxis::B); });
    make(QPlcTimePlot::tr("Remove cursors"), {key(Qt::Key_0)}, "removeCursors", [this] { removeCursors(); });
    make(QPlcTimePlot::tr("Cursor to the left"), {key(int(Qt::CTRL) | Qt::Key_Left)}, "cursorLeft",
         [this] { moveCursor(-1); });
    make(QPlcTimePlot::tr("Cursor to the right"), {key(int(Qt::CTRL) | Qt::Key_Right)}, "cursorRight",
         [this] { moveCursor(1); });
    statisticsAction = make(QPlcTimePlot::tr("Statistics between the cursors"), {key(Qt::Key_S)}, "statistics", [this] {
        PlotSettings wanted = settings;
        wanted.hasStatistics = !wanted.hasStatistics;
        edit(wanted);
    });
    make(QPlcTimePlot::tr("Reference line"), {key(Qt::Key_R)}, "addLine", [this] { addLine(); });
    make(QPlcTimePlot::tr("Remove reference lines"), {key(int(Qt::SHIFT) | Qt::Key_R)}, "removeLines",
         [this] { removeLines(); });
    bandsAction = make(QPlcTimePlot::tr("Show as state bands"), {key(Qt::Key_B)}, "bands", [this] { toggleBands(); });
    bandsAction->setCheckable(true);
    limitsAction = make(QPlcTimePlot::tr("Limits"), {key(Qt::Key_M)}, "limits", [this] { toggleLimits(); });
    limitsAction->setCheckable(true);
    rightAxisAction
        = make(QPlcTimePlot::tr("Right axis"), {key(Qt::Key_Y)}, "rightAxis", [this] { toggleRightAxis(); });
    rightAxisAction->setCheckable(true);
    triggerAction = make(QPlcTimePlot::tr("Trigger"), {key(Qt::Key_T)}, "trigger", [this] { toggleTrigger(); });
    triggerAction->setCheckable(true);
    makeExportActions();
}

void QPlcTimePlot::Private::connectInteraction()
{
    liveButton->hide();
    liveButton->setFocusPolicy(Qt::NoFocus);
    liveButton->setCursor(Qt::ArrowCursor);
    liveButton->setToolTip(QPlcTimePlot::tr("Back to the newest values (L)"));
    liveButton->setAccessibleName(QPlcTimePlot::tr("Live"));
    connect(liveButton, &QToolButton::clicked, this, [this] { view()->goLive(); });
    connect(interaction, &PlotInteraction::pressed, q, [this] { q->setFocus(Qt::MouseFocusReason); });
    connect(interaction, &PlotInteraction::zoomTime, this,
            [this](double factor, qint64 about) { zoomTime(factor, about); });
    connect(interaction, &PlotInteraction::panTime, this, &Private::panTime);
    connect(interaction, &PlotInteraction::zoomValues, this, &Private::zoomValues);
    connect(interaction, &PlotInteraction::panValues, this, &Private::panValues);
    connect(interaction, &PlotInteraction::boxChanged, this, [this](const QRect &next) {
        box = next;
        schedule();
    });
    connect(interaction, &PlotInteraction::boxChosen, this, &Private::showBox);
    connect(interaction, &PlotInteraction::allWanted, this, &Private::showAll);
    connect(interaction, &PlotInteraction::cursorDragged, this, [this](PlotInteraction::Cursor cursor, double x) {
        placeCursor(cursor == PlotInteraction::CursorA ? QPlcTimeAxis::A : QPlcTimeAxis::B, canvas->timeAt(x));
    });
    connect(interaction, &PlotInteraction::mouseMoved, this, [this] {
        const std::optional<QPoint> mouse = interaction->mouse();
        shared()->setPointer(mouse ? std::optional<Time>(canvas->timeAt(mouse->x())) : std::nullopt);
    });
    connect(interaction, &PlotInteraction::menuWanted, this, [this](const QPoint &position, const QPoint &global) {
        menuOf(curves.selected(), position)->popup(global);
    });
    connect(legend, &PlotLegend::clicked, this, [this](int place) {
        q->setFocus(Qt::MouseFocusReason);
        toggleCurve(place);
    });
    connect(legend, &PlotLegend::menuWanted, this, [this](int place, const QPoint &global) {
        select(place);
        menuOf(place, std::nullopt)->popup(global);
    });
    connect(statistics, &StatisticsView::unfoldedChanged, this, [this] { statisticsAction->trigger(); });
}

/// \param mouse  over the canvas [px]
QMenu *QPlcTimePlot::Private::menuOf(int curve, std::optional<QPoint> mouse)
{
    QMenu *menu = makeMenu({});
    addTo(menu, {"add"});
    if (curve >= 0 && curve < curves.size()) {
        menu->addSection(curves.at(curve).settings.text());
        addTo(menu, {"toggle", "remove", "rightAxis"});
        if (curves.at(curve).canBeBands())
            addTo(menu, {"bands"});
    }
    menu->addSeparator();
    if (mouse) {
        const Time time = canvas->timeAt(mouse->x());
        const auto here = [&](const QString &text, QPlcTimeAxis::Cursor which, const QString &keys) {
            QAction *action = menu->addAction(text, this, [this, which, time] { placeCursor(which, time); });
            action->setShortcut(keys);
        };
        here(QPlcTimePlot::tr("Cursor A here"), QPlcTimeAxis::A, QStringLiteral("1"));
        here(QPlcTimePlot::tr("Cursor B here"), QPlcTimeAxis::B, QStringLiteral("2"));
    } else {
        addTo(menu, {"cursorA", "cursorB"});
    }
    addTo(menu, {"removeCursors", "statistics"});
    menu->addSeparator();
    addTo(menu, {"limits", "addLine"});
    if (hasLines())
        addTo(menu, {"removeLines"});
    menu->addSeparator();
    addTo(menu, {"all", "zoomIn", "zoomOut", "freeze", "live", "trigger"});
    menu->addSeparator();
    addTo(menu, {"saveTable", "copyTable", "savePicture", "copyPicture"});
    if (hasBothCursors())
        addTo(menu, {"saveBetween", "copyBetween"});
    menu->addSeparator();
    addTo(menu, {"panelMenu"});  // of the frame around
    return menu;
}

/// A line above the curves, that goes when a signal was chosen.
void QPlcTimePlot::Private::openAddBar()
{
    if (addBar) {
        addBar->setFocus();
        return;
    }
    auto *edit = new SignalEdit(context(), SignalEdit::Curves, q);
    addBar = edit;
    qobject_cast<QBoxLayout *>(q->layout())->insertWidget(0, edit);
    const auto close = [this] {
        if (!addBar)
            return;
        addBar->hide();
        addBar->deleteLater();
        addBar = nullptr;
        q->setFocus();
    };
    connect(edit, &SignalEdit::left, this, close);
    connect(edit, &SignalEdit::chosen, this, [this, close](const QString &name) {
        addCurves({name});
        close();
    });
    edit->setFocus();
}

void QPlcTimePlot::Private::showAll()
{
    for (ValueAxis &axis : axes) {
        axis.isHeld = false;
        axis.automatic.reset();
    }
    ++version;
    Time begin = 0;
    Time end = 0;
    if (curves.timeRange(&begin, &end)) {
        if (view()->isLive())
            view()->setSpan(newest() - begin);
        else
            view()->show(begin, std::max(end, begin + 1));
    }
    schedule();
}

/// What is seen here, which ends earlier than other plots when its plant has another clock.
void QPlcTimePlot::Private::freezeHere()
{
    if (view()->isLive())
        view()->show(newest() - view()->span(), newest());
}

void QPlcTimePlot::Private::panTime(Time by)
{
    freezeHere();
    view()->pan(by);
}

/// About the mouse, the live edge, or the middle.
void QPlcTimePlot::Private::zoomTime(double factor)
{
    const std::optional<QPoint> mouse = interaction->mouse();
    const QPlcTimeAxis *time = view();
    const Time middle = time->isLive() ? newest() : time->begin() + time->span() / 2;
    zoomTime(factor, mouse ? canvas->timeAt(mouse->x()) : middle);
}

void QPlcTimePlot::Private::zoomTime(double factor, Time about)
{
    const bool staysLive = view()->isLive() && about >= newest();
    if (!staysLive)
        freezeHere();
    view()->zoom(factor, staysLive ? view()->end() : about);
}

void QPlcTimePlot::Private::showBox(const QRect &chosen)
{
    for (Axis axis = 0; axis < curves.axes().count(); ++axis) {
        ValueAxis &values = axes[std::size_t(axis)];
        values.minimum = canvas->valueAt(axis, chosen.bottom() + 1);
        values.maximum = canvas->valueAt(axis, chosen.top());
        values.isHeld = curves.hasAxis(axis) && values.minimum < values.maximum;
    }
    ++version;
    view()->show(canvas->timeAt(chosen.left()), canvas->timeAt(chosen.right() + 1));
    schedule();
}

void QPlcTimePlot::Private::placeCursor(QPlcTimeAxis::Cursor which, std::optional<Time> time)
{
    if (curves.isEmpty())
        return;
    const std::optional<QPoint> mouse = interaction->mouse();
    const double place = (which == QPlcTimeAxis::A ? firstCursor : secondCursor) * canvas->canvas()->width();
    lastCursor = which;
    shared()->setCursor(which, nearestRow(time ? *time : canvas->timeAt(mouse ? mouse->x() : place)));
}

/// A cursor goes to a row that is near enough, for only there values were measured.
QPlcTimePlot::Private::Time QPlcTimePlot::Private::nearestRow(Time time) const
{
    Time nearest = time;
    Time distance = canvas->timeAt(reachOfRow) - canvas->timeAt(0.0);
    for (const QPlcPast &past : curves.pasts()) {
        const QPlcPast::Row next = past.rowAt(time);
        for (QPlcPast::Row row = next > past.firstRow() ? next - 1 : next; row < past.endRow() && row <= next; ++row) {
            if (std::abs(past.time(row) - time) > distance)
                continue;
            nearest = past.time(row);
            distance = std::abs(nearest - time);
        }
    }
    return nearest;
}

void QPlcTimePlot::Private::removeCursors()
{
    shared()->setCursor(QPlcTimeAxis::A, std::nullopt);
    shared()->setCursor(QPlcTimeAxis::B, std::nullopt);
}

void QPlcTimePlot::Private::moveCursor(int pixels)
{
    const std::optional<Time> time = shared()->cursor(lastCursor);
    const Time pixel = canvas->timeAt(1.0) - canvas->timeAt(0.0);
    if (time)
        shared()->setCursor(lastCursor, *time + pixels * pixel);
    else
        placeCursor(lastCursor);
}

const PlotCurve *QPlcTimePlot::Private::chosenCurve() const
{
    const int place = curves.selected() < 0 && curves.size() == 1 ? 0 : curves.selected();
    return place >= 0 && place < curves.size() ? &curves.at(place) : nullptr;
}

void QPlcTimePlot::Private::toggleBands()
{
    const PlotCurve *curve = chosenCurve();
    if (!curve || !curve->canBeBands())
        return;
    PlotSettings wanted = settings;
    PlotCurveSettings &chosen = wanted.curves[wanted.indexOf(curve->settings.signal)];
    chosen.isBands = !chosen.isBands;
    edit(wanted);
}

void QPlcTimePlot::Private::showChecks()
{
    const PlotCurve *curve = chosenCurve();
    bandsAction->setEnabled(curve && curve->canBeBands());
    bandsAction->setChecked(curve && curve->isDrawnAsBands());
    limitsAction->setChecked(settings.showsLimits());
    rightAxisAction->setEnabled(curve && !curve->isDrawnAsBands());
    rightAxisAction->setChecked(curve && curves.axes().at(curve->axis).side == PlotCurveSettings::Right);
}

void QPlcTimePlot::Private::toggleLimits()
{
    PlotSettings wanted = settings;
    wanted.limits = !settings.showsLimits();
    edit(wanted);
}

void QPlcTimePlot::Private::toggleLive()
{
    view()->isLive() ? freezeHere() : view()->goLive();
}

/// Its time axis begins with the span that is seen.
void QPlcTimePlot::Private::toggleTrigger()
{
    PlotSettings wanted = settings;
    wanted.setTriggerOn(!settings.hasTrigger());
    if (!settings.hasOwnTime)
        wanted.span = wanted.hasTrigger() ? double(view()->span()) * 1e-9 : PlotSettings::defaultSpan;
    edit(wanted);
}

void QPlcTimePlot::Private::showTrigger()
{
    QStringList expressions;
    for (const PlotCurveSettings &curve : qAsConst(settings.curves))
        expressions << curve.signal;
    if (!settings.hasTrigger())
        triggerBar->hide();
    if (settings.trigger != shownTrigger)
        triggerBar->applySettings(settings.trigger);
    shownTrigger = settings.trigger;
    if (settings.hasTrigger()) {
        triggerBar->setSignals(expressions);
        triggerBar->show();
    }
    triggerAction->setChecked(settings.hasTrigger());
}

/// What a person has chosen in the bar; keys that nobody knows stay.
void QPlcTimePlot::Private::takeTrigger()
{
    for (const QString &key : TriggerBar::keys())
        settings.trigger.remove(key);
    const QJsonObject chosen = triggerBar->settings();
    for (auto entry = chosen.begin(); entry != chosen.end(); ++entry)
        settings.trigger.insert(entry.key(), entry.value());
    shownTrigger = settings.trigger;
    ++version;
    schedule();
}
