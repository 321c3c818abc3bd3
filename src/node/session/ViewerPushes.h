// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MasterServer.h"
#include "node/statistics/EventLog.h"

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <functional>

namespace qplc {

/// Tells those who offer the features "leases" and "events" what is new, some of it together. For a
/// connection that takes nothing in, nothing is kept: it gets the newest leases and those events
/// that are still there when it is ready again.
class ViewerPushes : public QObject
{
public:
    /// All of them outlive this object. \param leases  makes LeasesChanged
    ViewerPushes(const MasterServer &server, const EventLog &events, std::function<messages::LeasesChanged()> leases);

    void leasesChanged();
    void eventsHappened();

private:
    void push();
    /// \return when the connection has to be looked at again [ms]; 0: all is told
    int pushTo(MasterConnection *connection);
    void pushSoon(int pause);

    const MasterServer &m_server;
    const EventLog &m_events;
    std::function<messages::LeasesChanged()> m_leases;
    QTimer m_timer;
};

}  // namespace qplc
