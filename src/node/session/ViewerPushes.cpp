// SPDX-License-Identifier: Apache-2.0
#include "ViewerPushes.h"

#include "MasterReplies.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr int gatherPause = 20;            // [ms] what happens meanwhile travels together
constexpr int slowPause = 100;             // [ms] until a slow connection is looked at again
constexpr qint64 mostWaiting = 64 * 1024;  // [byte] a connection with more to be sent gets nothing new
constexpr std::size_t mostEvents = 100;    // in one message

}  // namespace

ViewerPushes::ViewerPushes(const MasterServer &server, const EventLog &events,
                           std::function<messages::LeasesChanged()> leases)
    : m_server(server)
    , m_events(events)
    , m_leases(std::move(leases))
{
    m_timer.setSingleShot(true);
    connect(&m_timer, &QTimer::timeout, this, [this] { push(); });
}

void ViewerPushes::leasesChanged()
{
    for (const std::unique_ptr<MasterConnection> &connection : m_server.connections())
        connection->leasesDue = connection->uses(messages::feature::leases);
    pushSoon(gatherPause);
}

void ViewerPushes::eventsHappened()
{
    pushSoon(gatherPause);
}

void ViewerPushes::pushSoon(int pause)
{
    if (!m_timer.isActive())
        m_timer.start(pause);
}

void ViewerPushes::push()
{
    int next = 0;
    for (const std::unique_ptr<MasterConnection> &connection : m_server.connections()) {
        const int pause = pushTo(connection.get());
        next = next > 0 && pause > 0 ? std::min(next, pause) : std::max(next, pause);
    }
    if (next > 0)
        pushSoon(next);
}

int ViewerPushes::pushTo(MasterConnection *connection)
{
    const bool eventsDue = connection->uses(messages::feature::events) && connection->eventsTold < m_events.newest();
    if (!connection->leasesDue && !eventsDue)
        return 0;
    if (connection->socket->bytesToSend() > mostWaiting)
        return slowPause;
    if (connection->leasesDue)
        connection->send(m_leases());
    connection->leasesDue = false;
    if (!eventsDue)
        return 0;
    const std::vector<JournalEvent> events = m_events.after(connection->eventsTold, mostEvents);
    connection->eventsTold = events.back().sequence;
    connection->send(eventReply(events));
    return connection->eventsTold < m_events.newest() ? gatherPause : 0;
}

}  // namespace qplc
