// SPDX-License-Identifier: Apache-2.0
// Runs that lie over each other in a time plot.
#include "QPlcTimePlotPrivate.h"

#include <algorithm>
#include <cmath>

using namespace qplc;

namespace {

constexpr double roomBehind = 1.02;   // of the longest run
constexpr double roomOfGrowth = 1.1;  // of one that goes on

}  // namespace

void QPlcTimePlot::Private::connectRuns()
{
    connect(runBar, &RunBar::edited, this, [this] {
        PlotSettings wanted = settings;
        wanted.runs = runBar->settings();
        edit(wanted);
    });
}

/// A plot has one of them: a trigger moves the view, too.
void QPlcTimePlot::Private::toggleRuns()
{
    PlotSettings wanted = settings;
    if (!settings.runs.isOn && settings.runs.plants.isEmpty() && settings.runs.signal.isEmpty())
        wanted.runs = usualRuns();
    wanted.runs.isOn = !settings.runs.isOn;
    if (wanted.runs.isOn)
        wanted.setTriggerOn(false);
    edit(wanted);
}

/// Names of pieces that are gone are forgotten.
void QPlcTimePlot::Private::toggleRun(const QString &name)
{
    PlotSettings wanted = settings;
    QStringList hidden;
    for (const PlotRun &run : runs.all()) {
        if (settings.runs.hidden.contains(run.name) != (run.name == name))
            hidden << run.name;
    }
    wanted.runs.hidden = hidden;
    edit(wanted);
}

/// The other recording if there is one; else the pieces of this one that begin where the chosen
/// curve rises through the middle of its values.
RunSettings QPlcTimePlot::Private::usualRuns() const
{
    RunSettings usual;
    const PlotCurve *curve = chosenCurve();
    for (const PlotCurve &each : curves)
        curve = curve ? curve : &each;
    if (!curve)
        return usual;
    QStringList plants = context()->plants();
    plants.removeAll(curve->source.plant);
    if (plants.size() == 1) {
        usual.plants = plants;
        return usual;
    }
    usual.alignment = RunSettings::RisingEdges;
    usual.signal = curve->settings.signal;
    if (const QPlcPast &past = curve->source; past && !past.isEmpty()) {
        const QPlcPast::Range range = past.range(past.firstRow(), past.endRow());
        if (!range.isEmpty())
            usual.level = QString::number(0.5 * (range.minimum + range.maximum), 'g', 3).toDouble();
    }
    return usual;
}

void QPlcTimePlot::Private::showRuns()
{
    runsAction->setChecked(settings.runs.isOn);
    runBar->setVisible(settings.runs.isOn);
    QStringList expressions;
    for (const PlotCurveSettings &curve : qAsConst(settings.curves))
        expressions << curve.signal;
    runBar->showSettings(settings.runs, expressions);
}

void QPlcTimePlot::Private::findRuns()
{
    runs.bind(settings, *context());
    if (!settings.runs.isOn)
        return;
    runBar->showUnit(settings.runs.signal.isEmpty() ? QString() : context()->past(settings.runs.signal).unit);
    showLaps();
}

void QPlcTimePlot::Private::showRunState()
{
    const int count = int(runs.all().size());
    QString text = count == 1 ? QPlcTimePlot::tr("1 run") : QPlcTimePlot::tr("%1 runs").arg(count);
    if (curves.areDifferencesCut())
        text = QPlcTimePlot::tr("%1, differences of their newest cycles only").arg(text);
    const bool isProblem = !runs.problem().isEmpty();
    runBar->showState(isProblem ? runs.problem() : text, isProblem, runs.reference());
}

/// New edges, and runs that go on.
void QPlcTimePlot::Private::takeRuns()
{
    if (!settings.runs.isOn)
        return;
    if (runs.update(*context()))
        bind();
    showLaps();
    curves.advanceDifferences();
    if (const QPlcPast::Row rows = curves.endOfFurtherRows(); rows != furtherRows) {
        furtherRows = rows;
        change();
    }
}

/// All of the runs, as long as nobody has moved the view; else the same piece of new runs.
void QPlcTimePlot::Private::showLaps()
{
    if (!runs.zero())
        return;
    const Time zero = *runs.zero();
    const Time length = std::max<Time>(runs.length(), QPlcTimeAxis::shortestSpan);
    const bool isUnmoved = shownZero && time.own()->begin() == *shownZero && time.own()->span() == shownLength;
    if (!shownZero || (isUnmoved && (length > shownLength || zero != *shownZero))) {
        const bool goesOn = shownZero && length > shownLength;  // it gets longer and longer: not with each cycle
        shownLength = goesOn || !shownZero ? Time(std::llround((goesOn ? roomOfGrowth : roomBehind) * double(length)))
                                           : shownLength;
        time.own()->show(zero, zero + shownLength);
    } else if (zero != *shownZero) {
        const Time by = zero - *shownZero;
        time.own()->show(time.own()->begin() + by, time.own()->end() + by);
    }
    shownZero = zero;
}
