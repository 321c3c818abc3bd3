// SPDX-License-Identifier: Apache-2.0
#include "NodeEvents.h"

#include "realtime/TimeSource.h"

namespace qplc {

NodeEvents::NodeEvents(Send send, QObject *parent)
    : m_send(std::move(send))
    , m_timer(parent)
{
    m_timer.setSingleShot(true);
    m_timer.setInterval(1000);
    QObject::connect(&m_timer, &QTimer::timeout, parent, [this] { sendDue(); });
}

void NodeEvents::tell(messages::Severity severity, const QString &text)
{
    messages::NodeEvent event;
    event.severity = severity;
    event.text = text;
    if (!m_bucket.take(monotonicNow()) || !send(event))
        ++m_leftOut;
}

void NodeEvents::begin(const QString &alarm, messages::Severity severity, const QString &text)
{
    Alarm &one = m_alarms[alarm];
    if (one.isDue && one.event.active)
        ++m_leftOut;  // what it replaces
    one.event = {severity, text, alarm, true};
    one.isDue = true;
    sendDue();
}

void NodeEvents::end(const QString &alarm, const QString &text)
{
    const auto found = m_alarms.find(alarm);
    if (found == m_alarms.end())
        return;
    Alarm &one = found->second;
    if (one.isDue)
        ++m_leftOut;  // its begin
    one.event = {messages::Severity::Info, text, alarm, false};
    one.isDue = true;
    if (!one.isKnown) {  // nobody has heard of it
        ++m_leftOut;
        m_alarms.erase(found);
    }
    sendDue();
}

void NodeEvents::masterCame()
{
    for (auto one = m_alarms.begin(); one != m_alarms.end();) {
        one->second.isKnown = false;
        one->second.isDue = true;
        one = one->second.event.active.value_or(false) ? std::next(one) : m_alarms.erase(one);
    }
    sendDue();
}

void NodeEvents::sendDue()
{
    for (auto one = m_alarms.begin(); one != m_alarms.end();) {
        Alarm &alarm = one->second;
        if (alarm.isDue && !m_bucket.take(monotonicNow())) {
            m_timer.start();
            return;
        }
        if (alarm.isDue && !send(alarm.event))
            return;  // until masterCame()
        alarm.isDue = false;
        alarm.isKnown = true;
        one = alarm.event.active.value_or(false) ? std::next(one) : m_alarms.erase(one);
    }
}

bool NodeEvents::send(messages::NodeEvent event)
{
    if (m_leftOut > 0)
        event.text += QStringLiteral(" (%1 more events were left out before)").arg(m_leftOut);
    const bool isSent = m_send(event);
    m_leftOut = isSent ? 0 : m_leftOut;
    return isSent;
}

}  // namespace qplc
