// SPDX-License-Identifier: Apache-2.0
#include "TimeBar.h"

#include "gui/models/ValueFormat.h"

#include <QtCore/QTimer>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <iterator>

namespace qplc {

namespace {

constexpr QPlcTimeAxis::Time second = SignalStore::Second;
constexpr QPlcTimeAxis::Time spans[] = {second,      2 * second,  5 * second,   10 * second,  20 * second,
                                        30 * second, 60 * second, 120 * second, 300 * second, 600 * second};

}  // namespace

QString spanText(QPlcTimeAxis::Time span)
{
    const double seconds = double(span) * 1e-9;
    if (seconds < 0.1)
        return TimeBar::tr("%1 ms").arg(seconds * 1e3, 0, 'g', 3);
    if (seconds < 60.0)
        return TimeBar::tr("%1 s").arg(seconds, 0, 'g', 3);
    return seconds < 3600.0 ? TimeBar::tr("%1 min").arg(seconds / 60.0, 0, 'g', 3)
                            : TimeBar::tr("%1 h").arg(seconds / 3600.0, 0, 'g', 3);
}

TimeBar::TimeBar(WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_context(context)
    , m_state(new BarButton(BarButton::Quiet, context))
    , m_span(new BarButton(BarButton::Quiet, context))
{
    auto *row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    row->addWidget(m_state);
    row->addWidget(m_span);
    m_state->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    m_span->setToolTip(tr("Span of time axes (Ctrl+[, Ctrl+])"));
    connect(m_state, &QAbstractButton::clicked, this, &TimeBar::toggle);
    connect(m_span, &QAbstractButton::clicked, this, &TimeBar::openSpanMenu);
    connect(context->timeAxis(), &QPlcTimeAxis::viewChanged, this, &TimeBar::follow);
    connect(context, &WindowContext::themeChanged, this, [this] {
        m_shown.clear();
        follow();
    });
    auto *timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, &TimeBar::follow);
    timer->start(100);
    follow();
}

TimeBar::State TimeBar::stateNow() const
{
    const QPlcTimeAxis *view = m_context->timeAxis();
    if (hasRecordingsAlone())
        return {State::AtRest, QStringLiteral("○  ") + tr("Recording")};
    if (view->isLive())
        return liveState();
    return {State::Frozen,
            QStringLiteral("❚❚  ") + tr("Frozen, %1 s behind").arg(double(view->behind()) * 1e-9, 0, 'f', 1)};
}

bool TimeBar::hasRecordingsAlone() const
{
    const QVector<Plant *> all = m_context->plants()->all();
    return !all.isEmpty()
        && std::all_of(all.begin(), all.end(), [](const Plant *plant) { return plant->recording() != nullptr; });
}

/// Live is what has new values: the view follows them by itself, but a lost master has none.
TimeBar::State TimeBar::liveState() const
{
    const PlantList &plants = *m_context->plants();
    QStringList missing;
    double age = 0.0;
    bool isAnyLive = false;
    bool isAnyAtRest = false;
    for (const Plant *plant : plants.all()) {
        const Plant::Quality quality = plant->quality();
        isAnyLive = isAnyLive || quality == Plant::Good;
        isAnyAtRest = isAnyAtRest || quality == Plant::AtRest;
        if (quality != Plant::Stale)
            continue;
        missing << plant->name();
        age = std::max(age, plant->age());
    }
    if (!missing.isEmpty() && (isAnyLive || isAnyAtRest))
        return {State::Partly,
                QStringLiteral("◐  ")
                    + tr("No new values of %1 for %2").arg(missing.join(QStringLiteral(", ")), ageText(age))};
    if (!missing.isEmpty())
        return {State::Missing, QStringLiteral("○  ") + tr("No new values for %1").arg(ageText(age))};
    if (isAnyLive)
        return {State::Live, QStringLiteral("●  ") + tr("Live")};
    return isAnyAtRest ? State{State::AtRest, QStringLiteral("○  ") + tr("At rest")}
                       : State{State::Empty, QStringLiteral("○  ") + tr("No values")};
}

void TimeBar::follow()
{
    const State state = stateNow();
    const QString span = spanText(m_context->timeAxis()->span());
    if (state.text + span == m_shown)
        return;
    m_shown = state.text + span;
    show(state);
    m_span->setText(tr("Span %1").arg(span));
    m_span->updateGeometry();
}

void TimeBar::show(const State &state)
{
    const Theme &theme = m_context->theme();
    const bool isFrozen = state.kind == State::Frozen;
    const bool isCalm = state.kind == State::Live || state.kind == State::AtRest || state.kind == State::Empty;
    m_state->setText(state.text);
    m_state->setTextColor(isCalm ? theme.mutedText : theme.warning);
    m_state->setDetail(isFrozen ? tr("L: live") : QString());
    m_state->setToolTip(isFrozen ? tr("Back to live (L)") : tr("Freezes all views; data go on (Ctrl+Shift+L)"));
    m_state->setAccessibleName(state.text);
    const int before = state.kind == m_kind ? m_state->minimumWidth() : 0;  // grows only: nothing beside it moves
    m_state->setMinimumWidth(std::max(before, m_state->sizeHint().width()));
    m_kind = state.kind;
    m_state->updateGeometry();
}

void TimeBar::toggle()
{
    QPlcTimeAxis *view = m_context->timeAxis();
    if (view->isLive())
        view->freeze();
    else
        view->goLive();
}

void TimeBar::stepSpan(int by)
{
    QPlcTimeAxis *view = m_context->timeAxis();
    if (by > 0) {
        const auto *longer = std::upper_bound(std::begin(spans), std::end(spans), view->span());
        view->setSpan(longer != std::end(spans) ? *longer : view->span());
    } else {
        const auto *present = std::lower_bound(std::begin(spans), std::end(spans), view->span());
        view->setSpan(present != std::begin(spans) ? *std::prev(present) : view->span());
    }
}

void TimeBar::openSpanMenu()
{
    auto *menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const QPlcTimeAxis::Time span : spans) {
        QAction *action = menu->addAction(spanText(span), this, [this, span] { m_context->timeAxis()->setSpan(span); });
        action->setCheckable(true);
        action->setChecked(span == m_context->timeAxis()->span());
    }
    menu->popup(m_span->mapToGlobal(QPoint(0, -menu->sizeHint().height())));
}

}  // namespace qplc
