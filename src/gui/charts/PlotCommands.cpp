// SPDX-License-Identifier: Apache-2.0
// What a person can do with a time plot, by mouse, keys and menu.
#include "QPlcTimePlotPrivate.h"
#include "gui/panel/SignalEdit.h"
#include "gui/plot/TableExport.h"

#include <QtWidgets/QBoxLayout>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

using namespace qplc;

namespace {

constexpr double zoomOfKey = 0.7;         // what a key leaves
constexpr double panOfKey = 0.15;         // of the view
constexpr double firstOfRightAxis = 0.6;  // of the width of the panel: where signals are dropped for the right axis
constexpr double lastOfRightAxis = 0.88;

}  // namespace

void QPlcTimePlot::Private::makeActions()
{
    makeCurveActions();
    makeViewActions();
    makeSettingActions();
    makeExportActions();
}

void QPlcTimePlot::Private::makeCurveActions()
{
    const auto choose = [this](int step) {
        return [this, step] {
            const int count = curves.size();
            if (count > 0)
                select(curves.selected() < 0 ? (step > 0 ? 0 : count - 1) : (curves.selected() + step + count) % count);
        };
    };
    addAction(QPlcTimePlot::tr("Add signal..."), {Qt::Key_Insert}, "add", [this] { openAddBar(); });
    removeAction = addAction(QPlcTimePlot::tr("Remove curve"), {Qt::Key_Delete}, "remove",
                             [this] { removeCurve(curves.selected()); });
    toggleAction = addAction(QPlcTimePlot::tr("Hide or show curve"), {Qt::Key_V}, "toggle",
                             [this] { toggleCurve(curves.selected()); });
    addAction(QPlcTimePlot::tr("Next curve"), {Qt::Key_J}, "next", choose(1));
    addAction(QPlcTimePlot::tr("Previous curve"), {int(Qt::SHIFT) | Qt::Key_J}, "previous", choose(-1));
}

void QPlcTimePlot::Private::makeViewActions()
{
    const auto pan = [this](double share) {
        return [this, share] { time.pan(Time(std::llround(share * double(time.view()->span())))); };
    };
    const auto panUp = [this](double share) {
        return [this, share] {
            for (Axis axis = 0; axis < curves.axes().count(); ++axis)
                ranges.pan(axis, share * canvas->canvas()->height());
            change();
        };
    };
    const auto zoomUp = [this](double factor) {
        return [this, factor] {
            for (Axis axis = 0; axis < curves.axes().count(); ++axis)
                ranges.zoom(axis, factor, 0.5 * canvas->canvas()->height());
            change();
        };
    };
    constexpr int ctrl = int(Qt::CTRL);
    addAction(QPlcTimePlot::tr("Show all"), {Qt::Key_A}, "all", [this] { showAll(); });
    addAction(QPlcTimePlot::tr("Live"), {Qt::Key_L}, "live", [this] { time.view()->goLive(); });
    addAction(QPlcTimePlot::tr("Freeze or go live"), {Qt::Key_Space}, "freeze", [this] { time.toggleLive(); });
    addAction(QPlcTimePlot::tr("Zoom in"), {Qt::Key_Plus, Qt::Key_Equal}, "zoomIn",
              [this] { curves.isEmpty() ? openAddBar() : time.zoom(zoomOfKey); });
    addAction(QPlcTimePlot::tr("Zoom out"), {Qt::Key_Minus}, "zoomOut", [this] { time.zoom(1.0 / zoomOfKey); });
    addAction(QPlcTimePlot::tr("Zoom values in"), {ctrl | Qt::Key_Plus, ctrl | Qt::Key_Equal}, "zoomValuesIn",
              zoomUp(zoomOfKey));
    addAction(QPlcTimePlot::tr("Zoom values out"), {ctrl | Qt::Key_Minus}, "zoomValuesOut", zoomUp(1.0 / zoomOfKey));
    addAction(QPlcTimePlot::tr("Earlier"), {Qt::Key_Left}, "earlier", pan(-panOfKey));
    addAction(QPlcTimePlot::tr("Later"), {Qt::Key_Right}, "later", pan(panOfKey));
    addAction(QPlcTimePlot::tr("Larger values"), {Qt::Key_Up}, "larger", panUp(panOfKey));
    addAction(QPlcTimePlot::tr("Smaller values"), {Qt::Key_Down}, "smaller", panUp(-panOfKey));
    addAction(QPlcTimePlot::tr("Cursor A"), {Qt::Key_1}, "cursorA", [this] { time.placeCursor(QPlcTimeAxis::A); });
    addAction(QPlcTimePlot::tr("Cursor B"), {Qt::Key_2}, "cursorB", [this] { time.placeCursor(QPlcTimeAxis::B); });
    addAction(QPlcTimePlot::tr("Remove cursors"), {Qt::Key_0}, "removeCursors", [this] { time.removeCursors(); });
    addAction(QPlcTimePlot::tr("Cursor to the left"), {ctrl | Qt::Key_Left}, "cursorLeft",
              [this] { time.moveCursor(-1); });
    addAction(QPlcTimePlot::tr("Cursor to the right"), {ctrl | Qt::Key_Right}, "cursorRight",
              [this] { time.moveCursor(1); });
}

void QPlcTimePlot::Private::makeSettingActions()
{
    const auto editing = [this](void (*how)(PlotSettings *)) {
        return [this, how] {
            PlotSettings wanted = settings;
            how(&wanted);
            edit(wanted);
        };
    };
    statisticsAction = addAction(QPlcTimePlot::tr("Statistics between the cursors"), {Qt::Key_S}, "statistics",
                                 editing([](PlotSettings *wanted) { wanted->hasStatistics = !wanted->hasStatistics; }));
    addAction(QPlcTimePlot::tr("Reference line"), {Qt::Key_R}, "addLine", [this] { addLine(); });
    addAction(QPlcTimePlot::tr("Remove reference lines"), {int(Qt::SHIFT) | Qt::Key_R}, "removeLines",
              [this, remove = editing([](PlotSettings *wanted) { wanted->removeLines(); })] {
                  if (settings.hasLines())
                      remove();
              });
    bandsAction = addAction(QPlcTimePlot::tr("Show as state bands"), {Qt::Key_B}, "bands", [this] { toggleBands(); });
    limitsAction = addAction(QPlcTimePlot::tr("Limits"), {Qt::Key_M}, "limits",
                             editing([](PlotSettings *wanted) { wanted->limits = !wanted->showsLimits(); }));
    rightAxisAction
        = addAction(QPlcTimePlot::tr("Right axis"), {Qt::Key_Y}, "rightAxis", [this] { toggleRightAxis(); });
    triggerAction = addAction(QPlcTimePlot::tr("Trigger"), {Qt::Key_T}, "trigger", [this] { toggleTrigger(); });
    runsAction = addAction(QPlcTimePlot::tr("Compare runs"), {Qt::Key_C}, "runs", [this] { toggleRuns(); });
    for (QAction *action : {bandsAction, limitsAction, rightAxisAction, triggerAction, runsAction})
        action->setCheckable(true);
}

void QPlcTimePlot::Private::makeExportActions()
{
    exporter()->addTableActions([this] { return shownTable(); });
    addAction(QPlcTimePlot::tr("Export A ... B as CSV..."), {int(Qt::CTRL | Qt::ALT) | Qt::Key_E}, "saveBetween",
              [this] { exporter()->saveTable(tableBetweenCursors()); });
    addAction(QPlcTimePlot::tr("Copy A ... B as table"), {int(Qt::CTRL | Qt::ALT) | Qt::Key_C}, "copyBetween",
              [this] { exporter()->copyTable(tableBetweenCursors()); });
    exporter()->addPictureActions();
}

void QPlcTimePlot::Private::connectInteraction()
{
    liveButton->hide();
    liveButton->setFocusPolicy(Qt::NoFocus);
    liveButton->setCursor(Qt::ArrowCursor);
    liveButton->setToolTip(QPlcTimePlot::tr("Back to the newest values (L)"));
    liveButton->setAccessibleName(QPlcTimePlot::tr("Live"));
    connect(liveButton, &QToolButton::clicked, this, [this] { time.view()->goLive(); });
    connect(interaction, &PlotInteraction::pressed, q, [this] { q->setFocus(Qt::MouseFocusReason); });
    connect(interaction, &PlotInteraction::zoomTime, this,
            [this](double factor, qint64 about) { time.zoom(factor, about); });
    connect(interaction, &PlotInteraction::panTime, this, [this](qint64 by) { time.pan(by); });
    connect(interaction, &PlotInteraction::zoomValues, this, [this](int axis, double factor, double about) {
        ranges.zoom(axis, factor, about);
        change();
    });
    connect(interaction, &PlotInteraction::panValues, this, [this](int axis, double by) {
        ranges.pan(axis, by);
        change();
    });
    connect(interaction, &PlotInteraction::boxChanged, this, [this](const QRect &next) {
        box = next;
        schedule();
    });
    connect(interaction, &PlotInteraction::boxChosen, this, &Private::showBox);
    connect(interaction, &PlotInteraction::allWanted, this, &Private::showAll);
    connect(interaction, &PlotInteraction::cursorDragged, this, [this](PlotInteraction::Cursor cursor, double x) {
        time.placeCursor(cursor == PlotInteraction::CursorA ? QPlcTimeAxis::A : QPlcTimeAxis::B, canvas->timeAt(x));
    });
    connect(interaction, &PlotInteraction::mouseMoved, this, [this] { time.shared()->setPointer(time.atMouse()); });
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
        const Time moment = canvas->timeAt(mouse->x());
        const auto here = [&](const QString &text, QPlcTimeAxis::Cursor which, const QString &keys) {
            QAction *action = menu->addAction(text, this, [this, which, moment] { time.placeCursor(which, moment); });
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
    if (settings.hasLines())
        addTo(menu, {"removeLines"});
    menu->addSeparator();
    addTo(menu, {"all", "zoomIn", "zoomOut", "freeze", "live", "trigger", "runs"});
    menu->addSeparator();
    addTo(menu, {"saveTable", "copyTable", "savePicture", "copyPicture"});
    if (time.hasBothCursors())
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
    ranges.release();
    ranges.reset();
    time.showAll();
    change();
}

void QPlcTimePlot::Private::showBox(const QRect &chosen)
{
    ranges.zoomTo(chosen);
    time.view()->show(canvas->timeAt(chosen.left()), canvas->timeAt(chosen.right() + 1));
    change();
}

const PlotCurve *QPlcTimePlot::Private::chosenCurve() const
{
    const int place = curves.selected() < 0 && curves.size() == 1 ? 0 : curves.selected();
    return place >= 0 && place < curves.size() ? &curves.at(place) : nullptr;
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

/// At the mouse, or in the middle; a value with as many digits as pixels tell apart.
void QPlcTimePlot::Private::addLine()
{
    if (curves.isEmpty())
        return;
    Axis axis = 0;
    while (axis + 1 < curves.axes().count() && !curves.hasAxis(axis))
        ++axis;
    const double y = interaction->mouse() ? interaction->mouse()->y() : 0.5 * canvas->canvas()->height();
    const double value = canvas->valueAt(axis, y);
    const double pixel = std::abs(canvas->valueAt(axis, y + 1.0) - value);
    const int digits = std::clamp(int(std::ceil(std::log10(std::abs(value) / pixel))), 1, 7);
    PlotSettings wanted = settings;
    QVector<double> &lines = wanted.range(axis, curves.axes().at(axis).unit).lines;
    lines.append(QString::number(value, 'g', digits).toDouble());
    edit(wanted);
}

/// The chosen curve goes to the other side, where its unit has an axis.
void QPlcTimePlot::Private::toggleRightAxis()
{
    const PlotCurve *curve = chosenCurve();
    if (!curve || curve->isDrawnAsBands())
        return;
    const bool isRight = curves.axes().at(curve->axis).side == PlotCurveSettings::Right;
    PlotSettings wanted = settings;
    for (PlotCurveSettings &each : wanted.curves) {
        if (each.signal == curve->settings.signal)
            each.axis = isRight ? PlotCurveSettings::Left : PlotCurveSettings::Right;
    }
    edit(wanted);
}

/// Also curves that are there already.
bool QPlcTimePlot::Private::addToRightAxis(const QStringList &references)
{
    PlotSettings wanted = settings;
    const QStringList names = elementsOf(references);
    for (const QString &name : names)
        wanted.add(name);
    for (PlotCurveSettings &each : wanted.curves) {
        if (names.contains(each.signal))
            each.axis = PlotCurveSettings::Right;
    }
    if (names.isEmpty())
        return false;
    edit(wanted);
    select(wanted.indexOf(names.last()));
    return true;
}

/// Where signals are dropped that are to have an axis at the right [px of the panel]; null: where
/// there is nothing else, they have the left one.
QRect QPlcTimePlot::Private::rightAxisArea() const
{
    if (curves.isEmpty())
        return {};
    const QRect middle(int(firstOfRightAxis * q->width()), q->height() / 4,
                       int((lastOfRightAxis - firstOfRightAxis) * q->width()), q->height() / 2);
    return middle & canvas->geometry();
}

ChartExport::Table QPlcTimePlot::Private::table(Time begin, Time end) const
{
    return [this, begin, end](TableText::Format format) {
        std::vector<TableExport::Column> columns;
        for (const PlotCurve &curve : curves) {
            if (!curve.isSeen())
                continue;
            columns.push_back(
                TableExport::Column::of(curve.source, curve.text(), curve.settings.gain, curve.settings.offset));
            columns.back().hasQuality = format == TableText::Csv;  // people paste numbers
            columns.back().shift = curve.run.shift;
            columns.back().begin = curve.run.begin;
            columns.back().end = curve.run.end;
        }
        return std::make_shared<TableExport>(format, std::move(columns), begin, end);
    };
}

/// The range is that of the moment of the wish, whatever is seen when the name has been chosen.
ChartExport::Table QPlcTimePlot::Private::shownTable() const
{
    return table(canvas->begin(), canvas->end() - 1);
}

ChartExport::Table QPlcTimePlot::Private::tableBetweenCursors() const
{
    if (!time.hasBothCursors())
        return shownTable();
    const Time a = *time.shared()->cursor(QPlcTimeAxis::A);
    const Time b = *time.shared()->cursor(QPlcTimeAxis::B);
    return table(std::min(a, b), std::max(a, b));
}
