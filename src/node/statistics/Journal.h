// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EventLog.h"
#include "ReportLimiter.h"
#include "node/cycle/CycleStatistics.h"
#include "transport/TokenBucket.h"

#include <QtCore/QObject>
#include <QtCore/QStringList>
#include <QtCore/QTimer>

#include <map>

namespace qplc {

namespace messages {
struct NodeEvent;
}

/// What happens at a master, for people: the one place that makes a line of the log and an event
/// for viewers out of it.
///
/// Threads: that of the master.
class Journal : public QObject
{
    Q_OBJECT
public:
    static constexpr std::size_t mostAlarms = 1000;  // that last
    static constexpr int mostReports = 64;           // likewise, that one node has reported

    Journal();

    const EventLog &events() const { return m_events; }

    /// \param source  name of a node, or of the master
    void tell(JournalEvent::Severity severity, JournalEvent::Kind kind, const QString &source, const QString &text);
    /// Tells that something abnormal begins, and lasts until it is cleared; its duration counts
    /// from the first time on. Strangers may bring names without an end: if more than mostAlarms
    /// last, the least severe one, and of these the oldest, is dropped, which is told with its
    /// severity.
    /// \param alarm  what: "node Winch"
    void raise(const QString &alarm, JournalEvent::Severity severity, JournalEvent::Kind kind, const QString &source,
               const QString &text);
    /// Tells that it is over, and how long it lasted. Nothing is told of what was not raised.
    void clear(const QString &alarm, const QString &text);
    /// All that lasts is over, but for the troubles of the master itself (of the kind State), and
    /// for what nodes report of their devices: that ends when they say so, or leave.
    void clearAll(const QString &text);
    /// \param isTransient  time stands still, or goes on again: this may happen in every cycle
    void stateChanged(const QString &state, bool isTransient);
    void answeredLate(const QString &node, std::uint64_t cycle);
    /// The alarms of lost nodes are of these two: a node that has registered again is still missing
    /// while it joins.
    void nodeLost(const QString &node, JournalEvent::Severity severity, const QString &reason);
    void nodeReturned(const QString &node);
    void valueSet(const QString &who, const QString &address, const QString &signal, const QString &former,
                  const QString &value);
    /// \param values  "tetherSpeed = 0"
    void becameSafe(const QStringList &values);
    /// A signal with several writers has its values from another one.
    void sourceChanged(const QString &signal, const QString &from, const QString &to);
    /// Somebody has proven \a identity.
    void accepted(const QString &identity, const QString &address, const QString &text);
    /// A message without the right to it. \param identity  proven; empty: nobody's
    void denied(const QString &identity, const QString &address, const QString &text);
    /// Somebody with a right to it has commanded \a what. \param from where from, and what else
    /// differs from time to time
    void commanded(const QString &identity, const QString &address, const QString &what, const QString &from);
    /// Somebody whose greeting or registration was refused; anybody can be, again and again. \param
    /// name as he calls himself
    void refused(const QString &name, const QString &address, const QString &reason);
    /// Somebody who was not let in.
    void strangerRefused(const QString &address, const QString &reason);
    /// What a node tells of its devices and its work. \param isTooMuch  it tells so much that this
    /// is told together with others
    void nodeTold(const QString &node, const messages::NodeEvent &event, bool isTooMuch);
    /// \a node has left: nobody will tell the end of what lasts at it.
    void nodeTellsNoMore(const QString &node);
    /// A remark of a person. \return false: there are too many of them, and nothing has happened
    bool note(const QString &who, const QString &address, const QString &text);
    void valueCameBack(const QString &signal, const QString &value);

    /// From here on overruns are told. \param statistics  of the cycles; null: they have ended
    void watchOverruns(const CycleStatistics *statistics);

Q_SIGNALS:
    void appended();

private:
    struct Alarm
    {
        JournalEvent event;
        std::int64_t since;  // [ns] on the monotonic clock
    };

    void append(const JournalEvent &event);
    QStringList reportsOf(const QString &node) const;
    void dropLeastSevere();
    void tellLimited(const QString &thing, const QString &begin, const JournalEvent &event);
    void tellDue();
    void waitForNext();
    void tellOverruns();

    EventLog m_events;
    ReportLimiter m_limiter;
    TokenBucket m_refusals{1, 16};  // that are told one by one; more of them are told together
    TokenBucket m_notes{1, 20};
    std::map<QString, Alarm> m_alarms;  // that last
    QTimer m_limiterTimer;
    QTimer m_overrunTimer;
    const CycleStatistics *m_statistics = nullptr;  // while cycles run
    std::uint64_t m_overruns = 0;                   // told
    std::uint64_t m_skipped = 0;
};

}  // namespace qplc
