// SPDX-License-Identifier: Apache-2.0
#include "MasterJournal.h"

#include "node/Logging.h"
#include "protocol/messages/Texts.h"

#include <utility>

namespace qplc {

namespace {

/// A master keeps 1000 events and sends 200 in an answer: one that says again and again that there
/// are more is not listened to for ever, since other events wait for the end.
constexpr int mostAnswers = 100;

PlantEvent::Severity severityOf(const QString &name)
{
    switch (messages::valueNamed<messages::Severity>(name).value_or(messages::Severity::Info)) {
    case messages::Severity::Error:
        return PlantEvent::Error;
    case messages::Severity::Warning:
        return PlantEvent::Warning;
    case messages::Severity::Info:
        break;
    }
    return PlantEvent::Information;
}

}  // namespace

MasterJournal::MasterJournal(ControlClient &control, QObject *parent)
    : QObject(parent)
    , m_control(control)
{
}

void MasterJournal::begin(quint64 session, bool hasFeature)
{
    if (session != m_session) {
        m_newest = 0;
        endAlarms();
    }
    m_session = session;
    m_hasFeature = hasFeature;
    if (hasFeature)
        fetch();
}

void MasterJournal::end()
{
    m_hasFeature = false;
    m_pushed.clear();
    endFetching();
}

void MasterJournal::fetch()
{
    m_isFetching = true;
    m_control.request(messages::GetEvents{m_newest},
                      [this](const ControlClient::Reply<messages::GetEvents> &reply) { handleFetched(reply); });
}

void MasterJournal::handleFetched(const ControlClient::Reply<messages::GetEvents> &reply)
{
    if (!m_isFetching)
        return;  // of a connection that is gone
    const quint64 before = m_newest;
    const auto *events = std::get_if<messages::Events>(&reply);
    if (events)
        tellNew(*events);
    if (events && events->more.value_or(false) && m_newest > before && ++m_answers < mostAnswers)
        fetch();
    else
        endFetching();
}

void MasterJournal::endFetching()
{
    if (!m_isFetching)
        return;
    m_isFetching = false;
    m_answers = 0;
    const std::vector<messages::Events> pushed = std::exchange(m_pushed, {});
    for (const messages::Events &events : pushed)
        tellNew(events);
    Q_EMIT fetched();
}

void MasterJournal::handle(const messages::Events &pushed)
{
    if (!m_hasFeature)
        return;
    const bool isBehind = !pushed.events.empty() && pushed.events.front().sequence > m_newest + 1;
    if (m_isFetching || isBehind)
        m_pushed.push_back(pushed);
    if (!m_isFetching && isBehind)
        fetch();  // this window took nothing in for a while: what it missed comes first
    else if (!m_isFetching)
        tellNew(pushed);
}

void MasterJournal::tellNew(const messages::Events &events)
{
    for (const messages::EventEntry &event : events.events) {
        if (event.sequence <= m_newest)
            continue;
        m_newest = event.sequence;
        tell(event);
    }
}

void MasterJournal::tell(messages::EventEntry event)
{
    messages::changeTexts(&event, [](QString *text) { *text = printable(*text); });
    PlantEvent told{QDateTime::fromMSecsSinceEpoch(qint64(event.time / 1'000'000)), severityOf(event.severity),
                    event.source == messages::masterName ? QString() : event.source, event.text, false};
    told.alarm = event.alarm;
    told.isStateChange = event.kind == messages::stateEvent;
    told.isNote = event.kind == messages::noteEvent;
    if (!told.alarm.isEmpty())
        told.stage = event.active.value_or(false) ? PlantEvent::Begins : PlantEvent::Ends;
    if (told.stage == PlantEvent::Begins)
        m_alarms.insert(told.alarm, told);
    else
        m_alarms.remove(told.alarm);
    Q_EMIT happened(told);
}

/// A master that begins anew knows nothing of what lasted before.
void MasterJournal::endAlarms()
{
    for (PlantEvent event : qAsConst(m_alarms)) {
        event.time = QDateTime::currentDateTime();
        event.severity = PlantEvent::Information;
        event.text = tr("%1: over, the master has begun anew").arg(event.alarm);
        event.stage = PlantEvent::Ends;
        Q_EMIT happened(event);
    }
    m_alarms.clear();
}

}  // namespace qplc
