// SPDX-License-Identifier: Apache-2.0
#include "Journal.h"

#include "node/Logging.h"
#include "node/cycle/NodeRegistry.h"
#include "protocol/messages/Events.h"
#include "realtime/TimeSource.h"
#include "signals/MessageText.h"

#include <algorithm>
#include <tuple>

namespace qplc {

namespace {

/// \a event, which somebody at \a address has caused.
JournalEvent causedFrom(const QString &address, JournalEvent event)
{
    event.address = address;
    return event;
}

/// The thing that time stands still, or goes on.
QString waiting()
{
    return QStringLiteral("waiting");
}

/// What is abnormal is seen by default, and so is who comes and takes over; the rest is for those
/// who look for it. So are overruns that end nothing: on an ordinary system they come with every
/// breath of another program, and the statistics count them.
void log(const JournalEvent &event)
{
    if (event.kind == JournalEvent::Security && event.severity == JournalEvent::Info)
        qCInfo(lcAudit).noquote() << event.text;
    else if (event.kind == JournalEvent::Security)
        qCWarning(lcAudit).noquote() << event.text;
    else if (event.kind == JournalEvent::Overrun && event.severity == JournalEvent::Warning)
        qCDebug(lcMaster).noquote() << event.text;
    else if (event.severity != JournalEvent::Info)
        qCWarning(lcMaster).noquote() << event.text;
    else if (event.kind == JournalEvent::Note)
        qCInfo(lcMaster).noquote() << "note of" << event.source + ':' << event.text;
    else if (event.kind == JournalEvent::Node || event.kind == JournalEvent::Lease
             || event.kind == JournalEvent::Quality || event.kind == JournalEvent::Report)
        qCInfo(lcMaster).noquote() << event.text;
    else
        qCDebug(lcMaster).noquote() << event.text;
}

}  // namespace

Journal::Journal()
{
    m_limiterTimer.setSingleShot(true);
    m_overrunTimer.setInterval(1000);
    connect(&m_limiterTimer, &QTimer::timeout, this, &Journal::tellDue);
    connect(&m_overrunTimer, &QTimer::timeout, this, &Journal::tellOverruns);
}

void Journal::append(const JournalEvent &event)
{
    log(event);
    m_events.append(event, wallClockNow(), monotonicNow());
    Q_EMIT appended();
}

void Journal::tell(JournalEvent::Severity severity, JournalEvent::Kind kind, const QString &source, const QString &text)
{
    append({severity, kind, source, text});
}

void Journal::accepted(const QString &identity, const QString &address, const QString &text)
{
    append(causedFrom(address, {JournalEvent::Info, JournalEvent::Security, identity, text}));
}

void Journal::raise(const QString &alarm, JournalEvent::Severity severity, JournalEvent::Kind kind,
                    const QString &source, const QString &text)
{
    const JournalEvent event{severity, kind, source, text, alarm, true};
    m_alarms.try_emplace(alarm, Alarm{event, monotonicNow()}).first->second.event = event;
    append(event);
    if (m_alarms.size() > mostAlarms)
        dropLeastSevere();
}

void Journal::dropLeastSevere()
{
    const auto dropped = std::min_element(m_alarms.begin(), m_alarms.end(), [](const auto &one, const auto &other) {
        return std::tie(one.second.event.severity, one.second.since)
            < std::tie(other.second.event.severity, other.second.since);
    });
    JournalEvent event = dropped->second.event;
    event.text
        = QStringLiteral("%1: this condition may still last; the master keeps %2 alarms and will not report its end")
              .arg(event.alarm)
              .arg(mostAlarms);
    event.isActive = false;
    m_alarms.erase(dropped);
    append(event);
}

void Journal::clear(const QString &alarm, const QString &text)
{
    const auto found = m_alarms.find(alarm);
    if (found == m_alarms.end())
        return;
    const Alarm lasted = found->second;
    m_alarms.erase(found);
    const double duration = double(monotonicNow() - lasted.since) * 1e-9;  // [s]
    append({JournalEvent::Info, lasted.event.kind, lasted.event.source,
            QStringLiteral("%1, after %2 s").arg(text).arg(duration, 0, 'f', 1), alarm, false});
}

void Journal::clearAll(const QString &text)
{
    QStringList over;
    for (const auto &[name, alarm] : m_alarms) {
        if (alarm.event.kind != JournalEvent::State && alarm.event.kind != JournalEvent::Report)
            over << name;
    }
    for (const QString &alarm : qAsConst(over))
        clear(alarm, QStringLiteral("%1: %2").arg(alarm, text));
}

void Journal::stateChanged(const QString &state, bool isTransient)
{
    const QString begin = QStringLiteral("state ");
    const JournalEvent event{JournalEvent::Info, JournalEvent::State, NodeRegistry::masterName(), state};
    if (isTransient) {
        tellLimited(waiting(), begin, event);
        return;
    }
    if (const std::optional<JournalEvent> untold = m_limiter.take(waiting()))
        append(*untold);  // later it would be wrong
    tell(event.severity, event.kind, event.source, begin + state);
}

void Journal::nodeLost(const QString &node, JournalEvent::Severity severity, const QString &reason)
{
    raise(QStringLiteral("node ") + node, severity, JournalEvent::Node, node,
          QStringLiteral("node %1 is gone in the middle of its work: %2").arg(node, reason));
}

void Journal::nodeReturned(const QString &node)
{
    clear(QStringLiteral("node ") + node, QStringLiteral("node %1 is back").arg(node));
}

void Journal::answeredLate(const QString &node, std::uint64_t cycle)
{
    tellLimited(QStringLiteral("late ") + node, QStringLiteral("node %1 was late in cycle ").arg(node),
                {JournalEvent::Warning, JournalEvent::Late, node, QString::number(cycle)});
}

void Journal::valueSet(const QString &who, const QString &address, const QString &signal, const QString &former,
                       const QString &value)
{
    tellLimited(QStringLiteral("set %1 %2").arg(signal, who),
                QStringLiteral("'%1' has set %2: %3").arg(who, signal, former),
                causedFrom(address,
                           {JournalEvent::Info, JournalEvent::Set, NodeRegistry::masterName(),
                            QStringLiteral(" -> %1").arg(value)}));
}

void Journal::becameSafe(const QStringList &values)
{
    tellLimited(QStringLiteral("safe ") + values.first(), QStringLiteral("hold time is over; safe values: "),
                {JournalEvent::Warning, JournalEvent::Quality, NodeRegistry::masterName(), firstOf(values)});
}

void Journal::sourceChanged(const QString &signal, const QString &from, const QString &to)
{
    tellLimited(QStringLiteral("source ") + signal, QStringLiteral("%1: its source is now ").arg(signal),
                {JournalEvent::Info, JournalEvent::Quality, to, QStringLiteral("%1, instead of %2").arg(to, from)});
}

void Journal::valueCameBack(const QString &signal, const QString &value)
{
    tellLimited(QStringLiteral("back ") + signal, QStringLiteral("former value restored: "),
                {JournalEvent::Info, JournalEvent::Set, NodeRegistry::masterName(),
                 QStringLiteral("%1 = %2").arg(signal, value)});
}

bool Journal::note(const QString &who, const QString &address, const QString &text)
{
    if (!m_notes.take(monotonicNow()))
        return false;
    append(causedFrom(address, {JournalEvent::Info, JournalEvent::Note, who, text}));
    return true;
}

// ---- what nodes report ----

void Journal::nodeTold(const QString &node, const messages::NodeEvent &event, bool isTooMuch)
{
    const QString text = QStringLiteral("node %1: %2").arg(node, printable(event.text.left(EventLog::LongestText)));
    const auto severity = JournalEvent::Severity(event.severity);
    const QString alarm = printable(event.alarm.left(messages::NodeEvent::longestAlarm));
    const QString name = QStringLiteral("%1: %2").arg(node, alarm);
    if (!alarm.isEmpty() && !event.active.value_or(true))
        clear(name, text);  // of what was raised only: never more than that
    else if (isTooMuch || (!alarm.isEmpty() && m_alarms.count(name) == 0 && reportsOf(node).size() >= mostReports))
        tellLimited(QStringLiteral("report ") + node, QStringLiteral("node %1 reports too much: ").arg(node),
                    {severity, JournalEvent::Report, node, text});
    else if (alarm.isEmpty())
        tell(severity, JournalEvent::Report, node, text);
    else
        raise(name, severity, JournalEvent::Report, node, text);
}

void Journal::nodeTellsNoMore(const QString &node)
{
    const QStringList over = reportsOf(node);
    for (const QString &alarm : over)
        clear(alarm, QStringLiteral("%1: not known any more, the node has left").arg(alarm));
}

/// Names of the alarms that \a node has raised.
QStringList Journal::reportsOf(const QString &node) const
{
    QStringList names;
    for (const auto &[name, alarm] : m_alarms) {
        if (alarm.event.kind == JournalEvent::Report && alarm.event.source == node)
            names << name;
    }
    return names;
}

// ---- security: strangers may do it as often as they like ----

void Journal::denied(const QString &identity, const QString &address, const QString &text)
{
    tellLimited(QStringLiteral("denied ") + identity, QString(),
                causedFrom(address, {JournalEvent::Warning, JournalEvent::Security, identity, text}));
}

void Journal::commanded(const QString &identity, const QString &address, const QString &what, const QString &from)
{
    tellLimited(QStringLiteral("commanded %1 %2").arg(identity, what),
                QStringLiteral("identity '%1' commands %2").arg(identity, what),
                causedFrom(address, {JournalEvent::Info, JournalEvent::Security, identity, from}));
}

void Journal::refused(const QString &name, const QString &address, const QString &reason)
{
    const JournalEvent event = causedFrom(
        address,
        {JournalEvent::Warning, JournalEvent::Node, name, QStringLiteral("refused %1 %2").arg(address, reason)});
    if (m_refusals.take(monotonicNow()))
        append(event);
    else
        tellLimited(QStringLiteral("refused"), QString(), event);
}

void Journal::strangerRefused(const QString &address, const QString &reason)
{
    tellLimited(QStringLiteral("strangers"), QString(),
                causedFrom(address,
                           {JournalEvent::Warning, JournalEvent::Security, NodeRegistry::masterName(),
                            QStringLiteral("refused %1: %2").arg(address, reason)}));
}

// ---- what may happen often ----

void Journal::tellLimited(const QString &thing, const QString &begin, const JournalEvent &event)
{
    if (const std::optional<JournalEvent> told = m_limiter.report(thing, begin, event, monotonicNow()))
        append(*told);
    waitForNext();
}

void Journal::tellDue()
{
    for (const JournalEvent &event : m_limiter.takeDue(monotonicNow()))
        append(event);
    waitForNext();
}

void Journal::waitForNext()
{
    if (const std::optional<std::int64_t> next = m_limiter.nextDue())
        m_limiterTimer.start(int(std::max<std::int64_t>(*next - monotonicNow(), 0) / 1'000'000 + 1));
}

// ---- overruns ----

void Journal::watchOverruns(const CycleStatistics *statistics)
{
    if (m_statistics)
        tellOverruns();
    m_statistics = statistics;
    m_overruns = m_skipped = 0;
    if (statistics)
        m_overrunTimer.start();
    else
        m_overrunTimer.stop();
}

void Journal::tellOverruns()
{
    const std::uint64_t overruns = m_statistics->overruns();
    const std::uint64_t skipped = m_statistics->skippedCycles();
    if (overruns == m_overruns)
        return;
    tell(JournalEvent::Warning, JournalEvent::Overrun, NodeRegistry::masterName(),
         QStringLiteral("cycles that began a period or more late since the last report: %1; left out: %2")
             .arg(overruns - m_overruns)
             .arg(skipped - m_skipped));
    m_overruns = overruns;
    m_skipped = skipped;
}

}  // namespace qplc
