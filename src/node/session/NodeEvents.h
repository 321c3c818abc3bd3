// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/messages/Events.h"
#include "transport/TokenBucket.h"

#include <QtCore/QTimer>

#include <functional>
#include <map>

namespace qplc {

/// What a node tells the event log of its master: some events at once, then one each second, so
/// that the master takes all of them. Of a condition that begins and ends more often, the newest
/// state is told; what was left out is counted.
///
/// Threads: that of the node.
class NodeEvents
{
public:
    static constexpr int mostAtOnce = 16;  // a master takes more
    /// \return false: there is no master now
    using Send = std::function<bool(const messages::NodeEvent &event)>;

    /// \param parent  of the timer
    NodeEvents(Send send, QObject *parent);

    void tell(messages::Severity severity, const QString &text);
    /// \param alarm  name of a condition that lasts until its end()
    void begin(const QString &alarm, messages::Severity severity, const QString &text);
    void end(const QString &alarm, const QString &text);
    /// A master is there, and knows of no condition.
    void masterCame();

private:
    struct Alarm
    {
        messages::NodeEvent event;  // its begin or its end
        bool isDue = true;          // the master is to be told
        bool isKnown = false;       // the master has been told its begin
    };

    void sendDue();
    bool send(messages::NodeEvent event);

    Send m_send;
    QTimer m_timer;
    TokenBucket m_bucket{1, mostAtOnce};
    std::map<QString, Alarm> m_alarms;
    quint64 m_leftOut = 0;  // since the last one that was sent
};

}  // namespace qplc
