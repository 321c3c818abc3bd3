// SPDX-License-Identifier: Apache-2.0
#include "EventLine.h"

namespace qplc {

namespace {

/// Null when nothing asks.
const PlantEvent *newestThatAsks(const EventLogModel &events)
{
    for (int row = events.rowCount() - 1; row >= 0; --row) {
        const PlantEvent &event = events.at(row);
        if (event.severity != PlantEvent::Information && !event.isAcknowledged)
            return &event;
    }
    return nullptr;
}

/// The newest start, stop, or other change of a state; empty before the first.
QString newestStateChange(const EventLogModel &events)
{
    for (int row = events.rowCount() - 1; row >= 0; --row) {
        const PlantEvent &event = events.at(row);
        if (event.isStateChange)
            return QStringLiteral("%1  %2: %3")
                .arg(event.time.toString(QStringLiteral("HH:mm:ss")), event.source,
                     event.text.section(QLatin1Char('\n'), 0, 0));
    }
    return {};
}

}  // namespace

EventLine::EventLine(WindowContext *context, QWidget *parent)
    : BarButton(Quiet, context, parent)
    , m_context(context)
{
    setObjectName(QStringLiteral("EventLine"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    setToolTip(tr("Opens the event log (F8)"));
    m_saying.setSingleShot(true);
    m_saying.setInterval(6000);
    connect(&m_saying, &QTimer::timeout, this, &EventLine::follow);
    connect(context->events(), &EventLogModel::unacknowledgedChanged, this, [this] {
        m_saying.stop();
        follow();
    });
    connect(context->events(), &QAbstractItemModel::rowsInserted, this, &EventLine::follow);
    connect(context, &WindowContext::themeChanged, this, &EventLine::follow);
    follow();
}

QSize EventLine::sizeHint() const
{
    return {320, BarButton::sizeHint().height()};
}

void EventLine::say(const QString &text)
{
    m_said = text;
    m_saying.start();
    follow();
}

void EventLine::follow()
{
    setDetail(newestStateChange(*m_context->events()));
    if (m_saying.isActive()) {
        setText(QStringLiteral("✓  ") + m_said);
        setTextColor(m_context->theme().text);
    } else {
        showEvents();
    }
    setAccessibleName(detail().isEmpty() ? text() : text() + QStringLiteral("; ") + detail());
}

void EventLine::showEvents()
{
    const int count = m_context->events()->unacknowledged();
    const PlantEvent *event = count > 0 ? newestThatAsks(*m_context->events()) : nullptr;
    if (!event) {
        const int active = m_context->events()->active();
        setText(active > 0 ? tr("Active, and acknowledged: %1").arg(active) : tr("No events to acknowledge"));
        setTextColor(m_context->theme().mutedText);
    } else {
        const QString more = count > 1 ? tr("   (and %1 more)").arg(count - 1) : QString();
        setText(QStringLiteral("%1  %2  %3: %4%5")
                    .arg(EventLogModel::severityText(event->severity), event->time.toString(QStringLiteral("HH:mm:ss")),
                         event->source, event->text.section(QLatin1Char('\n'), 0, 0), more));
        setTextColor(event->severity == PlantEvent::Error ? m_context->theme().alarm : m_context->theme().warning);
    }
}

}  // namespace qplc
