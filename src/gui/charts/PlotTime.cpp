// SPDX-License-Identifier: Apache-2.0
#include "PlotTime.h"

#include "PlotCanvas.h"
#include "PlotCurves.h"
#include "PlotInteraction.h"
#include "QPlcPanelContext.h"
#include "TriggerBar.h"

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

constexpr double reachOfRow = 4.0;    // [px]: so far a cursor goes to a row
constexpr double firstCursor = 0.35;  // places of cursors without a mouse, of the view
constexpr double secondCursor = 0.65;

}  // namespace

PlotTime::PlotTime(const QPlcPanelContext *context, const PlotSettings *settings, const TriggerBar *trigger,
                   const PlotCanvas *canvas, const PlotCurves *curves, const PlotInteraction *interaction)
    : m_context(context)
    , m_settings(settings)
    , m_trigger(trigger)
    , m_canvas(canvas)
    , m_curves(curves)
    , m_interaction(interaction)
{
}

QPlcTimeAxis *PlotTime::shared() const
{
    return m_context->timeAxis();
}

QPlcTimeAxis *PlotTime::view()
{
    const bool hasOwn
        = m_settings->hasTrigger() ? !m_trigger->isLinked() : m_settings->hasOwnTime || m_settings->runs.hasPieces();
    return hasOwn ? &m_own : shared();
}

PlotTime::Time PlotTime::newest() const
{
    const Time ofCurves = m_curves->newestTime();
    return ofCurves == 0 ? shared()->newest() : ofCurves;
}

TimeColumns PlotTime::columns()
{
    const QPlcTimeAxis *time = view();
    const int width = m_canvas->deviceWidth();
    return time->isLive() ? TimeColumns::upTo(newest(), time->span(), width)
                          : TimeColumns(time->begin(), time->end(), width);
}

std::optional<PlotTime::Time> PlotTime::atMouse() const
{
    const std::optional<QPoint> mouse = m_interaction->mouse();
    return mouse ? std::optional<Time>(m_canvas->timeAt(mouse->x())) : std::nullopt;
}

void PlotTime::freeze()
{
    if (view()->isLive())
        view()->show(newest() - view()->span(), newest());
}

void PlotTime::toggleLive()
{
    view()->isLive() ? freeze() : view()->goLive();
}

void PlotTime::pan(Time by)
{
    freeze();
    view()->pan(by);
}

void PlotTime::zoom(double factor)
{
    const QPlcTimeAxis *time = view();
    zoom(factor, atMouse().value_or(time->isLive() ? newest() : time->begin() + time->span() / 2));
}

void PlotTime::zoom(double factor, Time about)
{
    const bool staysLive = view()->isLive() && about >= newest();
    if (!staysLive)
        freeze();
    view()->zoom(factor, staysLive ? view()->end() : about);
}

void PlotTime::showAll()
{
    Time begin = 0;
    Time end = 0;
    if (!m_curves->timeRange(&begin, &end))
        return;
    if (view()->isLive())
        view()->setSpan(newest() - begin);
    else
        view()->show(begin, std::max(end, begin + 1));
}

// ---- cursors ----

bool PlotTime::hasBothCursors() const
{
    return shared()->cursor(QPlcTimeAxis::A) && shared()->cursor(QPlcTimeAxis::B);
}

void PlotTime::placeCursor(QPlcTimeAxis::Cursor which, Time time)
{
    if (m_curves->isEmpty())
        return;
    m_lastCursor = which;
    shared()->setCursor(which, nearestRow(time));
}

void PlotTime::placeCursor(QPlcTimeAxis::Cursor which)
{
    const double share = which == QPlcTimeAxis::A ? firstCursor : secondCursor;
    placeCursor(which, atMouse().value_or(m_canvas->timeAt(share * m_canvas->canvas()->width())));
}

PlotTime::Time PlotTime::nearestRow(Time time) const
{
    Time nearest = time;
    Time distance = m_canvas->timeAt(reachOfRow) - m_canvas->timeAt(0.0);
    for (const QPlcPast &past : m_curves->pasts()) {
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

void PlotTime::moveCursor(int pixels)
{
    const std::optional<Time> time = shared()->cursor(m_lastCursor);
    const Time pixel = m_canvas->timeAt(1.0) - m_canvas->timeAt(0.0);
    if (time)
        shared()->setCursor(m_lastCursor, *time + pixels * pixel);
    else
        placeCursor(m_lastCursor);
}

void PlotTime::removeCursors()
{
    shared()->setCursor(QPlcTimeAxis::A, std::nullopt);
    shared()->setCursor(QPlcTimeAxis::B, std::nullopt);
}

}  // namespace qplc
